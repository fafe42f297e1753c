"""The camera of a light: a tight view of all casters.

Only what lies behind a caster can be in its shadow, so a frustum round the casters is enough: what lies outside it is
lit. The camera of a spot light looks along its axis and frames its cone instead.
"""

from dataclasses import dataclass

import numpy as np

from softshadow.scene import Light, Scene

# the widest perspective map, as the tangent of half its angle: 60 degrees to each side; a wider one would leave too few
# texels to its middle
WIDEST = np.tan(np.radians(60.0))
# room round the casters, so that their silhouette stays off the border texels
MARGIN = 1.05
# smallest near / far: a light next to a caster keeps half of the 24 bits of depth; for a parallel map the smallest
# width or depth, as a share of the casters' size
NEAREST = 1e-3
# smallest far / near: with planes closer together, depths would be small differences of large float32 numbers
LEAST_RATIO = 2


@dataclass(frozen=True, eq=False)
class LightCamera:
    """A camera of a light, for gluLookAt and gluPerspective or glOrtho.

    Attributes
    ----------
    eye, target, up : (3,) float64
    half : float                 half the side of the map, in world units; for a point light at distance 1
    near, far : float            distances along the view
    parallel : bool
    """

    eye: np.ndarray
    target: np.ndarray
    up: np.ndarray
    half: float
    near: float
    far: float
    parallel: bool

    @property
    def fov(self) -> float:
        """The whole angle of a perspective map, in degrees."""
        return float(2 * np.degrees(np.arctan(self.half)))

    @property
    def frame(self) -> np.ndarray:
        """(3, 3) float64, rows: right, up and forward."""
        return view_frame(self.target - self.eye, self.up)

    def sees(self, points: np.ndarray) -> np.ndarray:
        """Return whether points (..., 3) lie within the four sides of the map; near and far do not matter."""
        right, up, forward = np.moveaxis((points - self.eye) @ self.frame.T, -1, 0)
        side = self.half if self.parallel else self.half * forward
        return (np.abs(right) <= side) & (np.abs(up) <= side) & (self.parallel | (forward > 0))

    def has_behind(self, points: np.ndarray) -> bool:
        """Return whether any of the points (N, 3) lies beside or behind a perspective light, where q ≤ 0."""
        return not self.parallel and bool(((points - self.eye) @ self.frame[2] <= 0).any())


def view_frame(forward: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Return (3, 3), rows: unit right, up and forward, as gluLookAt computes them."""
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, up)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(right, forward), forward])


def light_camera(scene: Scene, light: Light) -> LightCamera:
    """Return the camera of a light that frames the scene's casters.

    A point light among the casters cannot see all of them with one camera: it looks at their middle, 60 degrees to
    each side, and points outside remain unknown (E55).
    """
    vertices = np.concatenate([thing.world_positions for thing in scene.casters or scene.objects])
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    if light.axis is not None:
        return spot_camera(light, vertices)
    forward = -light.position[:3] if light.is_directional else middle - light.position[:3]
    if not forward.any():
        forward = np.array([0.0, -1.0, 0.0])  # a light in the very middle looks down
    up = any_up(forward)
    seen = (vertices - (middle if light.is_directional else light.position[:3])) @ view_frame(forward, up).T
    return (
        parallel_camera(middle, forward, up, seen)
        if light.is_directional
        else point_camera(light, middle, forward, up, seen)
    )


def any_up(forward: np.ndarray) -> np.ndarray:
    """Return the world axis that is farthest from a view direction, to serve as its up."""
    up: np.ndarray = np.eye(3)[np.abs(forward).argmin()]
    return up


def parallel_camera(middle: np.ndarray, forward: np.ndarray, up: np.ndarray, seen: np.ndarray) -> LightCamera:
    """Return the camera of a directional light; `seen` are the casters' vertices in its view, round the middle."""
    size = float(np.abs(seen).max())
    half = MARGIN * max(float(np.abs(seen[:, :2]).max()), NEAREST * size)
    depth = MARGIN * max(float(np.abs(seen[:, 2]).max()), NEAREST * size)
    eye = middle - 2 * depth * forward / np.linalg.norm(forward)
    return LightCamera(eye, middle, up, half, depth, 3 * depth, parallel=True)


def point_camera(
    light: Light, middle: np.ndarray, forward: np.ndarray, up: np.ndarray, seen: np.ndarray
) -> LightCamera:
    """Return the camera of a point light; `seen` are the casters' vertices in its view."""
    depth = seen[:, 2]
    near, far = near_and_far(seen)
    with np.errstate(divide="ignore", invalid="ignore"):
        tangents = np.where(depth[:, None] > 0, np.abs(seen[:, :2]) / depth[:, None], np.inf)
    half = min(MARGIN * float(tangents.max()), WIDEST)
    eye = light.position[:3]
    return LightCamera(eye, eye + forward, up, half, near, far, parallel=False)


def spot_camera(light: Light, vertices: np.ndarray) -> LightCamera:
    """Return the camera of a spot light: its map is the square round its cone, at most 60 degrees to each side."""
    assert light.axis is not None
    eye, up = light.position[:3], any_up(light.axis)
    near, far = near_and_far((vertices - eye) @ view_frame(light.axis, up).T)
    half = min(float(np.tan(np.radians(light.cutoff))), WIDEST)
    return LightCamera(eye, eye + light.axis, up, half, near, far, parallel=False)


def near_and_far(seen: np.ndarray) -> tuple[float, float]:
    """Return the near and the far distance for the casters' vertices (N, 3), which are in the light's view."""
    far = MARGIN * float(np.linalg.norm(seen, axis=1).max())
    return min(max(float(seen[:, 2].min()) / MARGIN, NEAREST * far), far / LEAST_RATIO), far
