"""Z-pass or z-fail, chosen for each caster, or for each pixel by a plane through the caster's volume.

Both add the same number to the same stencil buffer, so every volume may be counted either way, at every pixel anew, as
long as z-pass is kept to volumes that do not reach the near rectangle. There it starts from 0 rightly, and it needs no
light cap.

The plane: z-pass changes no value where the surface lies before the volume, z-fail none where it lies behind. A plane
inside the volume tells the two apart. Ours is the polar plane of the eye about the cone that the light throws behind
the caster's bounding sphere: a line of sight that enters the cone and leaves it again crosses the plane in between. The
caster's own lit faces, where the volume begins, lie before it on both sides of the plane.

Paper: Everitt & Kilgard 2002, sec. 4.3 (for each caster); Laine 2005, "Split-plane shadow volumes" (for tiles of
pixels, by the hardware; here the plane itself is drawn, and the depth test compares it with every pixel).
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from softshadow.scene import Light, Scene, SceneObject
from softshadow.techniques.drawing import draw_polygons, named, read_stencil, title_of
from softshadow.techniques.near_rectangle import shadows_near_rectangle
from softshadow.techniques.shadow_volumes import CasterVolume, draw_volumes
from softshadow.techniques.start_value import warn_of_a_wrong_start
from softshadow.techniques.technique import Option, Steps

CHOICES = ("zpass", "zfail", "per-caster", "split-plane")


def choose_option(default: str) -> Option:
    """Return the option `choose` of a technique that counts by `default` unless told otherwise."""
    return Option(
        default,
        str,
        "count all volumes where the depth test passes, or fails; per-caster: fails only for casters between the light "
        "and the near rectangle; split-plane: for each pixel what changes fewer stencil values",
        choices=CHOICES,
    )


@dataclass(frozen=True)
class Counting:
    """How volumes are counted: the operations up and down, in one pass or two, and which caps there are."""

    up: int
    down: int
    two_sided: bool
    caps: bool
    finite: bool

    def where_passing(self, gl: Any, volumes: Iterable[CasterVolume]) -> None:
        """Count up at front faces and down at back faces, where the depth test passes; only a finite dark cap can."""
        shown = {"light_caps": False, "dark_caps": self.finite}
        if self.two_sided:
            gl.glDisable(gl.GL_CULL_FACE)
            gl.glStencilOpSeparate(gl.GL_FRONT, gl.GL_KEEP, gl.GL_KEEP, self.up)
            gl.glStencilOpSeparate(gl.GL_BACK, gl.GL_KEEP, gl.GL_KEEP, self.down)
            draw_volumes(gl, volumes, **shown)
            return
        for culled, op in ((gl.GL_BACK, self.up), (gl.GL_FRONT, self.down)):
            gl.glCullFace(culled)
            gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, op)
            draw_volumes(gl, volumes, **shown)

    def where_failing(self, gl: Any, volumes: Iterable[CasterVolume]) -> None:
        """Count up at back faces and down at front faces, where the depth test fails."""
        shown = {"light_caps": self.caps, "dark_caps": self.caps}
        if self.two_sided:
            gl.glDisable(gl.GL_CULL_FACE)
            gl.glStencilOpSeparate(gl.GL_BACK, gl.GL_KEEP, self.up, gl.GL_KEEP)
            gl.glStencilOpSeparate(gl.GL_FRONT, gl.GL_KEEP, self.down, gl.GL_KEEP)
            draw_volumes(gl, volumes, **shown)
            return
        for culled, op in ((gl.GL_FRONT, self.up), (gl.GL_BACK, self.down)):
            gl.glCullFace(culled)
            gl.glStencilOp(gl.GL_KEEP, op, gl.GL_KEEP)
            draw_volumes(gl, volumes, **shown)


def count_by_choice(
    gl: Any,
    scene: Scene,
    light: Light,
    volumes: list[CasterVolume],
    counting: Counting,
    *,
    choose: str,
    size: tuple[int, int],
    far: str,
) -> Steps:
    """Count volumes into the stencil buffer, which is 0, each as `choose` says."""
    near = [shadows_near_rectangle(item.caster, light, scene.camera, size, far) for item in volumes]
    if choose == "split-plane":
        yield from count_by_split_planes(gl, scene, light, list(zip(volumes, near, strict=True)), counting, size)
        return
    fails = [choose == "zfail" or (choose == "per-caster" and reached) for reached in near]
    passing = [item for item, failing in zip(volumes, fails, strict=True) if not failing]
    warn_of_a_wrong_start(scene, light, [item.caster for item in passing], "none", size, far)
    counting.where_passing(gl, passing)
    yield title_of("count where the depth test passes", scene, light)
    counting.where_failing(gl, [item for item, failing in zip(volumes, fails, strict=True) if failing])
    yield title_of("count where the depth test fails", scene, light)


def count_by_split_planes(
    gl: Any,
    scene: Scene,
    light: Light,
    volumes: list[tuple[CasterVolume, bool]],
    counting: Counting,
    size: tuple[int, int],
) -> Steps:
    """Count volumes one by one; with each comes whether it reaches the near rectangle.

    The stencil buffer's highest bit marks what lies behind the split plane, the bits below it count.

    Raises
    ------
    ValueError                   counters that should stop: above them there is the mark; a buffer of one bit
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
            by_zfail += read_stencil(gl, size) & mark != 0
            yield title_of(f"mark what lies behind the split plane of {item.caster.name}", scene, light)
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
        name = title_of("volumes counted by z-fail", scene, light)
        yield title_of(f"count the volume of {item.caster.name}", scene, light), {name: by_zfail.copy()}
    gl.glStencilMask(mark)
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    gl.glStencilMask(0xFF)


