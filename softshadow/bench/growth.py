"""Growth of the frame time with one amount: time = c amount^p, with p fitted by least squares of the logarithms.

The course's statements about cost are statements about p: the time of a stencil fill grows with the number of pixels,
shadow volumes with the length of the silhouette and not with the number of triangles, every technique with the lights.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from softshadow.bench import technique_frame
from softshadow.bench.results import WorkloadResult
from softshadow.bench.workload import Workload
from softshadow.errors import nearest

AXES = ("resolution", "triangles", "samples", "lights", "kind")
SHARES = (1 / 16, 1 / 4, 1.0)  # of the pixels, the triangles or the samples
LIGHTS = (1, 2, 4, 8)


@dataclass(frozen=True)
class Growth:
    """Results of a workload at several amounts, and the fitted exponent for each renderer and number of threads.

    Attributes
    ----------
    axis : one of `AXES`: the amount that varies
    amounts : one per result; for axis "kind" strings of `technique_frame.KINDS`, without exponents
    exponents : {"softshadow@1": p ...}
    """

    workload: str
    axis: str
    amounts: tuple[float | str, ...]
    results: tuple[WorkloadResult, ...]
    exponents: dict[str, float]


def series(workload: Workload, axis: str) -> list[tuple[float | str, Workload]]:
    """Return pairs of an amount and the workload with this amount, along one axis.

    Raises
    ------
    ValueError                   the axis is unknown, or the workload does not have it
    """
    if axis not in AXES:
        raise ValueError(f"--scaling {axis}: {nearest(axis, AXES)}")
    if axis == "resolution":
        return [_resolution(workload, share) for share in SHARES]
    if axis in ("triangles", "samples") and axis in workload.amounts:
        numbers = [max(1, round(workload.amounts[axis] * share)) for share in SHARES]
        return [(number, workload.with_amounts(**{axis: number})) for number in numbers]
    if workload.prepare is technique_frame.prepare and axis == "lights":
        return [(number, workload.with_amounts(lights=number, kind="outside")) for number in LIGHTS]
    if workload.prepare is technique_frame.prepare and axis == "kind":
        return [(kind, workload.with_amounts(lights=1, kind=kind)) for kind in technique_frame.KINDS[1:]]
    own = [each for each in AXES if each == "resolution" or each in workload.amounts]
    if workload.prepare is technique_frame.prepare:
        own += ["lights", "kind"]
    raise ValueError(f"--scaling {axis}: workload {workload.name} has {', '.join(own)}")


def _resolution(workload: Workload, share: float) -> tuple[float, Workload]:
    width, height = (max(1, round(side * share**0.5)) for side in workload.size)
    return width * height, workload.resized((width, height))


def growth(workload: str, axis: str, amounts: Sequence[float | str], results: Sequence[WorkloadResult]) -> Growth:
    """Return the growth of a series of results, with an exponent for each peer."""
    exponents = {}
    if axis != "kind":
        for peer in results[0].peers:
            seconds = [_median(result, peer.renderer, peer.threads) for result in results]
            exponents[f"{peer.renderer}@{peer.threads}"] = exponent([float(a) for a in amounts], seconds)
    return Growth(workload, axis, tuple(amounts), tuple(results), exponents)


def _median(result: WorkloadResult, renderer: str, threads: int) -> float:
    times = result.times(renderer, threads)
    assert times is not None  # all results of a series have the same peers
    return times.wall.median


def exponent(amounts: Sequence[float], seconds: Sequence[float]) -> float:
    """Return the exponent p of the fit seconds = c amounts^p.

    Examples
    --------
    >>> round(exponent([1, 2, 4], [3.0, 12.0, 48.0]), 6)
    2.0
    """
    return float(np.polyfit(np.log(amounts), np.log(seconds), 1)[0])
