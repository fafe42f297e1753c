"""What all techniques draw with: the camera, the light, objects by vertex arrays, and the read-out of buffers.

Every draw is inside a debug group with the name of its object, so that a recorded or traced frame says what it drew.
"""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np

from softshadow import matrices
from softshadow.errors import SceneError
from softshadow.scene import Camera, Light, Scene, SceneObject

MOST_LIGHTS = 8


def column_major(matrix: np.ndarray) -> np.ndarray:
    """Return a matrix in the memory order of glMultMatrixd."""
    return np.ascontiguousarray(np.asarray(matrix, np.float64).T)


# -- frame and camera --------------------------------------------------------------------------------------------------


def begin_frame(gl: Any, scene: Scene) -> None:
    """Clear all buffers (E61: nothing but glClear does) and set the state that a frame starts from.

    Raises
    ------
    SceneError                   more lights than GL has (GL_LIGHT0 to GL_LIGHT7)
    """
    if len(scene.lights) > MOST_LIGHTS:
        raise SceneError(f"scene {scene.name}: {len(scene.lights)} lights; expected at most {MOST_LIGHTS}, as GL has")
    gl.glClearColor(*scene.background, 1.0)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glDepthFunc(gl.GL_LESS)
    gl.glEnable(gl.GL_NORMALIZE)  # object_to_world may scale


def set_camera(gl: Any, camera: Camera, size: tuple[int, int], far: str = "finite") -> None:
    """Set viewport, projection and view.

    `far` is "finite", "infinite" (a projection without a far plane) or "clamp" (GL_DEPTH_CLAMP: neither the near nor
    the far plane clips).
    """
    width, height = size
    gl.glViewport(0, 0, width, height)
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.glLoadIdentity()
    if far == "infinite":
        gl.glMultMatrixd(column_major(matrices.infinite_perspective(camera.fov_y, width / height, camera.near)))
    else:
        gl.gluPerspective(camera.fov_y, width / height, camera.near, camera.far)
    if far == "clamp":
        gl.glEnable(gl.GL_DEPTH_CLAMP)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glLoadIdentity()
    gl.gluLookAt(*camera.eye, *camera.target, *camera.up)


# -- light -------------------------------------------------------------------------------------------------------------


def light_ambient_only(gl: Any, scene: Scene) -> None:
    """Switch every light off but the ambient light: surfaces are drawn as they look in shadow."""
    gl.glEnable(gl.GL_LIGHTING)
    gl.glLightModelfv(gl.GL_LIGHT_MODEL_AMBIENT, (*scene.ambient, 1.0))
    for index in range(len(scene.lights)):
        gl.glDisable(gl.GL_LIGHT0 + index)


def light_by(gl: Any, scene: Scene, lights: Iterable[Light], ambient: bool, cones: bool = True) -> None:
    """Switch on some of the scene's lights and no others; the modelview matrix has to be the view.

    A pass that is added to an earlier one must not add the ambient light again (`ambient` = False). GL computes light
    at vertices, so the cone of a spot light shows on finely divided surfaces only; with `cones` = False the lights have
    no cone, and the caller cuts it out.
    """
    light_ambient_only(gl, scene)
    if not ambient:
        gl.glLightModelfv(gl.GL_LIGHT_MODEL_AMBIENT, (0.0, 0.0, 0.0, 1.0))
    for index, light in enumerate(scene.lights):
        if any(light is other for other in lights):
            gl.glEnable(gl.GL_LIGHT0 + index)
            gl.glLightfv(gl.GL_LIGHT0 + index, gl.GL_POSITION, tuple(float(v) for v in light.position))
            for term in (gl.GL_DIFFUSE, gl.GL_SPECULAR):
                gl.glLightfv(gl.GL_LIGHT0 + index, term, (*light.color, 1.0))
            if light.is_attenuated:
                for term, factor in zip(attenuation_terms(gl), light.attenuation, strict=True):
                    gl.glLightf(gl.GL_LIGHT0 + index, term, float(factor))
            if light.axis is not None and cones:
                gl.glLightfv(gl.GL_LIGHT0 + index, gl.GL_SPOT_DIRECTION, tuple(float(v) for v in light.axis))
                gl.glLightf(gl.GL_LIGHT0 + index, gl.GL_SPOT_CUTOFF, light.cutoff)


