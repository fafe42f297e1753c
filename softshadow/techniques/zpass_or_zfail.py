"""Z-pass or z-fail, chosen for each caster, or for each pixel by a plane through the caster's volume.

Both add the same number to the same stencil buffer, so each volume may be counted either way, even pixel by pixel, as
long as z-pass counts only volumes that do not reach the near rectangle. For those it may start from 0, and it needs no
light cap.

The plane: z-pass changes no value where the surface lies in front of the volume, z-fail none where it lies behind. A
plane inside the volume tells the two apart. Ours is the polar plane of the eye about the cone that the light throws
behind the caster's bounding sphere: a line of sight that enters the cone and leaves it again crosses the plane in
between. The caster's own lit faces, where the volume begins, lie in front of it on both sides of the plane.

Paper: Everitt & Kilgard 2002, sec. 4.3 (for each caster); Laine 2005, "Split-plane shadow volumes" (for tiles of
pixels, by the hardware; here the plane itself is drawn, and the depth test compares it with every pixel).
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Annotated, Any, Literal

import numpy as np

from softshadow.scene import Light, Scene, SceneObject
from softshadow.techniques import drawing, shadow_volumes, start_value
from softshadow.techniques.near_rectangle import shadows_near_rectangle
from softshadow.techniques.shadow_volumes import CasterVolume, draw_volumes
from softshadow.techniques.technique import Steps

Choose = Annotated[
    Literal["zpass", "zfail", "per-caster", "split-plane"],
    "count all volumes where the depth test passes, or all where it fails; per-caster: where it fails only for casters "
    "between the light and the near rectangle; split-plane: for each pixel, whichever changes fewer stencil values",
]


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    generator: shadow_volumes.Generator,
    cap: shadow_volumes.Cap,
    reach: shadow_volumes.Reach,
    far: shadow_volumes.Far,
    ops: shadow_volumes.Ops,
    two_sided: shadow_volumes.TwoSided,
    choose: Choose,
    closed: bool = True,
) -> Steps:
    """Draw the scene with shadow volumes, each counted as `choose` says; the options are those of z-pass and z-fail."""
    # step 1 (Pasul 1): the colours of the scene in shadow, and the depth of what is visible
    drawing.begin_frame(gl, scene)
    drawing.set_camera(gl, scene.camera, size, far)
    drawing.light_ambient_only(gl, scene)
    drawing.draw_objects(gl, scene.objects)
    depth = drawing.read_depth(gl, size)
    valid = depth < 1
    yield "draw the scene without the light"

    up, down = shadow_volumes.counting_ops(gl, ops)
    counting = Counting(up, down, two_sided, caps=closed, finite=closed and cap == "finite")
    lit = []
    for light in scene.lights:
        volumes = shadow_volumes.volumes_of(scene, light, generator, cap, reach)
        near = [shadows_near_rectangle(item.caster, light, scene.camera, size, far) for item in volumes]

        # steps 2 and 3 (Pasul 2 and 3), of z-pass for some volumes and of z-fail for the others
        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glEnable(gl.GL_CULL_FACE)
        gl.glDepthMask(gl.GL_FALSE)
        gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
        gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
        gl.glDisable(gl.GL_LIGHTING)
        if choose == "split-plane":
            yield from count_by_split_planes(gl, scene, light, list(zip(volumes, near, strict=True)), counting, size)
        else:
            by_zfail = [choose == "zfail" or (choose == "per-caster" and reaches_near) for reaches_near in near]
            passing = [item for item, fails in zip(volumes, by_zfail, strict=True) if not fails]
            start_value.warn_of_a_wrong_start(scene, light, [item.caster for item in passing], "none", size, far)
            counting.where_passing(gl, passing)
            yield drawing.title("count where the depth test passes", scene, light)
            counting.where_failing(gl, [item for item, fails in zip(volumes, by_zfail, strict=True) if fails])
            yield drawing.title("count where the depth test fails", scene, light)

        # step 4 (Pasul 4): the lit part of the scene, where the count is 0
        lit.append(shadow_volumes.lit_pixels(gl, scene, light, depth, size, far, ops))
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
        gl.glStencilFunc(gl.GL_EQUAL, 0, 0xFF)  # E38: all bits of the count, not only the last
        gl.glDepthMask(gl.GL_TRUE)
        gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
        gl.glDisable(gl.GL_CULL_FACE)  # E3: or only back faces of the scene are drawn
        drawing.light_by(gl, scene, [light], ambient=False)
        with drawing.additive_blending(gl):
            drawing.draw_objects(gl, scene.objects, emission=False)
        gl.glDisable(gl.GL_STENCIL_TEST)
        yield (
            drawing.title("add the light where the count is 0", scene, light),
            drawing.visibility_maps(scene, lit, valid),
        )


@dataclass(frozen=True)
class Counting:
    """How volumes are counted: the stencil operations up and down, in one pass or two, and with which caps."""

    up: int
    down: int
    two_sided: bool
    caps: bool
    finite: bool

    def where_passing(self, gl: Any, volumes: Iterable[CasterVolume]) -> None:
        """Count up at front faces and down at back faces where the depth test passes.

        The only cap that can pass is a finite dark cap.
        """
        caps = {"light_caps": False, "dark_caps": self.finite}
        if self.two_sided:
            gl.glDisable(gl.GL_CULL_FACE)
            gl.glStencilOpSeparate(gl.GL_FRONT, gl.GL_KEEP, gl.GL_KEEP, self.up)
            gl.glStencilOpSeparate(gl.GL_BACK, gl.GL_KEEP, gl.GL_KEEP, self.down)
            draw_volumes(gl, volumes, **caps)
            return
        for culled, op in ((gl.GL_BACK, self.up), (gl.GL_FRONT, self.down)):
            gl.glCullFace(culled)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, op)
            draw_volumes(gl, volumes, **caps)

    def where_failing(self, gl: Any, volumes: Iterable[CasterVolume]) -> None:
        """Count up at back faces and down at front faces where the depth test fails."""
        caps = {"light_caps": self.caps, "dark_caps": self.caps}
        if self.two_sided:
            gl.glDisable(gl.GL_CULL_FACE)
            gl.glStencilOpSeparate(gl.GL_BACK, gl.GL_KEEP, self.up, gl.GL_KEEP)
            gl.glStencilOpSeparate(gl.GL_FRONT, gl.GL_KEEP, self.down, gl.GL_KEEP)
            draw_volumes(gl, volumes, **caps)
            return
        for culled, op in ((gl.GL_FRONT, self.up), (gl.GL_BACK, self.down)):
            gl.glCullFace(culled)
            gl.glStencilOp(gl.GL_KEEP, op, gl.GL_KEEP)
            draw_volumes(gl, volumes, **caps)


def count_by_split_planes(
    gl: Any,
    scene: Scene,
    light: Light,
    volumes: list[tuple[CasterVolume, bool]],
    counting: Counting,
    size: tuple[int, int],
) -> Steps:
    """Count volumes one by one; each comes with whether it reaches the near rectangle.

    The highest bit of the stencil buffer marks what lies behind the split plane, the bits below it count.

    Raises
    ------
    ValueError                   saturating counters, which cannot stop below the mark; a stencil buffer of one bit
    """
    if counting.up != gl.GL_INCR_WRAP:
        raise ValueError(
            "choose='split-plane' with ops='saturate': the highest stencil bit holds a mark, so that counters below it "
            "cannot stop; expected ops='wrap'"
        )
    bits = int(gl.glGetIntegerv(gl.GL_STENCIL_BITS))
    if bits < 2:
        raise ValueError(
            f"choose='split-plane' with {bits} stencil bit: expected one for the mark and one or more to count"
        )
    mark = 2 ** (bits - 1)
    width, height = size
    by_zfail = np.zeros((height, width), np.uint8)
    for item, reaches_near in volumes:
        plane = split_plane(item.caster, light, scene.camera.eye)
        gl.glStencilMask(mark)
        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        if plane is not None and not reaches_near:
            mark_behind(gl, item, plane, mark)
            by_zfail += drawing.read_stencil(gl, size) & mark != 0
            yield drawing.title(f"mark what lies behind the split plane of {item.caster.name}", scene, light)
        gl.glStencilMask(mark - 1)
        if reaches_near:
            gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
            counting.where_failing(gl, [item])
            by_zfail += 1
        else:
            gl.glStencilFunc(gl.GL_EQUAL, 0, mark)
            counting.where_passing(gl, [item])
            gl.glStencilFunc(gl.GL_EQUAL, mark, mark)
            counting.where_failing(gl, [item])
        name = drawing.title("volumes counted by z-fail", scene, light)
        yield drawing.title(f"count the volume of {item.caster.name}", scene, light), {name: by_zfail.copy()}
    gl.glStencilMask(mark)
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    gl.glStencilMask(0xFF)


def mark_behind(gl: Any, item: CasterVolume, plane: np.ndarray, mark: int) -> None:
    """Set the mark where the visible surface lies behind a plane, except on the caster's own lit faces."""
    gl.glDisable(gl.GL_CULL_FACE)
    gl.glStencilFunc(gl.GL_ALWAYS, mark, 0xFF)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    with drawing.debug_group(gl, item.caster), drawing.made_of(gl, "split plane", "", casters=[item.caster]):
        drawing.draw_polygons(gl, whole_plane(plane))
    gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
    gl.glDepthFunc(gl.GL_EQUAL)
    draw_volumes(gl, [item], sides=False, dark_caps=False)
    gl.glDepthFunc(gl.GL_LESS)
    gl.glEnable(gl.GL_CULL_FACE)


