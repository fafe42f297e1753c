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
    right = cross(forward, up)
    right /= np.linalg.norm(right)
    return np.array([right, cross(right, forward), forward])


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the cross product of two vectors: of single ones, np.cross takes ten times as long."""
    (ax, ay, az), (bx, by, bz) = a.tolist(), b.tolist()
    return np.array([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])


def light_camera(scene: Scene, light: Light) -> LightCamera:
    """Return the camera of a light that frames the scene's casters.

    A point light among the casters cannot see all of them with one camera: it looks at their middle, 60 degrees to
    each side, and points outside remain unknown (E55).
    """
    return camera_around(caster_vertices(scene), light)


def caster_vertices(scene: Scene) -> np.ndarray:
    """Return the world positions of the vertices that the cameras of lights frame, as columns (3, V)."""
    vertices = np.concatenate([thing.world_positions for thing in scene.casters or scene.objects])
    return np.ascontiguousarray(vertices.T)  # rows along which loops are vectorised


def camera_around(vertices: np.ndarray, light: Light) -> LightCamera:
    """Return the camera of a light that frames vertices (3, V)."""
    middle = (vertices.min(axis=1) + vertices.max(axis=1)) / 2
    if light.axis is not None:
        return spot_camera(light, vertices)
    forward = -light.position[:3] if light.is_directional else middle - light.position[:3]
    if not forward.any():
        forward = np.array([0.0, -1.0, 0.0])  # a light in the very middle looks down
    up = any_up(forward)
    seen = in_view(vertices, middle if light.is_directional else light.position[:3], forward, up)
    return (
        parallel_camera(middle, forward, up, seen)
        if light.is_directional
        else point_camera(light, middle, forward, up, seen)
    )


def in_view(vertices: np.ndarray, eye: np.ndarray, forward: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Return vertices (3, V) in the view from a point."""
    seen: np.ndarray = view_frame(forward, up) @ (vertices - eye[:, None])
    return seen


def any_up(forward: np.ndarray) -> np.ndarray:
    """Return the world axis that is farthest from a view direction, to serve as its up."""
    up: np.ndarray = np.eye(3)[np.abs(forward).argmin()]
    return up


def parallel_camera(middle: np.ndarray, forward: np.ndarray, up: np.ndarray, seen: np.ndarray) -> LightCamera:
    """Return the camera of a directional light; `seen` are the casters' vertices in its view, round the middle."""
    size = float(np.abs(seen).max())
    half = MARGIN * max(float(np.abs(seen[:2]).max()), NEAREST * size)
    depth = MARGIN * max(float(np.abs(seen[2]).max()), NEAREST * size)
    eye = middle - 2 * depth * forward / np.linalg.norm(forward)
    return LightCamera(eye, middle, up, half, depth, 3 * depth, parallel=True)


def point_camera(
    light: Light, middle: np.ndarray, forward: np.ndarray, up: np.ndarray, seen: np.ndarray
) -> LightCamera:
    """Return the camera of a point light; `seen` are the casters' vertices in its view."""
    near, far = near_and_far(seen)
    half = WIDEST
    if (seen[2] > 0).all():
        half = min(MARGIN * float((np.abs(seen[:2]) / seen[2]).max()), WIDEST)
    eye = light.position[:3]
    return LightCamera(eye, eye + forward, up, half, near, far, parallel=False)


def spot_camera(light: Light, vertices: np.ndarray) -> LightCamera:
    """Return the camera of a spot light: its map is the square round its cone, at most 60 degrees to each side."""
    assert light.axis is not None
    eye, up = light.position[:3], any_up(light.axis)
    near, far = near_and_far(in_view(vertices, eye, light.axis, up))
    half = min(float(np.tan(np.radians(light.cutoff))), WIDEST)
    return LightCamera(eye, eye + light.axis, up, half, near, far, parallel=False)


def near_and_far(seen: np.ndarray) -> tuple[float, float]:
    """Return the near and the far distance for the casters' vertices (3, V), which are in the light's view."""
    far = MARGIN * float(np.sqrt((seen * seen).sum(axis=0).max()))
    return min(max(float(seen[2].min()) / MARGIN, NEAREST * far), far / LEAST_RATIO), far