def mark_behind(gl: Any, item: CasterVolume, plane: np.ndarray, mark: int) -> None:
    """Set the mark where the visible surface lies behind a plane, but for the caster's own lit faces."""
    gl.glDisable(gl.GL_CULL_FACE)
    gl.glStencilFunc(gl.GL_ALWAYS, mark, 0xFF)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    with named(gl, item.caster):
        draw_polygons(gl, whole_plane(plane))
    gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
    gl.glDepthFunc(gl.GL_EQUAL)
    draw_volumes(gl, [item], sides=False, dark_caps=False)
    gl.glDepthFunc(gl.GL_LESS)
    gl.glEnable(gl.GL_CULL_FACE)


def split_plane(caster: SceneObject, light: Light, eye: np.ndarray) -> np.ndarray | None:
    """Return the polar plane (4,) of the eye about the shadow cone of a caster's bounding sphere, through the light.

    None where there is no such plane: the eye lies in the cone (produced beyond the light), or the light in the sphere.

    Notes
    -----
    For a quadric q(X) = Xᵀ Q X and a line through E that meets it in A and B, the plane Eᵀ Q X = 0 meets the line in
    the harmonic conjugate of E, which lies between A and B if E does not. With C and r the sphere's centre and radius,
    Λ = (L, 1), D = C − L, x = X − L and e = E − L, the cone is q = (D·x)² − (D·D − r²)(x·x) = 0.
    For a light at infinity, Λ = (D, 0), it is a cylinder: with x = X − C and x⊥ the part of x across D, q = r² − x⊥·x⊥.
    """
    corners = caster.world_positions
    centre = (corners.min(axis=0) + corners.max(axis=0)) / 2
    square = ((corners - centre) ** 2).sum(axis=1).max()  # r²
    position = light.position[:3]
    if light.is_directional:
        along = position / np.linalg.norm(position)
        across = (eye - centre) - ((eye - centre) @ along) * along
        if across @ across <= square:
            return None
        return np.array([*-across, square + across @ centre])
    axis, sight = centre - position, eye - position
    normal = (axis @ sight) * axis - (axis @ axis - square) * sight
    if axis @ axis <= square or normal @ sight >= 0:  # q(E) ≥ 0
        return None
    return np.array([*normal, -normal @ position])


def whole_plane(plane: np.ndarray) -> np.ndarray:
    """Return (4, 3, 4) float32: a whole plane (4,) as triangles from one of its points to infinity."""
    normal = plane[:3] / np.linalg.norm(plane[:3])
    point = -plane[3] / np.linalg.norm(plane[:3]) * normal
    along_u = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    along_v = np.cross(normal, along_u)
    far = [along_u, along_v, -along_u, -along_v]
    triangles = [[[*point, 1], [*a, 0], [*b, 0]] for a, b in zip(far, far[1:] + far[:1], strict=True)]
    return np.array(triangles, np.float32)
