"""Results of the corpus, and their conversion to and from JSON."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from statistics import geometric_mean
from typing import Any

SCHEMA = "softshadow/bench-corpus/1"


@dataclass(frozen=True)
class ProgramTimes:
    """Times of one program on Mesa's llvmpipe and on softshadow, in milliseconds, with equal numbers of threads.

    Attributes
    ----------
    mesa, own : float            a frame in the steady state
    mesa_first, own_first : float      the first frame of a process, with what the program prepares
    ratio : float                the median of the ratios mesa / own of neighbouring rounds
    differing : number of pixels that differ, by buffer, where Mesa draws without fused multiply-add
    differing_fused : int        number of pixels whose colours differ, where it draws as it was timed
    memory : float or None       largest memory of softshadow's process, MB
    """

    name: str
    size: tuple[int, int]
    threads: int
    mesa: float
    own: float
    ratio: float
    mesa_first: float
    own_first: float
    differing: Mapping[str, int]
    differing_fused: int
    memory: float | None

    @property
    def first_ratio(self) -> float:
        """Mesa's time for the first frame, divided by softshadow's."""
        return self.mesa_first / self.own_first

    @property
    def equal(self) -> bool:
        """Whether all buffers are equal."""
        return not any(self.differing.values())


@dataclass(frozen=True)
class Summary:
    """What the programs have in common: geometric means of their ratios, and the lowest ratio.

    Attributes
    ----------
    steady, first : float        geometric mean of `ratio` and of `first_ratio`
    worst : ProgramTimes         the program with the lowest ratio
    faster : int                 number of programs that are at least as fast as on Mesa
    """

    threads: int
    programs: int
    steady: float
    first: float
    worst: ProgramTimes
    faster: int


def summary(results: Sequence[ProgramTimes]) -> Summary:
    """Return the summary of results with one number of threads."""
    return Summary(
        results[0].threads,
        len(results),
        geometric_mean(each.ratio for each in results),
        geometric_mean(each.first_ratio for each in results),
        min(results, key=lambda each: each.ratio),
        sum(each.ratio >= 1 for each in results),
    )


def by_threads(results: Iterable[ProgramTimes]) -> dict[int, list[ProgramTimes]]:
    """Return the results grouped by number of threads."""
    groups: dict[int, list[ProgramTimes]] = {}
    for each in results:
        groups.setdefault(each.threads, []).append(each)
    return groups


def to_json(results: Sequence[ProgramTimes]) -> dict[str, Any]:
    """Return the results, and a summary for each number of threads, as plain dictionaries and lists."""
    return {
        "programs": [asdict(each) for each in results],
        "summary": [
            {**asdict(each), "worst": each.worst.name, "worst_ratio": each.worst.ratio}
            for each in map(summary, by_threads(results).values())
        ],
    }


def from_json(contents: Mapping[str, Any]) -> list[ProgramTimes]:
    """Return the results of `softshadow bench corpus --json`.

    Raises
    ------
    ValueError                   not such a report
    """
    if not isinstance(contents, Mapping) or contents.get("schema") != SCHEMA:
        raise ValueError(f"expected a file of `softshadow bench corpus --json` ({SCHEMA})")
    try:
        return [ProgramTimes(**{**each, "size": tuple(each["size"])}) for each in contents["programs"]]
    except (KeyError, TypeError) as error:
        raise ValueError(f"incomplete report ({SCHEMA}): {error}") from None
