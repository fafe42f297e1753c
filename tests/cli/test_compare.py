"""``softshadow compare``: two techniques, or any number of them beside the truth."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import softshadow as ss
from cli.invocation import invoke, invoke_ok, json_of, usage_error_of
from softshadow.soft import soft_candidates

SIZE = (48, 36)
SMALL = ("--size", "48x36")


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_two_techniques_are_compared_with_each_other() -> None:
    expected = ss.run("volume-zfail", "torus", SIZE).compare(ss.run("map", "torus", SIZE))
    answer = json_of("compare", "volume-zfail", "map", *SMALL)
    assert (answer["against"], answer["truth"], answer["exceeded"]) == ("map", None, [])
    (facts,) = answer["techniques"]
    for name, part in expected.parts.items():
        assert facts["parts"][name] == vars(part)
    lines = invoke_ok("compare", "volume-zfail", "map", *SMALL).stdout.splitlines()
    assert lines[1].split() == [
        "compared", str(expected.parts["all"].pixels), f"{expected.max:.3f}", f"{expected.rms:.4f}",
        str(expected.parts["all"].wrong),
    ]  # fmt: skip


def test_techniques_with_options_are_compared_with_ray_casting() -> None:
    texts = ("map:map_size=64,factor=2", "map:map-size=256")
    answer = json_of("compare", *texts, "--truth", "hard", *SMALL, "-O", "bias=0.001", "--scene", "boxes")
    options = [each["options"] for each in answer["techniques"]]
    assert options == [{"bias": 0.001, "map_size": 64, "factor": 2.0}, {"bias": 0.001, "map_size": 256}]
    for facts, of in zip(answer["techniques"], options, strict=True):
        expected = ss.run("map", "boxes", SIZE, **of).compare(truth="hard")
        assert facts["parts"]["all"] == vars(expected.parts["all"])
        assert facts["parts"]["off_band"]["wrong"] == sum(
            expected.parts[name].wrong for name in ("lit", "umbra", "penumbra")
        )
    rows = invoke_ok("compare", *texts, "--truth", "hard", *SMALL).stdout.splitlines()
    assert [row.split("  ")[0] for row in rows[1:]] == ["map map_size=64 factor=2.0", "map map_size=256"]


@pytest.mark.slow
def test_soft_techniques_are_compared_with_the_soft_truth() -> None:
    answer = json_of("compare", "--all-soft", "--size", "24x18", "--samples", "4")
    assert answer["scene"] == "soft-slab"
    assert [each["technique"] for each in answer["techniques"]] == list(soft_candidates())
    samples = {each["options"].get("samples") for each in answer["techniques"]}
    assert samples == {None, 4}
    named = json_of("compare", "soft-overlap", "--all-soft", "--size", "16x12", "--samples", "2")
    assert named["scene"] == "soft-overlap"
    answer = json_of("compare", "volume-sampled:samples=9", "--truth", "soft", "--size", "24x18")
    assert answer["techniques"][0]["options"] == {"samples": 9}


@pytest.mark.slow  # a hundred runs
def test_slopes_and_laws_are_measured_and_plotted() -> None:
    words = ("volume-sampled", "--truth", "soft", "--size", "24x18", "--slopes", "--laws")
    answer = json_of("compare", *words, "-o", "out/")
    assert answer["slopes"]
    assert answer["laws"]
    assert {path.name for path in Path("out").iterdir()} == {"errors.png", "slopes.svg"}


@pytest.mark.parametrize(
    ("technique", "bound", "exceeded"),
    [
        ("volume-zfail", ("--max-wrong", "0"), False),
        ("map", ("--max-rms", "1"), False),
        ("map", ("--max-rms", "0"), True),
    ],
)
def test_error_beyond_a_bound_is_exit_code_1(technique: str, bound: tuple[str, str], exceeded: bool) -> None:
    answer = invoke("compare", technique, "--truth", "hard", *SMALL, *bound)
    assert answer.exit_code == exceeded
    assert ("error: map: RMS error" in answer.stderr) == exceeded
    assert "compared" in answer.stdout


def test_wrong_pixels_beyond_a_bound_are_counted_off_the_band() -> None:
    run = ss.run("map", "torus", SIZE, map_size=16)
    wrong = sum(run.compare(truth="hard").parts[name].wrong for name in ("lit", "umbra", "penumbra"))
    words = ("compare", "map:map_size=16", "--truth", "hard", *SMALL, "--max-wrong")
    assert wrong > 0
    assert invoke(*words, wrong).exit_code == 0
    answer = invoke(*words, wrong - 1)
    assert answer.exit_code == 1
    assert f"{wrong} wrong pixels off the band; expected at most {wrong - 1}" in answer.stderr


def test_errors_are_written_as_a_picture_or_a_page() -> None:
    answer = invoke_ok("compare", "volume-zfail", "map", *SMALL, "-o", "error.png")
    assert answer.stderr == "written: error.png\n"
    with Image.open("error.png") as picture:
        assert picture.size[1] > 2 * SIZE[1]  # a row for each of the two
        colors = np.asarray(picture).reshape(-1, 3)
    assert (colors == ss.run("map", "torus", SIZE).image[0, 0]).all(axis=1).any()
    invoke_ok("compare", "map", "--truth", "hard", *SMALL, "-o", "error.html")
    page = Path("error.html").read_text(encoding="utf-8")
    assert "<td>off the band</td>" in page
    assert "data:image/png;base64," in page
    assert "http" not in page
    invoke_ok("compare", "map", "--truth", "hard", *SMALL, "-o", "error.html")  # our own file


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ([], "expected two techniques, or --truth hard or soft; got none"),
        (["map"], "expected two techniques, or --truth hard or soft; got map"),
        (["map", "map", "map"], "expected two techniques"),
        (["--truth", "hard"], "expected names of techniques, or --all-soft"),
        (["--all-soft", "map"], "--all-soft: expected no name"),
        (["--all-soft", "torus", "--scene", "boxes"], "'torus' is a scene"),
        (["--all-soft", "--truth", "hard"], "--all-soft: expected no name"),
        (["map", "map", "--samples", "4"], "expected --truth soft"),
        (["map", "--truth", "hard", "--laws"], "expected --truth soft"),
        (["map", "--truth", "soft", "--slopes", "-o", "a.png"], "expected a folder/"),
        (["map", "map", "--open"], "--open: expected a file to write"),
    ],
)
def test_words_that_do_not_fit_together_are_refused(words: list[str], said: str) -> None:
    assert said in usage_error_of("compare", *words)