def split_plane(caster: SceneObject, light: Light, eye: np.ndarray) -> np.ndarray | None:
    """Return the polar plane (4,) of the eye about the shadow cone of a caster's bounding sphere, through the light.

    None if there is no such plane: the eye lies in the cone (extended beyond the light), or the light in the sphere.

    Notes
    -----
    For a quadric q(X) = Xᵀ Q X and a line through E that meets it in A and B, the plane Eᵀ Q X = 0 meets the line in
    the harmonic conjugate of E, which lies between A and B if E does not. With C and r the sphere's centre and radius,
    Λ = (L, 1), D = C − L, x = X − L and e = E − L, the cone is q = (D·x)² − (D·D − r²)(x·x) = 0.
    For a light at infinity, Λ = (D, 0), it is a cylinder: with x = X − C and x⊥ the part of x across D, q = r² − x⊥·x⊥.
    """
    corners = caster.world_positions
    center = (corners.min(axis=0) + corners.max(axis=0)) / 2
    square = ((corners - center) ** 2).sum(axis=1).max()  # r²
    position = light.position[:3]
    if light.is_directional:
        along = position / np.linalg.norm(position)
        across = (eye - center) - ((eye - center) @ along) * along
        if across @ across <= square:
            return None
        return np.array([*-across, square + across @ center])
    axis, sight = center - position, eye - position
    normal = (axis @ sight) * axis - (axis @ axis - square) * sight
    if axis @ axis <= square or normal @ sight >= 0:  # q(E) ≥ 0
        return None
    return np.array([*normal, -normal @ position])


def whole_plane(plane: np.ndarray) -> np.ndarray:
    """Return (4, 3, 4) float32: a plane (4,) as four triangles from one of its points to infinity."""
    normal = plane[:3] / np.linalg.norm(plane[:3])
    point = -plane[3] / np.linalg.norm(plane[:3]) * normal
    along_u = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    along_v = np.cross(normal, along_u)
    far = [along_u, along_v, -along_u, -along_v]
    triangles = [[[*point, 1], [*a, 0], [*b, 0]] for a, b in zip(far, far[1:] + far[:1], strict=True)]
    return np.array(triangles, np.float32)
