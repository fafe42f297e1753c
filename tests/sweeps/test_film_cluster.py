"""Films on several processes and on a cluster: the same bytes, and nothing drawn twice after an interruption."""

import json
import signal
from pathlib import Path

import pytest

from sweeps.clusters import PATIENCE, lines_of, processes, wait_until

pytestmark = pytest.mark.slow

FILM = (
    "animate", "map", "--scene", "boxes", "--size", "96x72", "--light-path", "orbit", "--vary", "map_size=16..128:log",
    "--show", "color", "--show", "depth", "--steps",
)  # fmt: skip


def test_film_is_the_same_bytes_on_one_process_a_local_cluster_and_a_scheduler(tmp_path: Path) -> None:
    film = (*FILM, "--frames", "12", "-o")
    with processes(tmp_path) as started:
        _, address = started.scheduler("first")
        workers = [started.worker(address) for _ in range(2)]
        ways = {"here": (), "local": ("--workers", "2"), "remote": ("--scheduler", address)}
        for name, words in ways.items():
            client = started.start("softshadow", *film, f"{name}.webp", *words)
            assert client.wait(PATIENCE) == 0, started.log(client)
        assert [worker.poll() for worker in workers] == [None, None]
    here, local, remote = ((tmp_path / f"{name}.webp").read_bytes() for name in ways)
    assert here == local == remote
    assert list(tmp_path.glob("*.film-*")) == []  # the journals are not needed any more


@pytest.mark.parametrize("workers", ["1", "2"])
def test_interrupted_film_goes_on_and_no_frame_is_drawn_twice(workers: str, tmp_path: Path) -> None:
    film = (*FILM, "--frames", "150", "-o", "film.png", "--workers")
    journal = tmp_path / "film.film-journal"
    with processes(tmp_path) as started:
        client = started.start("softshadow", *film, workers)
        wait_until(lambda: len(lines_of(journal)) >= 5 or client.poll() is not None, "five frames")
        assert client.poll() is None, started.log(client)
        client.send_signal(signal.SIGINT)
        assert client.wait(PATIENCE) == 130
        assert "interrupted" in started.log(client)
        assert "Traceback" not in started.log(client)
        safe = lines_of(journal)
        assert 5 <= len(safe) < 150
        client = started.start("softshadow", *film, "1")
        assert client.wait(PATIENCE) == 3
        assert "an earlier journal is here; expected --resume" in started.log(client)
        client = started.start("softshadow", *film, "1", "--resume")
        seen: list[bytes] = []
        while client.poll() is None:
            seen = max(seen, lines_of(journal), key=len)
        assert client.wait(PATIENCE) == 0, started.log(client)
    assert seen[: len(safe)] == safe
    keys = [json.loads(line)["key"] for line in seen]
    assert len(keys) == len(set(keys)) <= 150
    assert (tmp_path / "film.png").exists()
    assert not journal.exists()
