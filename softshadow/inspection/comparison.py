"""Comparing a visibility with that of another run, or with ray casting."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

WRONG = 0.1  # a larger error looks wrong, a smaller one only rough


@dataclass(frozen=True)
class ErrorSummary:
    """The error over some pixels: their number, its maximum and root mean square, and how many exceed 0.1."""

    pixels: int
    max: float
    rms: float
    wrong: int

    def __str__(self) -> str:
        return f"{self.pixels} pixels, max {self.max:.4g}, RMS {self.rms:.4g}, {self.wrong} off by more than {WRONG:g}"


@dataclass(frozen=True, eq=False)
class Comparison:
    """How a visibility differs from a reference.

    Attributes
    ----------
    against : str                name of the reference
    error : (H, W) float32       visibility minus reference, row 0 on top; 0 where one of them is not defined
    compared : (H, W) bool       where both are defined
    band : (H, W) bool           the boundary band: the reference differs between the pixel and its neighbours
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

    def __str__(self) -> str:
        return "\n".join([f"against {self.against}", *(f"{name:>9}: {part}" for name, part in self.parts.items())])


def compare(
    visibility: np.ndarray, valid: np.ndarray, reference: np.ndarray, reference_valid: np.ndarray, against: str
) -> Comparison:
    """Return how a visibility (H, W) differs from a reference; each has a bool (H, W) of where it is defined."""
    compared = valid & reference_valid
    error = np.where(compared, visibility - reference, 0).astype(np.float32)
    band = compared & ~uniform(np.where(reference_valid, reference, np.float32(-1)))
    inner = compared & ~band
    lit, umbra = inner & (reference == 1), inner & (reference == 0)
    penumbra = inner & ~lit & ~umbra
    for array in (error, compared, band, lit, umbra, penumbra):
        array.setflags(write=False)
    return Comparison(against, error, compared, band, lit, umbra, penumbra)


def uniform(values: np.ndarray) -> np.ndarray:
    """Return where a pixel and its eight neighbours have the same value, (H, W) bool: no edge passes within a pixel."""
    height, width = values.shape
    framed = np.pad(values, 1, mode="edge")
    shifted = [framed[y : y + height, x : x + width] == values for y in range(3) for x in range(3)]
    return np.logical_and.reduce(shifted)
