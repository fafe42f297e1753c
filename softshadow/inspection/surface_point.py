"""The point of a surface that a pixel shows, in world space, and on which side of the surface a light stands."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from softshadow.inspection.clipped import ndc_of_pixel, weights_at
from softshadow.inspection.history_row import HistoryRow
from softshadow.inspection.timeline import Event, Timeline
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.draw_primitives import triangles_of
from softshadow.pipeline.geometry.geometry import positions_of
from softshadow.scene import Camera, Light


@dataclass(frozen=True, eq=False)
class SurfacePoint:
    """A point on a triangle, seen by the camera.

    Attributes
    ----------
    point : (3,) float64         world space
    plane : (4,) float64         of the triangle, world space
    eye : (3,) float64
    """

    point: np.ndarray
    plane: np.ndarray
    eye: np.ndarray

    def is_turned_away(self, light: Light) -> bool:
        """Return whether the camera sees the side of the triangle that the light does not reach."""
        at_eye = self.plane[:3] @ self.eye + self.plane[3]
        return bool((self.plane @ light.position) * at_eye <= 0)


def surface_point(timeline: Timeline, row: HistoryRow, x: int, y: int, camera: Camera) -> SurfacePoint | None:
    """Return the point at which a pixel of the window shows the triangle of a row; None for lines and points.

    Parameters
    ----------
    camera : Camera              the one that the row's draw was made with
    """
    event = event_of(timeline, row)
    if event is None or row.triangle is None or row.front_facing is None:
        return None
    command, target = event.command, event.target
    assert isinstance(command, Draw)
    assert target is not None
    with np.errstate(all="ignore"):
        positions = positions_of(command, target)
        corners = triangles_of(command, target, positions.codes, positions.planes, False).corners[row.triangle]
        clip = positions.clip[corners].astype(np.float64)
        weights = weights_at(clip[None], *ndc_of_pixel(command.state.viewport, target, y, x))[0]
    in_object = command.vertices.position[corners].astype(np.float64)
    in_eye_space = (in_object @ command.modelview.astype(np.float64).T)[:, :3]
    world = camera.eye + in_eye_space @ camera.frame
    point = weights @ world
    normal = np.cross(world[1] - world[0], world[2] - world[0])
    if not np.isfinite(point).all() or not normal.any():
        return None
    return SurfacePoint(point, np.append(normal, -normal @ world[0]), camera.eye)


def event_of(timeline: Timeline, row: HistoryRow) -> Event | None:
    """Return the event of a row's draw."""
    if row.draw is None:
        return None
    return next((e for e in timeline.events if e.draw == row.draw and isinstance(e.command, Draw)), None)
