"""The order of a measurement: compare buffers, warm up, then time interleaved frames."""

import numpy as np
import pytest

from bench.small_workloads import small
from softshadow.bench import measuring
from softshadow.bench.limits import measure_limits
from softshadow.bench.measuring import measure
from softshadow.bench.peers import Peer
from softshadow.bench.plain_loops import stencil_sweeps
from softshadow.testing.timing import Timing

OURS, THEIRS = Peer("softshadow"), Peer("llvmpipe")


class FakeSession:
    """A session that draws nothing and records the calls of its methods."""

    def __init__(self, name: str, seconds: float, value: int, calls: list[str]) -> None:
        self.name, self.value, self.calls = name, value, calls
        self.timing = Timing(seconds, seconds)
        self.prepared = self.timing

    def time(self, repeats: int = 1) -> list[Timing]:
        self.calls.append(f"{self.name} draws")
        return [self.timing] * repeats

    def warm_up(self) -> None:
        self.calls.append(f"{self.name} warms up")

    def buffers(self) -> dict[str, np.ndarray]:
        self.calls.append(f"{self.name} is read")
        return {"stencil": np.full((2, 3), self.value, np.uint8)}

    def close(self) -> None:
        self.calls.append(f"{self.name} is closed")


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Make sessions of OURS take 1 s and hold 5, those of THEIRS 4 s and 6; return the list of their calls."""
    recorded: list[str] = []
    sessions = {OURS: ("we", 1.0, 5), THEIRS: ("they", 4.0, 6)}
    monkeypatch.setattr(measuring.Peer, "open", lambda peer, workload: FakeSession(*sessions[peer], recorded))
    return recorded


def test_frames_are_drawn_in_turns_after_the_buffers_were_compared(calls: list[str]) -> None:
    measure(small("w4"), [OURS, THEIRS], rounds=2)
    assert calls == [
        "we draws", "they draws", "we is read", "we is read", "they is read", "we warms up", "they warms up",
        "we draws", "they draws", "we draws", "they draws", "they is closed", "we is closed",
    ]  # fmt: skip


def test_result_has_ratios_and_differing_pixels(calls: list[str]) -> None:
    result = measure(small("w4"), [OURS, THEIRS], rounds=3)
    assert result.differing == {"softshadow": {"stencil": 0}, "llvmpipe": {"stencil": 6}}
    assert not result.equal
    (ratio,) = result.ratios
    assert (ratio.renderer, ratio.threads, ratio.wall.median, ratio.cpu.median) == ("llvmpipe", 1, 4.0, 4.0)
    assert result.draws == 10
    assert result.fragments > 0


def test_limits_are_positive_for_each_number_of_threads() -> None:
    for threads in (1, 2):
        limits = measure_limits(threads)
        assert limits.threads == threads
        assert min(limits.triad, limits.stencil) > 0


def test_stencil_loop_counts_where_z_passes() -> None:
    depth, stencil = np.array([0.1, 0.5, 0.9], np.float32), np.zeros(3, np.uint8)
    stencil_sweeps(depth, stencil, np.array([0.4, 0.6], np.float32), 5)
    assert stencil.tolist() == [0, 3, 5]
