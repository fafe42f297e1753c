"""What a benchmark found, as values that go into JSON and come back.

All times are seconds. A spread is half the distance between the quartiles, relative to the median.
"""

from __future__ import annotations

import statistics
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from softshadow.testing.timing import Timing

SCHEMA = "softshadow/bench/1"


@dataclass(frozen=True)
class Summary:
    """Median and spread of a few measurements."""

    median: float
    spread: float

    @classmethod
    def of(cls, values: Sequence[float]) -> Summary:
        """Return the summary of at least one value.

        Examples
        --------
        >>> Summary.of([2.0, 1.0, 3.0, 2.0])
        Summary(median=2.0, spread=0.125)
        """
        middle = statistics.median(values)
        if len(values) < 2 or middle == 0:
            return cls(middle, 0.0)
        low, _, high = statistics.quantiles(values, n=4, method="inclusive")
        return cls(middle, (high - low) / 2 / middle)


@dataclass(frozen=True)
class PeerTimes:
    """How long one peer took for a workload.

    Attributes
    ----------
    renderer, threads            see `Peer`
    prepare, first : float       what the program took to set up, and its first frame (of a process that is warm)
    wall, cpu : Summary          a frame in the steady state
    """

    renderer: str
    threads: int
    prepare: float
    first: float
    wall: Summary
    cpu: Summary


@dataclass(frozen=True)
class Ratio:
    """How many times as long as softshadow another renderer takes, with equally many threads.

    Each is the median of the ratios of neighbouring frames: what else the machine does meets both. The ratio of CPU
    times does not see waiting; it says how much work is done, not how soon.
    """

    renderer: str
    threads: int
    wall: Summary
    cpu: Summary


@dataclass(frozen=True)
class WorkloadResult:
    """All that was found about a workload.

    Attributes
    ----------
    draws, triangles : int       of a frame, as handed in
    fragments : int              of a frame, those that fail a test included
    differing : pixels that differ from softshadow's, per renderer and buffer: {"llvmpipe": {"color": 0 ...}}
    """

    name: str
    size: tuple[int, int]
    amounts: Mapping[str, Any]
    aim: float | None
    draws: int
    triangles: int
    fragments: int
    differing: Mapping[str, Mapping[str, int]]
    peers: tuple[PeerTimes, ...]
    ratios: tuple[Ratio, ...]

    @property
    def equal(self) -> bool:
        """Whether llvmpipe, whose bits softshadow follows, and other numbers of threads left the same buffers."""
        followed = (self.differing.get(renderer, {}) for renderer in ("softshadow", "llvmpipe"))
        return not any(count for buffers in followed for count in buffers.values())

    def times(self, renderer: str, threads: int) -> PeerTimes | None:
        """Return the times of one peer, or None where it did not take part."""
        return next((each for each in self.peers if (each.renderer, each.threads) == (renderer, threads)), None)


@dataclass(frozen=True)
class Limits:
    """What the machine can do with a number of threads, measured in the same run.

    triad : bytes a second       a = b + s c over arrays larger than every cache
    stencil : fragments a second depth test and stencil update over planes that stay in the cache
    """

    threads: int
    triad: float
    stencil: float


@dataclass(frozen=True)
class Report:
    """A whole run of the benchmark."""

    machine: Mapping[str, Any]
    limits: tuple[Limits, ...]
    workloads: tuple[WorkloadResult, ...]
    starts: Mapping[str, Mapping[str, float]] = field(default_factory=dict)

    def limit(self, threads: int) -> Limits | None:
        """Return the limits with a number of threads."""
        return next((each for each in self.limits if each.threads == threads), None)

    def share(self, workload: WorkloadResult, threads: int) -> float | None:
        """Return softshadow's fragments a second over those of the cache-resident stencil loop."""
        times, limit = workload.times("softshadow", threads), self.limit(threads)
        return workload.fragments / times.wall.median / limit.stencil if times and limit else None


def to_json(report: Report) -> dict[str, Any]:
    """Return a report as plain dictionaries and lists."""
    return {"schema": SCHEMA, **asdict(report)}


def from_json(found: Mapping[str, Any]) -> Report:
    """Return the report that `to_json` was given.

    Raises
    ------
    ValueError                   not a report, or one of another form
    """
    if not isinstance(found, Mapping) or found.get("schema") != SCHEMA:
        raise ValueError(f"expected a file of `softshadow bench --json` ({SCHEMA})")
    try:
        return Report(
            found["machine"],
            tuple(Limits(**each) for each in found["limits"]),
            tuple(_workload(each) for each in found["workloads"]),
            found["starts"],
        )
    except (KeyError, TypeError) as error:
        raise ValueError(f"a report of {SCHEMA} that is not whole: {error}") from None


def _workload(found: Mapping[str, Any]) -> WorkloadResult:
    peers = tuple(PeerTimes(**{**each, **_summaries(each)}) for each in found["peers"])
    ratios = tuple(Ratio(**{**each, **_summaries(each)}) for each in found["ratios"])
    return WorkloadResult(**{**found, "size": tuple(found["size"]), "peers": peers, "ratios": ratios})


def _summaries(found: Mapping[str, Any]) -> dict[str, Summary]:
    return {key: Summary(**found[key]) for key in ("wall", "cpu")}


def ratio_of(renderer: str, threads: int, ours: Sequence[Timing], theirs: Sequence[Timing]) -> Ratio:
    """Return the ratio of frames that were drawn in turns."""
    pairs = list(zip(ours, theirs, strict=True))
    return Ratio(
        renderer,
        threads,
        Summary.of([other.wall / own.wall for own, other in pairs]),
        Summary.of([other.cpu / own.cpu for own, other in pairs]),
    )
