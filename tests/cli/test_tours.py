"""``softshadow tour``: progress on stderr, the page's path on stdout, and no partial output."""

import os
import signal
import time
from pathlib import Path

import pytest

import softshadow as ss
from cli.invocation import error_of, invoke, invoke_ok, json_of
from paths import SCENES, shared_file
from softshadow.tour.stops import STOPS

SMALL = ("--size", "24x18")


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def names(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


@pytest.mark.slow
def test_page_and_stops_are_named_on_stderr(here: Path) -> None:
    answer = invoke_ok("tour", *SMALL)
    assert answer.stdout == ""
    assert answer.stderr.splitlines()[-1] == "written: softshadow-tour/index.html"
    assert [stop.title for stop in STOPS if stop.title not in answer.stderr.splitlines()] == []
    assert {path.name for path in here.iterdir()} == {"softshadow-tour"}


def test_question_that_the_tour_suggests_is_answered(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("softshadow.tour.writing.STOPS", STOPS[:1])  # what it suggests depends on the arguments only
    answer = invoke_ok("tour", *SMALL, "--scene", "boxes", "--light=-2,5,1", "--eye=0,3,7", "--fov", "50")
    suggested = answer.stderr.rsplit("softshadow ", 1)[1].splitlines()[0].split()
    assert suggested[-7:] == ["--scene", "boxes", "--light=-2,5,1", "--eye=0,3,7", "--fov=50", *SMALL]
    invoke_ok(*suggested)


@pytest.mark.slow  # a whole tour
def test_json_tells_where_the_page_is() -> None:
    answer = json_of("tour", *SMALL, "-o", "t", "--scene", SCENES / "lesson.toml")
    assert (answer["index"], answer["scene"], answer["size"]) == ("t/index.html", "lesson", [24, 18])
    # the sun is a light at infinity, which has no inside: one stop is left out, and the page says so
    assert answer["runs"] == len(STOPS) - 1
    assert "map-cube expected point lights" in Path("t/index.html").read_text()


@pytest.mark.slow  # a whole tour
def test_folder_of_somebody_else_needs_force_and_keeps_its_files() -> None:
    Path("thesis").mkdir()
    Path("thesis/text.tex").write_text("my homework")
    assert error_of("tour", *SMALL, "-o", "thesis").startswith("thesis: holds files that are not of a tour; --force")
    assert names(Path("thesis")) == {"text.tex"}
    invoke_ok("tour", *SMALL, "-o", "thesis", "--force")
    assert Path("thesis/text.tex").read_text() == "my homework"
    assert Path("thesis/index.html").is_file()


@pytest.mark.slow
@pytest.mark.parametrize(
    "error",
    [
        KeyboardInterrupt,
        pytest.param(MemoryError, marks=pytest.mark.slow),
        pytest.param(OSError("the disk is gone"), marks=pytest.mark.slow),
    ],
)
@pytest.mark.parametrize("earlier", [pytest.param(False, marks=pytest.mark.slow), True])
def test_tour_that_ends_early_leaves_what_was_there(
    error: type[BaseException] | BaseException, earlier: bool, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if earlier:
        invoke_ok("tour", *SMALL)
    before = names(here)
    stops = iter(STOPS[:3])

    def stop_early(*arguments: object, **named: object) -> ss.Run:
        if next(stops, None) is None:
            raise error
        return ss.run("planar", "boxes", (24, 18))

    monkeypatch.setattr("softshadow.tour.writing.run", stop_early)
    assert invoke("tour", *SMALL).exit_code == (130 if error is KeyboardInterrupt else 3)
    assert names(here) == before


@pytest.mark.slow  # a whole tour of each
@pytest.mark.parametrize(
    "model",
    ["Duck.glb", "stanford-bunny.obj"],
)
def test_tour_of_a_real_model_has_every_stop_that_is_for_it(model: str) -> None:
    file = shared_file(f"meshes/{model}")
    answer = invoke_ok("tour", *SMALL, "--mesh", file, "-o", "t")
    assert ("warning: OpenMesh: " in answer.stderr) == ("bunny" in model)
    page = Path("t/index.html").read_text(encoding="utf-8")
    assert f"--mesh {file}" in page
    # pairs of faces are too many for shadow polygons where there are tens of thousands of faces
    left_out = {"shadow-polygons"} if "bunny" in model else set()
    assert ("Techniques that cannot draw this scene" in page) == bool(left_out)
    for stop in STOPS:
        if stop.name not in left_out:
            run = ss.load_run(f"t/{stop.name}/run.npz")
            # an open mesh has two layers nearly everywhere, which parity takes for none
            assert run.shadow_mask.any() or (run.technique, model) == ("volume-parity", "stanford-bunny.obj")


def test_tour_that_is_ended_leaves_nothing_behind(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def end(*_: object, **__: object) -> None:
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(1)

    monkeypatch.setattr("softshadow.tour.writing.run", end)
    before = signal.getsignal(signal.SIGTERM)
    assert invoke("tour", *SMALL).exit_code == 143
    assert list(here.iterdir()) == []
    assert signal.getsignal(signal.SIGTERM) is before
