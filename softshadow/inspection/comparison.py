"""Comparing a visibility with that of another run, or with ray casting."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

WRONG = 0.1  # a larger error looks wrong, a smaller one only rough
JUMP = 0.5  # a larger change of a light's visibility from pixel to pixel is an outline, not a penumbra


@dataclass(frozen=True)
class ErrorSummary:
    """The error over some pixels: their number, its maximum and root mean square, and how many exceed 0.1."""

    pixels: int
    max: float
    rms: float
    wrong: int

    @property
    def wrong_share(self) -> float:
        """The share of the pixels that are off by more than 0.1."""
        return self.wrong / self.pixels if self.pixels else 0.0

    def __str__(self) -> str:
        return f"{self.pixels} pixels, max {self.max:.4g}, RMS {self.rms:.4g}, {self.wrong} off by more than {WRONG:g}"


@dataclass(frozen=True, eq=False, repr=False)
class Comparison:
    """How a visibility differs from a reference.

    Attributes
    ----------
    against : str                name of the reference
    error : (H, W) float32       visibility minus reference, row 0 on top; 0 where one of them is not defined
    compared : (H, W) bool       where both are defined
    band : (H, W) bool           the boundary band: the reference differs between the pixel and its neighbours; for soft
                                 shadows, the visibility of a light differs by more than a half, as at outlines
    lit, umbra, penumbra : (H, W) bool   compared pixels off the band, by the reference: 1, 0, in between
    """

    against: str
    error: np.ndarray
    compared: np.ndarray
    band: np.ndarray
    lit: np.ndarray
    umbra: np.ndarray
    penumbra: np.ndarray

    def part(self, where: np.ndarray) -> ErrorSummary:
        """Return the error over the pixels `where` (H, W) bool."""
        errors = self.error[where].astype(np.float64)
        if not len(errors):
            return ErrorSummary(0, 0.0, 0.0, 0)
        size = np.abs(errors)
        return ErrorSummary(
            len(errors), float(size.max()), float(np.sqrt(np.mean(errors**2))), int((size > WRONG).sum())
        )

    @property
    def max(self) -> float:
        """The largest absolute error over all compared pixels."""
        return self.part(self.compared).max

    @property
    def rms(self) -> float:
        """The root mean square of the error over all compared pixels."""
        return self.part(self.compared).rms

    @property
    def parts(self) -> dict[str, ErrorSummary]:
        """The error over all compared pixels, over lit, umbra and penumbra off the band, and on the band."""
        places = {"all": self.compared, "lit": self.lit, "umbra": self.umbra, "penumbra": self.penumbra}
        return {name: self.part(where) for name, where in (places | {"band": self.band}).items()}

    def __repr__(self) -> str:
        return f"Comparison(against {self.against}: {self.part(self.compared)})"

    def __str__(self) -> str:
        return "\n".join([f"against {self.against}", *(f"{name:>9}: {part}" for name, part in self.parts.items())])


def compare(
    visibility: np.ndarray,
    valid: np.ndarray,
    reference: np.ndarray,
    reference_valid: np.ndarray,
    against: str,
    edges: np.ndarray | None = None,
) -> Comparison:
    """Return how a visibility (H, W) differs from a reference; each has a bool (H, W) of where it is defined.

    The band is where the reference is not uniform, or, of compared pixels, `edges` (H, W) bool.
    """
    compared = valid & reference_valid
    error = np.where(compared, visibility - reference, 0).astype(np.float32)
    if edges is None:
        edges = ~uniform(np.where(reference_valid, reference, np.float32(-1)))
    band = compared & edges
    inner = compared & ~band
    lit, umbra = inner & (reference == 1), inner & (reference == 0)
    penumbra = inner & ~lit & ~umbra
    for array in (error, compared, band, lit, umbra, penumbra):
        array.setflags(write=False)
    return Comparison(against, error, compared, band, lit, umbra, penumbra)


def uniform(values: np.ndarray) -> np.ndarray:
    """Return where a pixel and its eight neighbours have the same value, (H, W) bool: no edge passes within a pixel."""
    return np.logical_and.reduce([shifted == values for shifted in neighbours(values)])


def jumps(values: np.ndarray) -> np.ndarray:
    """Return where values (H, W) of a pixel and its eight neighbours differ by more than a half, (H, W) bool."""
    around = neighbours(values)
    return np.asarray(np.max(around, axis=0) - np.min(around, axis=0) > JUMP)


def neighbours(values: np.ndarray) -> list[np.ndarray]:
    """Return nine arrays: the values (H, W) of each pixel and its eight neighbours, repeated at the border."""
    height, width = values.shape
    framed = np.pad(values, 1, mode="edge")
    return [framed[y : y + height, x : x + width] for y in range(3) for x in range(3)]
