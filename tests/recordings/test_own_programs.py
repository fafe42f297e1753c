"""Small programs in the style of courses and books, in C and Python: every frame equals that of Mesa.

`programs/` has their sources, and the traces of those in C. `programs/frames.tsv` says which frames differ and what is
missing for them. This list may only shrink: a frame in it that does not differ any more is an error, too.
"""

import tarfile
from pathlib import Path
from typing import NamedTuple

import pytest

from paths import PROGRAMS
from recordings.logged_calls import run_logged
from softshadow.recordings.replaying import frames_of
from softshadow.testing import run_on_mesa
from softshadow.testing.comparison import differences
from softshadow.testing.trace_comparison import compare_trace, window_of

pytestmark = pytest.mark.mesa
SCRIPTS = {  # what happens to them
    "spinning_cube": {"frames": 3},
    "solar_system": {"keys": "d,d,x"},
    "height_field": {"frames": 3},
    "paint": {"clicks": ((10, 12), (30, 20), (33, 24))},
    "teapot_lists": {"frames": 3},
    "textured_room": {"frames": 4},
}


class Listed(NamedTuple):
    """A line of frames.tsv."""

    n_frames: int
    differing: frozenset[int]
    missing: str


def listed_programs() -> dict[str, Listed]:
    lines = (PROGRAMS / "frames.tsv").read_text(encoding="utf-8").splitlines()[1:]
    programs = {}
    for line in lines:
        name, n_frames, differing, missing = line.split("\t")
        frames = frozenset() if differing == "-" else frozenset(map(int, differing.split(",")))
        programs[name] = Listed(int(n_frames), frames, missing)
    return programs


LISTED = listed_programs()


@pytest.fixture(scope="session")
def traces(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("traces")
    with tarfile.open(PROGRAMS / "programs.tar.xz") as packed:
        packed.extractall(folder, filter="data")
    return folder


def check_frames(trace: Path, listed: Listed, frames: set[int]) -> None:
    """Fail if another frame than those in the list differs, or if one of them does not."""
    compared = compare_trace(trace, sorted(frames))
    differing = {each.frame for each in compared if not each}
    assert differing == listed.differing & frames, "\n".join(map(str, compared))


@pytest.mark.parametrize("name", LISTED)
def test_the_first_and_last_frame_equal_those_of_mesa(name: str, traces: Path) -> None:
    listed = LISTED[name]
    check_frames(traces / f"{name}.trace", listed, {0, listed.n_frames - 1})


@pytest.mark.slow
@pytest.mark.parametrize("name", LISTED)
def test_all_frames_equal_those_of_mesa(name: str, traces: Path) -> None:
    trace, listed = traces / f"{name}.trace", LISTED[name]
    assert len(frames_of(trace).frames) == listed.n_frames
    check_frames(trace, listed, set(range(listed.n_frames)))


@pytest.mark.parametrize("name", SCRIPTS)
def test_the_last_frame_of_a_python_program_equals_that_of_mesa(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    run, program = run_logged(monkeypatch, PROGRAMS / f"{name}.py", **SCRIPTS[name])
    assert not run.warnings
    told = differences(window_of(run), run_on_mesa(program, run.size))
    assert not told, "\n".join(map(str, told))


def test_every_c_program_is_in_the_list_and_has_a_trace(traces: Path) -> None:
    sources = {path.stem for path in PROGRAMS.glob("*.c")}
    assert sources == {path.stem for path in traces.glob("*.trace")} == set(LISTED)
    assert len(sources | set(SCRIPTS)) >= 40


def test_a_program_whose_frames_differ_says_what_is_missing() -> None:
    assert all(bool(listed.differing) == (listed.missing != "-") for listed in LISTED.values())
