"""The geometry of shadows in space: silhouettes, volumes, light frusta, wedges, and the line of sight of a pixel."""

from softshadow.space.geometry_record import ShadowGeometry
from softshadow.space.model_writing import EXTENSIONS, trimesh_scene, write_model
from softshadow.space.pieces import Edges, Surface
from softshadow.space.shadow_parts import geometry_of_run, shadow_geometry
from softshadow.space.sight_lines import FaceCrossing, LineOfSight, line_of_sight

__all__ = [
    "EXTENSIONS",
    "Edges",
    "FaceCrossing",
    "LineOfSight",
    "ShadowGeometry",
    "Surface",
    "geometry_of_run",
    "line_of_sight",
    "shadow_geometry",
    "trimesh_scene",
    "write_model",
]
