"""The near rectangle, where the line of sight of every pixel begins, and the volumes around its points.

Z-pass counts what lies behind such a point, so it has to start from the number of volumes around it, which is the
number of casting faces between the point and the light. It is 0 in most scenes; else it may differ between pixels.
"""

from collections.abc import Sequence

import numpy as np

from softshadow import matrices
from softshadow.scene import Camera, Light, Scene, SceneObject
from softshadow.scene.shadow_volume import casting_faces
from softshadow.techniques.clipping import clip_to_planes_with_sources, pyramid_between
from softshadow.truth import casting_faces_between

# under GL_DEPTH_CLAMP the near plane clips nothing, so the count starts next to the eye
AT_THE_EYE = 1e-6
# sine of the angle to the near plane below which flattening enlarges rounding errors of float32 to pixels
EDGE_ON = 1e-6


def start_points(camera: Camera, window: np.ndarray, size: tuple[int, int], far: str) -> np.ndarray:
    """Return the points (N, 3) float64 where lines of sight through window positions (N, 2) begin, y from the top."""
    points = camera.near_points(window, size)
    return camera.eye + AT_THE_EYE * (points - camera.eye) if far == "clamp" else points


def corners(camera: Camera, size: tuple[int, int], far: str) -> np.ndarray:
    """Return the corners (4, 3) float64 of the near rectangle, in order."""
    width, height = size
    return start_points(camera, np.array([[0, height], [width, height], [width, 0], [0, 0]], np.float64), size, far)


def near_counts(
    scene: Scene, light: Light, casters: Sequence[SceneObject], size: tuple[int, int], far: str
) -> np.ndarray:
    """Return how many volumes contain the point where each pixel's line of sight begins, (h, w) int32.

    The first row is the bottom one.
    """
    width, height = size
    reaching = [caster for caster in casters if shadows_near_rectangle(caster, light, scene.camera, size, far)]
    if not reaching:
        return np.zeros((height, width), np.int32)
    return counts_by_rays(scene.camera, light, reaching, size, far)


def counts_by_rays(
    camera: Camera, light: Light, casters: Sequence[SceneObject], size: tuple[int, int], far: str
) -> np.ndarray:
    """Return the same as `near_counts`, by casting a ray to the light from each point of the near rectangle."""
    width, height = size
    x, y = np.meshgrid(np.arange(width) + 0.5, height - (np.arange(height) + 0.5))
    points = start_points(camera, np.stack([x.ravel(), y.ravel()], axis=1), size, far)
    return casting_faces_between(points, light.position, casters).reshape(height, width)


def eye_count(scene: Scene, light: Light, casters: Sequence[SceneObject]) -> int:
    """Return how many volumes contain the eye."""
    return int(casting_faces_between(scene.camera.eye[None], light.position, casters)[0])


def faces_before(caster: SceneObject, light: Light, rectangle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the parts of casting faces between the light and a rectangle (4, 3).

    Returns
    -------
    (N, 3, 3) float64            in world space
    (N,) int                     the face of the caster's mesh that each is a part of
    """
    faces = casting_faces(caster.mesh, light.in_object_space(caster.object_to_world))
    numbers = np.concatenate([faces.facing, faces.reversed])
    triangles = caster.world_positions[caster.mesh.triangles[numbers]]
    parts, sources = clip_to_planes_with_sources(triangles, pyramid_between(light.position, rectangle))
    return parts, numbers[sources]


def seen_edge_on(light: Light, rectangle: np.ndarray) -> bool:
    """Return whether the light sees a rectangle (4, 3) as a line, or nearly: there is no pyramid between them then."""
    normal = np.cross(rectangle[1] - rectangle[0], rectangle[2] - rectangle[1])
    towards = light.position[:3] - light.position[3] * rectangle.mean(axis=0)
    return bool(abs(normal @ towards) <= EDGE_ON * np.linalg.norm(normal) * np.linalg.norm(towards))


def shadows_near_rectangle(caster: SceneObject, light: Light, camera: Camera, size: tuple[int, int], far: str) -> bool:
    """Return whether a casting face stands between the light and a point of the near rectangle.

    It does exactly if the volume contains or cuts the rectangle, so that the count is not 0 everywhere on it.
    """
    rectangle = corners(camera, size, far)
    if seen_edge_on(light, rectangle):
        return bool(counts_by_rays(camera, light, [caster], size, far).any())
    return len(faces_before(caster, light, rectangle)[0]) > 0


def near_cap(caster: SceneObject, light: Light, camera: Camera, size: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Return the casting faces flattened by S(Λ) onto the near rectangle, (N, 3, 3) float32 in eye space.

    The second array (N,) has the face of the caster's mesh that each is a part of.

    A point of the rectangle is in as many volumes as triangles cover it. They are flattened in double precision:
    float32 matrices are wrong by a pixel when the near plane is close to the eye.
    """
    world_to_eye = np.eye(4)
    world_to_eye[:3, :3] = camera.frame
    world_to_eye[:3, 3] = -camera.frame @ camera.eye
    plane = np.array([0, 0, 1, camera.near])
    faces, numbers = faces_before(caster, light, corners(camera, size, "infinite"))
    matrix = matrices.planar_shadow(plane, world_to_eye @ light.position) @ world_to_eye
    flattened = faces @ matrix[:, :3].T + matrix[:, 3]
    return np.ascontiguousarray(flattened[..., :3] / flattened[..., 3:], np.float32), numbers
