"""Ground truth: visibility by ray casting in float64, independent of the pipeline's arithmetic."""

from softshadow.truth.ray_cast import casting_faces_between, first_faces

__all__ = ["casting_faces_between", "first_faces"]
