"""How fast errors fall with the number of light samples: the slope in a plot with logarithmic axes."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from softshadow.errors import SoftShadowError
from softshadow.inspection.soft_truth import SoftTruth
from softshadow.scene import Scene
from softshadow.soft.technique_errors import error_of

SAMPLES = (4, 9, 16, 36, 64, 144)  # squares, so that grids are square
PATTERNS = ("grid", "jittered", "sobol", "random")


@dataclass(frozen=True)
class Convergence:
    """The RMS error of a technique for several numbers of samples.

    Attributes
    ----------
    technique, pattern : str
    samples : tuple of int
    rms : tuple of float
    """

    technique: str
    pattern: str
    samples: tuple[int, ...]
    rms: tuple[float, ...]

    @property
    def slope(self) -> float:
        """The exponent: the RMS error falls like ``samples ** slope``, fitted by least squares of the logarithms."""
        return float(np.polyfit(np.log(self.samples), np.log(self.rms), 1)[0])


def convergence(
    scene: Scene,
    truth: SoftTruth,
    technique: str = "volume-sampled",
    patterns: Sequence[str] = PATTERNS,
    samples: Sequence[int] = SAMPLES,
    seeds: int = 3,
) -> list[Convergence]:
    """Return how the error of a sampling technique falls, for each pattern; random ones are the mean over seeds.

    Raises
    ------
    ValueError                   a technique that does not sample lights, or an unknown pattern
    """
    found = []
    for pattern in patterns:
        n_seeds = 1 if pattern == "grid" else seeds
        errors = [
            [
                error_of(scene, truth, technique, samples=n, pattern=pattern, seed=seed).comparison.rms
                for seed in range(n_seeds)
            ]
            for n in samples
        ]
        rms = tuple(float(np.sqrt(np.mean(np.square(each)))) for each in errors)
        found.append(Convergence(technique, pattern, tuple(samples), rms))
    return found


def save_convergence_plot(results: Sequence[Convergence], path: str | os.PathLike[str]) -> Path:
    """Draw the errors over the number of samples, with the fitted slopes; the file name's suffix sets the format.

    Raises
    ------
    SoftShadowError              matplotlib is not installed; the message says how to install it
    """
    try:
        from matplotlib.figure import Figure
    except ModuleNotFoundError:
        raise SoftShadowError("the plot needs matplotlib: pip install 'softshadow[notebook]'") from None
    figure: Any = Figure(figsize=(6, 4), layout="constrained")
    axes = figure.subplots()
    for result in results:
        (line,) = axes.loglog(result.samples, result.rms, "o")
        fitted = np.polyfit(np.log(result.samples), np.log(result.rms), 1)
        label = f"{result.technique}, {result.pattern}: slope {fitted[0]:.2f}"
        axes.loglog(result.samples, np.exp(np.polyval(fitted, np.log(result.samples))), color=line.get_color(),
                    label=label)  # fmt: skip
    axes.set_xlabel("samples of the light")
    axes.set_ylabel("RMS error of the visibility")
    axes.grid(alpha=0.4, which="both")
    axes.legend()
    figure.savefig(path)
    return Path(path)
