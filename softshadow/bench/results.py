"""Results of a benchmark, and their form in JSON.

All times are in seconds. A spread is half the distance between the quartiles, relative to the median.
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
    """Median and spread of several measurements."""

    median: float
    spread: float

    @classmethod
    def of(cls, values: Sequence[float]) -> Summary:
        """Return the median and spread of one or more values.

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
    """Times of one peer for a workload.

    Attributes
    ----------
    renderer, threads            see `Peer`
    prepare, first : float       preparation, and the first frame (in a process that has drawn before)
    wall, cpu : Summary          one frame in the steady state
    """

    renderer: str
    threads: int
    prepare: float
    first: float
    wall: Summary
    cpu: Summary


@dataclass(frozen=True)
class Ratio:
    """Time of another renderer divided by softshadow's time, with the same number of threads.

    Ratios are taken between consecutive frames, so background load hits both. The ratio of CPU times excludes waiting:
    it compares the amount of work, not the time until the result.
    """

    renderer: str
    threads: int
    wall: Summary
    cpu: Summary


@dataclass(frozen=True)
class WorkloadResult:
    """All results for one workload.

    Attributes
    ----------
    draws, triangles : int       numbers per frame, before clipping and culling
    fragments : int              number per frame, including those that fail a test
    differing : number of pixels that differ from softshadow's, by renderer and buffer: {"llvmpipe": {"color": 0 ...}}
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
        """Whether llvmpipe, and softshadow with other numbers of threads, left the same buffers as softshadow."""
        exact = (self.differing.get(renderer, {}) for renderer in ("softshadow", "llvmpipe"))
        return not any(pixels for buffers in exact for pixels in buffers.values())

    def times(self, renderer: str, threads: int) -> PeerTimes | None:
        """Return the times of one peer, or None if it was not measured."""
        return next((each for each in self.peers if (each.renderer, each.threads) == (renderer, threads)), None)


@dataclass(frozen=True)
class Limits:
    """Limits of the machine with a number of threads.

    triad : bytes a second       a = b + s c on arrays larger than every cache
    stencil : fragments a second depth test and stencil update on buffers that stay in the cache
    """

    threads: int
    triad: float
    stencil: float


@dataclass(frozen=True)
class Report:
    """All results of one benchmark."""

    machine: Mapping[str, Any]
    limits: tuple[Limits, ...]
    workloads: tuple[WorkloadResult, ...]
    starts: Mapping[str, Mapping[str, float]] = field(default_factory=dict)

    def limit(self, threads: int) -> Limits | None:
        """Return the limits with a number of threads."""
        return next((each for each in self.limits if each.threads == threads), None)

    def share(self, workload: WorkloadResult, threads: int) -> float | None:
        """Return softshadow's fragments per second, relative to the cache-resident stencil loop."""
        times, limit = workload.times("softshadow", threads), self.limit(threads)
        return workload.fragments / times.wall.median / limit.stencil if times and limit else None


def to_json(report: Report) -> dict[str, Any]:
    """Return a report as plain dictionaries and lists."""
    return {"schema": SCHEMA, **asdict(report)}


def from_json(contents: Mapping[str, Any]) -> Report:
    """Return the report that `to_json` has converted.

    Raises
    ------
    ValueError                   not a report, or a report of another schema
    """
    if not isinstance(contents, Mapping) or contents.get("schema") != SCHEMA:
        raise ValueError(f"expected a file of `softshadow bench --json` ({SCHEMA})")
    try:
        return Report(
            contents["machine"],
            tuple(Limits(**each) for each in contents["limits"]),
            tuple(_workload(each) for each in contents["workloads"]),
            contents["starts"],
        )
    except (KeyError, TypeError) as error:
        raise ValueError(f"incomplete report ({SCHEMA}): {error}") from None


def _workload(contents: Mapping[str, Any]) -> WorkloadResult:
    peers = tuple(PeerTimes(**{**each, **_summaries(each)}) for each in contents["peers"])
    ratios = tuple(Ratio(**{**each, **_summaries(each)}) for each in contents["ratios"])
    return WorkloadResult(**{**contents, "size": tuple(contents["size"]), "peers": peers, "ratios": ratios})


def _summaries(contents: Mapping[str, Any]) -> dict[str, Summary]:
    return {key: Summary(**contents[key]) for key in ("wall", "cpu")}


def ratio_of(renderer: str, threads: int, ours: Sequence[Timing], theirs: Sequence[Timing]) -> Ratio:
    """Return the ratio of their times to ours, from interleaved frames."""
    pairs = list(zip(ours, theirs, strict=True))
    return Ratio(
        renderer,
        threads,
        Summary.of([other.wall / own.wall for own, other in pairs]),
        Summary.of([other.cpu / own.cpu for own, other in pairs]),
    )
