"""``softshadow listings``: the list, one listing with its code and steps, and its comparison with Mesa."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import softshadow as ss
from cli.invocation import error_of, invoke, invoke_ok, json_of, usage_error_of
from softshadow import listings
from softshadow.testing import ProgramResult, run_here

SIZE = (48, 36)
SMALL = ("--size", "48x36")
STEPS = [
    "Pasul 1: the scene without light", "Pasul 2: count front faces up", "Pasul 3: count back faces down",
    "Pasul 4: add the light where the count is 0",
]  # fmt: skip


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


def test_code_is_printed_with_the_steps_of_its_lines(here: Path) -> None:
    text = invoke_ok("listings", "volume-zpass", *SMALL).stdout
    assert text.splitlines()[0] == "volume-zpass: Shadow volumes, depth pass (RO1:169-277), as corrected"
    (line,) = [line for line in text.splitlines() if "gl.glDepthFunc(gl.GL_LEQUAL)" in line]  # E2
    assert line.split()[0] == "3"
    printed = invoke_ok("listings", "volume-zpass", *SMALL, "--printed").stdout
    assert "as printed" in printed.splitlines()[0]
    assert "glDepthFunc" not in printed
    assert list(here.iterdir()) == []  # no picture unless -o asks for it


def test_steps_are_a_table_with_stencil_counts() -> None:
    answer = json_of("listings", "volume-zpass", *SMALL)
    stencil = run_here(listings.get("volume-zpass").corrected, SIZE).stencil
    expected = {str(value): int(n) for value, n in zip(*np.unique(stencil, return_counts=True), strict=True)}
    assert [step["title"] for step in answer["steps"]] == STEPS
    assert answer["stencil_counts"] == answer["steps"][-1]["stencil_counts"] == expected
    text = invoke_ok("listings", "volume-zpass", *SMALL).stdout
    assert "  ".join(f"{value}: {n}" for value, n in expected.items()) in text


def test_corrections_are_told_with_the_first_pixel_they_change_and_its_two_histories() -> None:
    text = invoke_ok("listings", "volume-zpass", *SMALL).stdout
    assert "E2      the lit scene is drawn with GL_LEQUAL" in text
    _, _, changed = text.partition("as printed and as corrected:\n")
    assert changed.startswith("color: ")
    before, after = changed.split("as corrected:\n")
    assert "as printed:\npixel " in before
    last_step, _, reason = before.rpartition("\n   3 ")[2].partition("\n")
    assert "depth failed" in last_step
    assert " is false" in " ".join(reason.split()).split("LESS: ")[1]  # E2
    assert "LEQUAL" in after
    assert json_of("listings", "volume-zpass", *SMALL)["correcting"][0]["buffer"] == "color"
    assert "nothing to correct" in invoke_ok("listings", "planar-stencil", *SMALL).stdout


def test_every_step_is_written_as_a_row_of_a_picture_or_into_a_folder(here: Path) -> None:
    assert "written: steps.png" in invoke_ok("listings", "map", *SMALL, "-o", "steps.png").stderr
    with Image.open("steps.png") as picture:
        assert picture.size[1] > 3 * SIZE[1]
    invoke_ok("listings", "volume-zpass", *SMALL, "-o", "all/")
    run = ss.load_run("all/run.npz")
    assert run.steps.titles == STEPS
    with Image.open("all/01-pasul-2-count-front-faces-up-stencil.png") as picture:
        np.testing.assert_array_equal(np.asarray(picture), run[1].stencil)
    np.testing.assert_array_equal(run.stencil[::-1], run_here(listings.get("volume-zpass").corrected, SIZE).stencil)


def test_map_of_a_listing_belongs_to_its_step() -> None:
    invoke_ok("listings", "map", *SMALL, "-o", "all/")
    run = ss.load_run("all/run.npz")
    (stored,) = run_here(listings.get("map").corrected, SIZE).returned
    np.testing.assert_array_equal(run["Pas 1: the shadow map"].maps["shadow map"][::-1], stored)


def test_pixel_is_told_with_the_steps_of_the_listing() -> None:
    text = invoke_ok("listings", "planar-stencil", "--size", "128x128", "--pixel", "60,80").stdout
    assert text.startswith("pixel x=60 y=80 (GL y=47)\n")
    rows = [line for line in text.splitlines()[2:] if line[:4].strip()]  # reasons stand below, farther to the right
    assert [line.split()[0] for line in rows] == ["0", "0", "1", "1", "2", "3", "3"]
    answer = json_of("listings", "planar-stencil", "--size", "128x128", "--pixel", "60,80")
    assert [row["step"] for row in answer["fragments"]] == [0, 0, 1, 1, 2, 3, 3]
    assert json_of("listings", "planar-stencil", *SMALL)["fragments"] is None


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
    answer = invoke("listings", "volume-zpass", *SMALL, "--on", "mesa", "-o", "a.png")
    assert answer.exit_code == 1
    assert "stencil: 1 differ, first at" in answer.stdout
    assert ": 1 and 7" in answer.stdout
    assert "volume of the lower box" in answer.stdout
    assert Path("a.png").exists()


def test_foreign_file_other_ending_and_unknown_listing_are_refused() -> None:
    Path("mine.png").write_text("my homework")
    assert error_of("listings", "map", *SMALL, "-o", "mine.png").endswith("--force overwrites it")
    assert Path("mine.png").read_text() == "my homework"
    assert "expected an ending of .png" in usage_error_of("listings", "map", *SMALL, "-o", "map.html")
    assert "did you mean 'map'" in usage_error_of("listings", "mapp")
    assert "expected a whole number from 0 to 47" in usage_error_of("listings", "map", *SMALL, "--pixel", "48,0")


@pytest.mark.parametrize("words", [["--printed"], ["--pixel", "1,2"], ["-o", "a.png"], ["--on", "mesa"]])
def test_options_of_a_run_need_the_name_of_a_listing(words: list[str]) -> None:
    assert "expected the name of a LISTING" in usage_error_of("listings", *words)


def test_diff_shows_the_corrections_as_calls_and_what_their_numbers_mean() -> None:
    text = invoke_ok("listings", "volume-five-passes", *SMALL, "--diff").stdout
    assert "- glStencilFunc(GL_EQUAL, 1, 1)\n+ glStencilFunc(GL_NOTEQUAL, 0, 255)\n" in text
    assert "+ glDisable(GL_CULL_FACE)" in text
    assert "E38: error 38 of the slides: all bits of the count are tested" in text
    answer = json_of("listings", "volume-five-passes", *SMALL, "--diff")
    assert answer["diff"] in text
    assert "nothing to correct" in invoke_ok("listings", "stencil-quads", *SMALL, "--diff").stdout
    assert "--diff: expected no --printed" in usage_error_of("listings", "map", "--diff", "--printed")
