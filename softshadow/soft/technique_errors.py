"""The errors of all techniques on one scene, at an equal number of light samples or in equal time."""

from __future__ import annotations

import time
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from softshadow import techniques
from softshadow.errors import Warning as SoftShadowWarning
from softshadow.inspection.comparison import Comparison
from softshadow.inspection.pictures import contact_sheet, visibility_picture
from softshadow.inspection.soft_truth import SoftTruth
from softshadow.runs import Run, run
from softshadow.scene import Scene

# hard techniques for comparison, then what draws soft edges or soft shadows
HARD = ("volume-zfail", "map")
SOFT = (
    "planar-accumulated", "planar-nested", "volume-sampled", "volume-wedges", "map-pcf", "map-pcss", "map-variance",
    "map-exponential", "map-sampled",
)  # fmt: skip
MOST_SAMPLES = 1024


@dataclass(frozen=True, eq=False)
class TechniqueError:
    """How far a technique is from the truth.

    Attributes
    ----------
    technique : str
    options : dict               those that differ from the defaults
    seconds : float              of the second drawing, the steps' maps included; the first may compile; 0 if not timed
    comparison : Comparison      its error map, and its figures split by umbra, penumbra and lit
    run : Run
    """

    technique: str
    options: Mapping[str, Any]
    seconds: float
    comparison: Comparison
    run: Run

    @property
    def label(self) -> str:
        """The technique with its options, as on the command line."""
        return " ".join([self.technique, *(f"{key}={value}" for key, value in self.options.items())])


def soft_candidates() -> tuple[str, ...]:
    """Return the techniques that a comparison takes: two hard ones, and all that draw soft edges."""
    return tuple(name for name in (*HARD, *SOFT) if name in techniques.names())


def compare_techniques(
    scene: Scene,
    truth: SoftTruth,
    names: Sequence[str] | None = None,
    *,
    samples: int = 16,
    seconds: float | None = None,
) -> list[TechniqueError]:
    """Return the error of each technique against the truth of a scene.

    Parameters
    ----------
    truth : SoftTruth            of the scene; its size is that of the pictures
    names : sequence of str      techniques; `soft_candidates` by default
    samples : int                points of each light, for techniques that sample lights
    seconds : float              if given, they take as many points as they can draw in this time instead

    Raises
    ------
    ValueError                   an unknown technique, or numbers that are not positive
    """
    if samples < 1 or (seconds is not None and seconds <= 0):
        raise ValueError(f"samples={samples}, seconds={seconds}: expected positive numbers")
    results = []
    for name in soft_candidates() if names is None else names:
        if "samples" not in techniques.get(name).options:
            results.append(error_of(scene, truth, name))
        elif seconds is None:
            results.append(error_of(scene, truth, name, samples=samples))
        else:
            results.append(error_in_time(scene, truth, name, seconds))
    return results


def error_of(scene: Scene, truth: SoftTruth, name: str, **options: Any) -> TechniqueError:
    """Return the error of one technique; it is drawn twice and timed the second time."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SoftShadowWarning)  # the errors that they announce are measured
        run(name, scene, truth.size, **options)
        start = time.perf_counter()
        drawn = run(name, scene, truth.size, **options)
        elapsed = time.perf_counter() - start
    return TechniqueError(name, options, elapsed, drawn.compare(truth=truth), drawn)


def error_in_time(scene: Scene, truth: SoftTruth, name: str, seconds: float, **options: Any) -> TechniqueError:
    """Return the error of a sampling technique with the most samples that it draws in a time: a power of two."""
    found = error_of(scene, truth, name, samples=1, **options)
    while found.seconds < seconds and found.options["samples"] < MOST_SAMPLES:
        following = error_of(scene, truth, name, **options | {"samples": 2 * found.options["samples"]})
        if following.seconds > seconds:
            break
        found = following
    return found


def contact_sheet_of(results: Sequence[TechniqueError]) -> np.ndarray:
    """Return a picture (H, W, 3) uint8: for each technique its image, its visibility and its error.

    The error is red where there is too much light, blue where there is too little, and white where there is none.
    """
    rows = []
    for result in results:
        parts = result.comparison.parts
        timed = f"{result.seconds:.2f} s, " if result.seconds else ""
        title = f"{result.label}: {timed}RMS {parts['all'].rms:.3f}"
        visibility = visibility_picture(result.run.visibility, result.run.valid)
        rows.append((title, [result.run.image, visibility, error_picture(result.comparison.error)]))
    return contact_sheet(rows)


def error_picture(error: np.ndarray) -> np.ndarray:
    """Return signed errors (H, W) from -1 to 1 as colours (H, W, 3) uint8: blue, white, red."""
    size = np.clip(np.abs(error), 0, 1)[..., None]
    color = np.where(error[..., None] > 0, np.array([178.0, 24.0, 43.0]), np.array([33.0, 102.0, 172.0]))
    return np.rint(255 + (color - 255) * np.sqrt(size)).astype(np.uint8)