def attenuation_terms(gl: Any) -> tuple[int, int, int]:
    """Return the tokens of the three factors of attenuation."""
    return gl.GL_CONSTANT_ATTENUATION, gl.GL_LINEAR_ATTENUATION, gl.GL_QUADRATIC_ATTENUATION


@contextmanager
def additive_blending(gl: Any) -> Iterator[None]:
    """Add colours to those in the buffer, at the pixels that show the surface which is drawn."""
    gl.glEnable(gl.GL_BLEND)
    gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)
    gl.glDepthFunc(gl.GL_LEQUAL)  # E2: the second draw has equal depth
    gl.glDepthMask(gl.GL_FALSE)
    yield
    gl.glDepthMask(gl.GL_TRUE)
    gl.glDepthFunc(gl.GL_LESS)
    gl.glDisable(gl.GL_BLEND)


def darken_picture(gl: Any, share: float) -> None:
    """Take a share of every colour away where the stencil test passes, with a rectangle over the picture."""
    for mode in (gl.GL_PROJECTION, gl.GL_MODELVIEW):
        gl.glMatrixMode(mode)
        gl.glPushMatrix()
        gl.glLoadIdentity()
    gl.glDisable(gl.GL_LIGHTING)
    gl.glDisable(gl.GL_DEPTH_TEST)
    gl.glEnable(gl.GL_BLEND)
    gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA)
    gl.glColor4f(0.0, 0.0, 0.0, share)
    with made_of(gl, "rectangle over the picture", ""):
        gl.glRectf(-1.0, -1.0, 1.0, 1.0)
    gl.glDisable(gl.GL_BLEND)
    gl.glEnable(gl.GL_DEPTH_TEST)
    for mode in (gl.GL_PROJECTION, gl.GL_MODELVIEW):
        gl.glMatrixMode(mode)
        gl.glPopMatrix()


def title(text: str, scene: Scene, light: Light) -> str:
    """Return the title of a step or a map, with the light's name if the scene has several lights."""
    return text if len(scene.lights) == 1 else f"{text}: {light.name}"


# -- objects -----------------------------------------------------------------------------------------------------------


@contextmanager
def object_space(gl: Any, thing: SceneObject) -> Iterator[None]:
    """Draw in the space of an object, in a debug group with its name."""
    with debug_group(gl, thing):
        gl.glPushMatrix()
        gl.glMultMatrixd(column_major(thing.object_to_world))
        yield
        gl.glPopMatrix()


@contextmanager
def debug_group(gl: Any, thing: SceneObject) -> Iterator[None]:
    """Draw in a debug group with the name of an object."""
    gl.glPushDebugGroup(gl.GL_DEBUG_SOURCE_APPLICATION, 0, -1, thing.name)
    yield
    gl.glPopDebugGroup()


@contextmanager
def made_of(
    gl: Any,
    part: str,
    feature: str = "face",
    numbers: Any = None,
    casters: Sequence[SceneObject] = (),
    owners: Any = None,
) -> Iterator[None]:
    """Say what the primitives drawn inside are made of, for pixel histories; see `gl.describe_primitives`."""
    describe = getattr(gl, "describe_primitives", None)  # other namespaces have no histories
    if describe is None:
        yield
        return
    describe(part, feature, numbers, [caster.name for caster in casters], owners)
    yield
    describe("")


