"""Ground truth: visibility by ray casting in float64, independent of the pipeline's arithmetic."""

from softshadow.truth.light_visibility import LightVisibility, light_classes, light_visibility
from softshadow.truth.ray_cast import casting_faces_between, first_faces

__all__ = ["LightVisibility", "casting_faces_between", "first_faces", "light_classes", "light_visibility"]
