"""Comparison with an earlier report, which may come from a machine of another speed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from softshadow.bench.peers import OWN
from softshadow.bench.results import Report, WorkloadResult

TOLERANCE = 0.15  # medians of the same code on an idle machine differ by up to a tenth
SPREADS = 3.0  # a change within three times the spread of both measurements may be noise


@dataclass(frozen=True)
class TimeChange:
    """Change of a workload's time between two reports.

    Attributes
    ----------
    factor : float               time now / time then, corrected for the speeds of the machines; above 1 is slower
    allowed : float              the time counts as the same up to this factor
    verdict : "slower", "same" or "faster"
    """

    workload: str
    threads: int
    factor: float
    allowed: float

    @property
    def verdict(self) -> str:
        """Whether the workload is "slower", "faster" or the "same", within what is allowed."""
        if self.factor > self.allowed:
            return "slower"
        return "faster" if self.factor < 1 / self.allowed else "same"


def time_changes(now: Report, then: Report) -> list[TimeChange]:
    """Return the time changes of all workloads that both reports contain with the same size and amounts.

    With one thread CPU times are compared, because they exclude waiting for other processes; with more threads, wall
    times. Times are scaled by the speed of the machine, measured by the cache-resident stencil loop.
    """
    return [change for workload in now.workloads for change in _time_changes(now, then, workload)]


def _time_changes(now: Report, then: Report, workload: WorkloadResult) -> Iterator[TimeChange]:
    same = [
        each
        for each in then.workloads
        if (each.name, each.size, dict(each.amounts)) == (workload.name, workload.size, dict(workload.amounts))
    ]
    for peer in workload.peers:
        earlier = same[0].times(OWN, peer.threads) if same and peer.renderer == OWN else None
        speed, earlier_speed = now.limit(peer.threads), then.limit(peer.threads)
        if earlier is None or speed is None or earlier_speed is None:
            continue
        clock = "cpu" if peer.threads == 1 else "wall"
        times = getattr(peer, clock), getattr(earlier, clock)
        factor = times[0].median * speed.stencil / (times[1].median * earlier_speed.stencil)
        allowed = 1 + max(TOLERANCE, SPREADS * (times[0].spread + times[1].spread))
        yield TimeChange(workload.name, peer.threads, factor, allowed)