def draw_objects(gl: Any, objects: Iterable[SceneObject], emission: bool = True) -> None:
    """Draw objects with normals and materials, for passes with lighting.

    A pass that is added to an earlier one must not add what the objects emit again (`emission` = False).
    """
    for thing in objects:
        with object_space(gl, thing):
            set_material(gl, thing, emission)
            draw_mesh(gl, thing, shaded=True)


def draw_shapes(gl: Any, objects: Iterable[SceneObject]) -> None:
    """Draw objects by their positions alone, for passes without lighting."""
    for thing in objects:
        with object_space(gl, thing):
            draw_mesh(gl, thing, shaded=False)


def set_material(gl: Any, thing: SceneObject, emission: bool = True) -> None:
    """Set an object's reflectances, and what it emits, or that it emits nothing."""
    material = thing.material
    gl.glMaterialfv(gl.GL_FRONT_AND_BACK, gl.GL_AMBIENT_AND_DIFFUSE, (*material.color, 1.0))
    gl.glMaterialfv(gl.GL_FRONT_AND_BACK, gl.GL_SPECULAR, (*material.specular, 1.0))
    gl.glMaterialf(gl.GL_FRONT_AND_BACK, gl.GL_SHININESS, material.shininess)
    gl.glMaterialfv(gl.GL_FRONT_AND_BACK, gl.GL_EMISSION, (*(material.emission if emission else (0.0, 0.0, 0.0)), 1.0))


def draw_mesh(gl: Any, thing: SceneObject, shaded: bool, texture_coordinates: np.ndarray | None = None) -> None:
    """Draw an object's mesh; every pass sends the same positions in the same order, so its depths are the same bits.

    `texture_coordinates` (V, 3) float32 go through the texture matrix.
    """
    mesh = thing.mesh
    if shaded:
        gl.glEnableClientState(gl.GL_NORMAL_ARRAY)
        gl.glNormalPointer(gl.GL_FLOAT, 0, mesh.normals)
    if shaded and mesh.colors is not None:
        gl.glEnable(gl.GL_COLOR_MATERIAL)
        gl.glEnableClientState(gl.GL_COLOR_ARRAY)
        gl.glColorPointer(4, gl.GL_FLOAT, 0, mesh.colors)
    if texture_coordinates is not None:
        gl.glEnableClientState(gl.GL_TEXTURE_COORD_ARRAY)
        gl.glTexCoordPointer(3, gl.GL_FLOAT, 0, texture_coordinates)
    draw_triangles(gl, mesh.positions, mesh.triangles)
    gl.glDisableClientState(gl.GL_TEXTURE_COORD_ARRAY)
    gl.glDisableClientState(gl.GL_COLOR_ARRAY)
    gl.glDisable(gl.GL_COLOR_MATERIAL)
    gl.glDisableClientState(gl.GL_NORMAL_ARRAY)


def draw_triangles(gl: Any, positions: np.ndarray, triangles: np.ndarray) -> None:
    """Draw triangles (T, 3) int32 over positions (V, 3) or homogeneous (V, 4) float32."""
    if len(triangles) == 0:
        return
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(positions.shape[1], gl.GL_FLOAT, 0, positions)
    gl.glDrawElements(gl.GL_TRIANGLES, triangles.size, gl.GL_UNSIGNED_INT, triangles.view(np.uint32))
    gl.glDisableClientState(gl.GL_VERTEX_ARRAY)


def draw_polygons(gl: Any, polygons: np.ndarray) -> None:
    """Draw triangles (N, 3, k) or quads (N, 4, k) float32 that share no vertices; k = 4 is homogeneous."""
    if len(polygons) == 0:
        return
    number, corners, components = polygons.shape
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glVertexPointer(components, gl.GL_FLOAT, 0, polygons)
    gl.glDrawArrays(gl.GL_TRIANGLES if corners == 3 else gl.GL_QUADS, 0, number * corners)
    gl.glDisableClientState(gl.GL_VERTEX_ARRAY)


