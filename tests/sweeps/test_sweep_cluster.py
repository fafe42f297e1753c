"""What a cluster may lose: workers, the scheduler, the client. Nothing that was reported is lost or measured twice."""

import json
import shutil
import signal
from pathlib import Path

import pytest

import softshadow as ss
from paths import SCENES
from sweeps.clusters import PATIENCE, lines_of, processes, wait_until

pytestmark = pytest.mark.slow

SWEEP = """
technique = ["map", "volume-zfail", "blob"]
scene = ["boxes", "torus", "crate.obj"]
size = ["64x48", "80x60"]
measure = ["hard", "counts", "time"]
frames = 3
picture = true
[options]
map_size = [32, 64, 128]
[light.circle]
center = [0, 4, 0]
radius = 2
count = 3
"""
POINTS = 90  # 3 scenes, 2 sizes, 3 lights; map three times
CHANGING = {"first_frame_ms", "frame_ms", "frame_min_ms", "core_alone", "load_1min", "machine"}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Return a folder with the sweep file and a model that it names."""
    (tmp_path / "sweep.toml").write_text(SWEEP)
    shutil.copy(SCENES / "crate.obj", tmp_path)
    return tmp_path


def steady(path: Path) -> list[dict[str, object]]:
    """Return the rows of a table without times and machine."""
    return [{k: v for k, v in row.items() if k not in CHANGING} for row in ss.load_sweep(path).rows]


def pictures(path: Path) -> dict[str, bytes]:
    return {file.name: file.read_bytes() for file in path.with_suffix(".pictures").iterdir()}


def test_nothing_is_lost_when_a_worker_and_then_the_scheduler_are_killed(folder: Path) -> None:
    journal = folder / "remote.journal"
    with processes(folder) as started:
        scheduler, address = started.scheduler("first")
        workers = [started.worker(address) for _ in range(2)]
        client = started.sweep("sweep.toml", "-o", "remote.csv", "--scheduler", address)
        wait_until(lambda: len(lines_of(journal)) >= 5 or client.poll() is not None, "five points")
        started.kill_session(workers[0])
        before = len(lines_of(journal))
        wait_until(lambda: len(lines_of(journal)) >= before + 15 or client.poll() is not None, "fifteen more points")
        assert client.poll() is None, started.log(client)
        started.kill_session(scheduler)
        assert client.wait(PATIENCE) == 3
        assert "the scheduler is lost" in started.log(client)
        assert "Traceback" not in started.log(client)
        safe = journal.read_bytes()
        assert before + 15 <= len(lines_of(journal)) < POINTS

        _, address = started.scheduler("second")
        started.worker(address)
        client = started.sweep("sweep.toml", "-o", "remote.csv", "--scheduler", address, "--resume")
        assert client.wait(PATIENCE) == 0, started.log(client)
        here = started.sweep("sweep.toml", "-o", "here.csv", "--workers", "1")
        local = started.sweep("sweep.toml", "-o", "local.csv", "--workers", "2")
        assert here.wait(PATIENCE) == local.wait(PATIENCE) == 0, started.log(local)
    assert journal.read_bytes().startswith(safe)
    keys = [json.loads(line)["key"] for line in lines_of(journal)]
    assert len(keys) == len(set(keys)) == POINTS
    assert steady(folder / "remote.csv") == steady(folder / "here.csv") == steady(folder / "local.csv")
    assert pictures(folder / "remote.csv") == pictures(folder / "here.csv") == pictures(folder / "local.csv")
    assert len(pictures(folder / "here.csv")) == POINTS


@pytest.mark.parametrize("signals", ["interrupt", "kill"])
def test_sweep_of_a_client_that_ended_goes_on(folder: Path, signals: str) -> None:
    journal = folder / "table.journal"
    with processes(folder) as started:
        client = started.sweep("sweep.toml", "-o", "table.csv", "--workers", "2")
        wait_until(lambda: len(lines_of(journal)) >= 5 or client.poll() is not None, "five points")
        assert client.poll() is None, started.log(client)
        if signals == "kill":
            client.kill()
            client.wait(PATIENCE)
        else:
            client.send_signal(signal.SIGINT)
            assert client.wait(PATIENCE) == 130
            assert "interrupted" in started.log(client)
            assert "Traceback" not in started.log(client)
        safe = lines_of(journal)
        assert 5 <= len(safe) < POINTS
        client = started.sweep("sweep.toml", "-o", "table.csv", "--workers", "1", "--resume")
        assert client.wait(PATIENCE) == 0, started.log(client)
    assert lines_of(journal)[: len(safe)] == safe
    assert len(lines_of(journal)) == len(ss.load_sweep(folder / "table.csv")) == POINTS


def test_point_that_needs_too_much_memory_becomes_a_row_and_its_neighbours_are_measured(tmp_path: Path) -> None:
    (tmp_path / "sweep.toml").write_text(
        'technique = "blob"\nscene = "boxes"\nmeasure = ["counts"]\n'
        'size = ["160x120", "64x48", "5000x5000", "80x60", "96x72"]\n'
    )
    with processes(tmp_path) as started:
        _, address = started.scheduler("first")
        started.worker(address, memory_limit="800MB")
        client = started.sweep("sweep.toml", "-o", "table.csv", "--scheduler", address)
        assert client.wait(PATIENCE) == 1, started.log(client)
    rows = ss.load_sweep(tmp_path / "table.csv").rows
    assert [row["status"] for row in rows] == ["ok", "ok", "error", "ok", "ok"]
    assert "it may need more memory than they have" in rows[2]["error"]
