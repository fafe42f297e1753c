"""Lines over the picture: silhouettes, shadow volumes and light frustums, projected to pixels of the window."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from softshadow.scene import Camera, Light, Scene
from softshadow.techniques.light_camera import LightCamera, light_camera
from softshadow.techniques.shadow_volumes import volumes_of

MOST_LINES = 4000  # of one set; of more, evenly spaced ones are shown
MOST_EDGES = 40  # of the volumes, whose long edges would hide the picture
SILHOUETTE, VOLUME, FRUSTUM = "#e69f00", "#56b4e9", "#f0e442"
# techniques whose maps are drawn by one camera per light
ONE_CAMERA = ("map", "map-distance", "map-pcf", "map-silhouette", "map-variance", "map-exponential", "map-pcss")
BOX_EDGES = [(a, b) for a in range(8) for b in range(a + 1, 8) if (a ^ b).bit_count() == 1]


@dataclass(frozen=True)
class Lines:
    """Lines of one kind and light: name, colour, and x0, y0, x1, y1 of each in pixels from the top left corner."""

    name: str
    color: str
    places: list[float]


def wireframe(scene: Scene, size: tuple[int, int], technique: str) -> list[Lines]:
    """Return the lines of every light that can be seen; the edges of volumes go to infinity."""
    sets = []
    for light in scene.lights:
        suffix = f" of {light.name}" if len(scene.lights) > 1 else ""
        silhouettes, sides = _volume_lines(scene, light)
        sets.append((f"silhouettes{suffix}", SILHOUETTE, silhouettes))
        sets.append((f"volume edges{suffix}", VOLUME, sides))
        if technique in ONE_CAMERA:
            sets.append((f"frustum{suffix}", FRUSTUM, frustum_lines(light_camera(scene, light))))
    projected = ((name, color, projected_lines(scene.camera, lines, size)) for name, color, lines in sets)
    return [Lines(name, color, places) for name, color, places in projected if places]


def _volume_lines(scene: Scene, light: Light) -> tuple[np.ndarray, np.ndarray]:
    """Return the silhouettes of all casters, and the lines from their corners away from the light, (N, 2, 4) each."""
    silhouettes, sides = [np.zeros((0, 2, 4))], [np.zeros((0, 2, 4))]
    for item in volumes_of(scene, light):
        corners = item.volume.sides.astype(np.float64) @ item.caster.object_to_world.T
        silhouettes.append(corners[:, :2])
        sides.append(corners[:, 1:3][:: -(-len(corners) // MOST_EDGES) or 1])
    return np.concatenate(silhouettes), np.concatenate(sides)


def frustum_lines(camera: LightCamera) -> np.ndarray:
    """Return the edges of what a light camera sees, (12, 2, 4)."""
    corners = []
    for corner in range(8):
        depth = camera.far if corner & 4 else camera.near
        side = camera.half * (1 if camera.parallel else depth)
        offset = (side if corner & 1 else -side, side if corner & 2 else -side, depth)
        corners.append(np.append(camera.eye + offset @ camera.frame, 1.0))
    return np.array([[corners[a], corners[b]] for a, b in BOX_EDGES])


def projected_lines(camera: Camera, lines: np.ndarray, size: tuple[int, int]) -> list[float]:
    """Return lines (N, 2, 4) between homogeneous world points as x0, y0, x1, y1 ..., cut at the near plane."""
    lines = lines[:: -(-len(lines) // MOST_LINES) or 1]
    eye_space = (lines[..., :3] - lines[..., 3:] * camera.eye) @ camera.frame.T
    before = -eye_space[..., 2] - camera.near * lines[..., 3]  # not negative in front of the near plane
    kept = (before > 0).any(axis=1)
    eye_space, before = eye_space[kept], before[kept]
    with np.errstate(divide="ignore", invalid="ignore"):
        cut = eye_space[:, 0] + (before[:, 0] / (before[:, 0] - before[:, 1]))[:, None] * (
            eye_space[:, 1] - eye_space[:, 0]
        )
        for end in (0, 1):
            eye_space[:, end] = np.where(before[:, end, None] > 0, eye_space[:, end], cut)
        width, height = size
        scale = height / 2 / np.tan(np.radians(camera.fov_y) / 2)
        x = width / 2 + scale * eye_space[..., 0] / -eye_space[..., 2]
        y = height / 2 - scale * eye_space[..., 1] / -eye_space[..., 2]
    places = np.stack([x, y], axis=-1).reshape(-1, 4)
    near_window = np.isfinite(places).all(axis=1) & (np.abs(places) < 100 * max(size)).all(axis=1)
    return [float(value) for value in np.round(places[near_window], 1).reshape(-1)]