@contextmanager
def texture_attached(gl: Any, attachment: int, texture: int, target: int | None = None) -> Iterator[None]:
    """Draw into a texture, the only attachment of a framebuffer object.

    `target` names the face if the texture is a cube map.
    """
    framebuffer = gl.glGenFramebuffers(1)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, framebuffer)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, attachment, target or gl.GL_TEXTURE_2D, texture, 0)
    if attachment == gl.GL_DEPTH_ATTACHMENT:
        gl.glDrawBuffer(gl.GL_NONE)
        gl.glReadBuffer(gl.GL_NONE)
    yield
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
    gl.glDeleteFramebuffers(1, [framebuffer])


# -- read-out ----------------------------------------------------------------------------------------------------------


def read_depth(gl: Any, size: tuple[int, int]) -> np.ndarray:
    """Return the depth buffer, (h, w) float32, first row = bottom."""
    return gl.glReadPixels(0, 0, *size, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)


def read_stencil(gl: Any, size: tuple[int, int]) -> np.ndarray:
    """Return the stencil buffer, (h, w) uint8, first row = bottom."""
    return gl.glReadPixels(0, 0, *size, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)


def read_alpha(gl: Any, size: tuple[int, int]) -> np.ndarray:
    """Return the alpha of the colour buffer, (h, w) float32 from 0 to 1, first row = bottom."""
    return gl.glReadPixels(0, 0, *size, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)[:, :, 3].astype(np.float32) / np.float32(255)


def world_points(scene: Scene, depth: np.ndarray, size: tuple[int, int], far: str = "finite") -> np.ndarray:
    """Return the world points that the camera sees, computed from their window depths; first row = bottom.

    Parameters
    ----------
    depth : (h, w) float32
    far : str                    as given to `set_camera`

    Returns
    -------
    (h, w, 3) float64            infinite where nothing was drawn with an infinite projection
    """
    width, height = size
    camera = scene.camera
    x, y = np.meshgrid(np.arange(width) + 0.5, height - (np.arange(height) + 0.5))  # near_points counts from the top
    near_points = camera.near_points(np.stack([x.ravel(), y.ravel()], axis=1), size)
    # window depth d belongs to the distance n·f / (f - d·(f - n)) along the view, the near rectangle to n
    nearness = 1 - depth.astype(np.float64) * (1 if far == "infinite" else 1 - camera.near / camera.far)
    with np.errstate(divide="ignore"):
        points: np.ndarray = camera.eye + (near_points - camera.eye).reshape(height, width, 3) / nearness[..., None]
    return points


def within_cone(scene: Scene, light: Light, depth: np.ndarray, size: tuple[int, int], far: str = "finite") -> Any:
    """Return where a light shines if nothing is in its way: (h, w) bool for a spot light, True for any other.

    The arguments are those of `world_points`.
    """
    if not light.is_spot:
        return True
    with np.errstate(invalid="ignore"):  # a point at infinity is in no cone
        return light.shines_on(world_points(scene, depth, size, far))


def visibility_maps(scene: Scene, lit: list[np.ndarray], valid: np.ndarray) -> dict[str, np.ndarray]:
    """Return maps of the visibility of the lights so far, 1 lit and 0 in shadow.

    Parameters
    ----------
    lit : one (h, w) per light so far, in the scene's order; bool, or float32 from 0 in shadow to 1 lit
    valid : (h, w) bool          where visibility is defined; elsewhere the maps hold 1

    Returns
    -------
    dict                         "visibility of NAME" float32 for each light so far, if the scene has several; after the
                                 last light "visibility" (the mean over the lights) and "valid"
    """
    visibilities = [np.where(valid, pixels, True).astype(np.float32) for pixels in lit]
    maps = {}
    if len(scene.lights) > 1:
        names = [f"visibility of {light.name}" for light in scene.lights]
        maps = dict(zip(names, visibilities, strict=False))
    if len(lit) == len(scene.lights):
        maps |= {"visibility": np.mean(visibilities, axis=0, dtype=np.float32), "valid": valid}
    return maps
