"""``softshadow listings``: the list, one listing, and its comparison with Mesa."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from cli.invocation import error_of, invoke, invoke_ok, json_of
from softshadow import listings
from softshadow.testing import ProgramResult, run_here

SIZE = (48, 36)
SMALL = ("--size", "48x36")


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_listings_are_listed_with_slide_and_corrections() -> None:
    lines = invoke_ok("listings").stdout.splitlines()
    rows = json_of("listings")["listings"]
    assert [row["name"] for row in rows] == listings.names()
    for row in rows:
        line = next(line for line in lines if line.startswith(f"{row['name']} "))
        assert row["slide"] in line
        assert all(number in line.split() for number in row["corrections"])


def test_stencil_counts_are_a_table_on_stdout() -> None:
    stencil = run_here(listings.get("volume-zpass").corrected, SIZE).stencil
    text = invoke_ok("listings", "volume-zpass", *SMALL).stdout
    rows = [line.split() for line in text.partition("\n\n")[0].splitlines()]
    assert rows[0] == ["stencil", "pixels"]
    expected = zip(*np.unique(stencil, return_counts=True), strict=True)
    assert rows[1:] == [[str(value), str(pixels)] for value, pixels in expected]
    assert len(rows) > 2


def test_corrections_are_told_with_the_first_pixel_they_change_and_its_two_histories() -> None:
    text = invoke_ok("listings", "volume-zpass", *SMALL).stdout
    assert "E2      the lit scene is drawn with GL_LEQUAL" in text
    _, _, changed = text.partition("as printed and as corrected:\n")
    assert changed.startswith("color: ")
    before, after = changed.split("as corrected, pixel ")
    assert "as printed, pixel " in before
    assert before.splitlines()[-2].split("LESS: ")[1].split(" is ")[1].startswith("false")  # E2
    assert "LEQUAL" in after
    assert json_of("listings", "volume-zpass", *SMALL)["correcting"][0]["buffer"] == "color"
    assert "no corrections" in invoke_ok("listings", "planar-stencil", *SMALL).stdout


def test_buffers_are_one_picture_named_by_the_listing_or_one_each_in_a_folder(here: Path) -> None:
    answer = invoke_ok("listings", "volume-zpass", *SMALL)
    assert "written: volume-zpass.png" in answer.stderr
    invoke_ok("listings", "volume-zpass", *SMALL, "--printed")
    invoke_ok("listings", "volume-zpass", *SMALL, "-o", "all/")
    assert {str(path.relative_to(here)) for path in here.rglob("*.png")} == {
        "volume-zpass.png", "volume-zpass-printed.png", "all/image.png", "all/depth.png", "all/stencil.png",
    }  # fmt: skip
    with Image.open("all/stencil.png") as picture:
        expected = run_here(listings.get("volume-zpass").corrected, SIZE).stencil[::-1]
        np.testing.assert_array_equal(np.asarray(picture), expected)


def test_printed_listing_leaves_what_the_slide_leaves() -> None:
    assert json_of("listings", "volume-zpass", *SMALL, "--printed")["stencil_counts"] == {"0": 48 * 36}  # E1
    assert len(json_of("listings", "volume-zpass", *SMALL)["stencil_counts"]) > 1


@pytest.mark.mesa
def test_listing_is_compared_with_mesa() -> None:
    text = invoke_ok("listings", "map", *SMALL, "--on", "mesa").stdout
    assert text.splitlines()[-1] == "no pixel differs on Mesa"
    answer = json_of("listings", "map", *SMALL, "--on", "mesa")
    assert (answer["on"], answer["differences"], answer["history"]) == ("mesa", [], [])


def test_first_pixel_that_differs_comes_with_its_history_and_exit_code_1(monkeypatch: pytest.MonkeyPatch) -> None:
    def another(program: object, size: tuple[int, int]) -> ProgramResult:
        result = run_here(program, size)  # type: ignore[arg-type]
        y, x = np.argwhere(result.stencil == 1)[0]
        result.stencil[y, x] = 7
        return result

    monkeypatch.setattr("softshadow.testing.run_on_mesa", another)
    answer = invoke("listings", "volume-zpass", *SMALL, "--on", "mesa")
    assert answer.exit_code == 1
    assert "stencil: 1 differ, first at" in answer.stdout
    assert ": 1 and 7" in answer.stdout
    assert "volume of the lower box" in answer.stdout
    assert Path("volume-zpass.png").exists()


def test_foreign_file_other_ending_and_unknown_listing_are_refused() -> None:
    Path("mine.png").write_text("my homework")
    assert error_of("listings", "map", *SMALL, "-o", "mine.png").endswith("--force overwrites it")
    assert Path("mine.png").read_text() == "my homework"
    assert "expected an ending of .png" in error_of("listings", "map", *SMALL, "-o", "map.html")
    assert "did you mean 'map'" in error_of("listings", "mapp")


def test_options_of_a_run_need_the_name_of_a_listing() -> None:
    answer = invoke("listings", "--printed")
    assert answer.exit_code == 2
    assert "expected the NAME of a listing" in answer.stderr
