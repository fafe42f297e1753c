"""Whether a workload has become slower than it was in an earlier report, perhaps on a machine of another speed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from softshadow.bench.peers import OWN
from softshadow.bench.results import Report, WorkloadResult

TOLERANCE = 0.15  # between two runs of the same code on a quiet machine medians differ by up to a tenth
SPREADS = 3.0  # a change within three times the spread of both measurements is not told from noise


@dataclass(frozen=True)
class Change:
    """How a workload's time has changed.

    Attributes
    ----------
    factor : float        time now / time then, after the machines' speeds have been divided out; above 1 is slower
    allowed : float       up to this factor it counts as the same
    verdict : "slower", "same" or "faster"
    """

    workload: str
    threads: int
    factor: float
    allowed: float

    @property
    def verdict(self) -> str:
        if self.factor > self.allowed:
            return "slower"
        return "faster" if self.factor < 1 / self.allowed else "same"


def changes(now: Report, then: Report) -> list[Change]:
    """Return the changes of all workloads that both reports have with the same size and amounts.

    Times are CPU times with one thread, where waiting for other processes does not count, and wall times with more.
    They are compared after the speed of the machine, as the cache-resident stencil loop has it.
    """
    return [change for workload in now.workloads for change in _changes(now, then, workload)]


def _changes(now: Report, then: Report, workload: WorkloadResult) -> Iterator[Change]:
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
        yield Change(workload.name, peer.threads, factor, allowed)
