"""Small programs in the style of courses and books, in C and Python: every frame equals that of Mesa.

`programs/` has their sources, and the traces of those in C. `programs/frames.tsv` says how many frames each has.
"""

import tarfile
from pathlib import Path

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


def listed_programs() -> dict[str, int]:
    lines = (PROGRAMS / "frames.tsv").read_text(encoding="utf-8").splitlines()[1:]
    return {name: int(n_frames) for name, n_frames in (line.split("\t") for line in lines)}


LISTED = listed_programs()


@pytest.fixture(scope="session")
def traces(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("traces")
    with tarfile.open(PROGRAMS / "programs.tar.xz") as packed:
        packed.extractall(folder, filter="data")
    return folder


def check_frames(trace: Path, frames: list[int]) -> None:
    compared = compare_trace(trace, frames)
    assert len(compared) == len(frames)
    assert all(compared), "\n".join(map(str, compared))


@pytest.mark.thin(2)
@pytest.mark.parametrize("name", LISTED)
def test_the_first_and_last_frame_equal_those_of_mesa(name: str, traces: Path) -> None:
    check_frames(traces / f"{name}.trace", sorted({0, LISTED[name] - 1}))


@pytest.mark.slow
@pytest.mark.parametrize("name", LISTED)
def test_all_frames_equal_those_of_mesa(name: str, traces: Path) -> None:
    trace = traces / f"{name}.trace"
    assert len(frames_of(trace).frames) == LISTED[name]
    check_frames(trace, list(range(LISTED[name])))


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
