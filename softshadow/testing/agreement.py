"""Agreement of a run with ray casting: they must agree off the boundary band, and may differ on it.

A rasterizer decides per sample, with vertices snapped to a grid, and a shadow map decides per texel. So the result at a
pixel crossed by an edge is uncertain, and at all other pixels it is known.
"""

from dataclasses import dataclass
from itertools import product

import numpy as np

from softshadow.inspection.hard_truth import hard_counts, seen_faces
from softshadow.runs import Run
from softshadow.scene import Scene
from softshadow.techniques.light_camera import light_camera

SNAP_DISTANCE = 1 / 128  # pixels: snapping to 1/256 moves an edge by less
EDGE_ON = 1e-4  # cosine to the light: such a face and a side of its volume have equal depths in 24 bits


@dataclass(frozen=True, eq=False)
class Truth:
    """Ray casting results at the pixel centres of a scene; read-only arrays with row 0 on top.

    Attributes
    ----------
    scene : Scene
    objects : (H, W) int             index of the visible object, -1 for none
    triangles : (H, W) int           index of the visible triangle in this object
    points : (H, W, 3) float64       the visible point in world space
    counts : tuple of (H, W) int32   for each light: the number of casting faces between it and the point. This is the
                                     stencil count that shadow volumes leave. The point's own face and the faces in its
                                     plane are excluded by index
    unsure : tuple of (H, W) bool    for each light: pixels where an edge of an object or a shadow lies within 1/128
                                     of a pixel (by a face too small to reach a neighbouring pixel), and pixels on faces
                                     that are edge-on to the light, where the sides of volumes lie
    unsure_counts : tuple of (H, W) bool   for each light: pixels where the count changes within 1/128 of a pixel
    """

    scene: Scene
    objects: np.ndarray
    triangles: np.ndarray
    points: np.ndarray
    counts: tuple[np.ndarray, ...]
    unsure: tuple[np.ndarray, ...]
    unsure_counts: tuple[np.ndarray, ...]

    def lit(self, light: int = 0) -> np.ndarray:
        """Return (H, W) bool: where the count of a light is 0 and, for a spot light, the point is in its cone."""
        return (self.counts[light] == 0) & self.scene.lights[light].shines_on(self.points)

    def band(self, light: int = 0, width: int = 1) -> np.ndarray:
        """Return (H, W) bool: where the object, the count or the cone of a light changes within `width` pixels.

        Off it, counts are known. `shadow_band` is narrower: off it, light and shadow are known.
        """
        changes = changes_nearby(self.counts[light], width) | self.unsure_counts[light]
        return self.shadow_band(light, width) | changes

    def shadow_band(self, light: int = 0, width: int = 1) -> np.ndarray:
        """Return (H, W) bool: where an edge of an object, of the shadow or of the cone lies within `width` pixels.

        Where the count changes inside the shadow, from 1 to 2, there is no edge: both are in shadow.
        """
        values = (self.objects, self.lit(light))
        return np.any([self.unsure[light], *(changes_nearby(value, width) for value in values)], axis=0)

    def texel_band(self, light: int, map_size: int, width: int = 1) -> np.ndarray:
        """Return (H, W) bool: where an edge of the shadow lies within `width` texels of a light's shadow map.

        Each point is moved, in the plane of its face, to the light's rays through the eight neighbouring texels. If
        such a ray does not meet the plane in front of the light, the point belongs to the band as well.
        """
        lamp = self.scene.lights[light]
        camera = light_camera(self.scene, lamp)
        right, up, forward = camera.frame
        objects, triangles, points = self.objects.ravel(), self.triangles.ravel(), self.points.reshape(-1, 3)
        normals = world_normals(self.scene, objects, triangles)
        texel = 2 * camera.half / map_size * width
        along = np.broadcast_to(forward, points.shape) if camera.parallel else points - camera.eye
        # depth along the light's view: a texel of a perspective map has the width given by `half` at depth 1
        scale = np.ones(len(points)) if camera.parallel else along @ forward
        band = np.zeros(len(points), bool)
        for x, y in ((x, y) for y in (-1, 0, 1) for x in (-1, 0, 1) if x or y):
            aside = texel * scale[:, None] * (x * right + y * up)
            ray = along if camera.parallel else along + aside
            start = points + aside
            with np.errstate(divide="ignore", invalid="ignore"):
                step = ((points - start) * normals).sum(axis=1) / (ray * normals).sum(axis=1)
            met = np.isfinite(step) & (np.full(len(step), camera.parallel) | (step > -1))
            moved = start + np.where(met, step, 0)[:, None] * ray
            there = hard_counts(self.scene, lamp, np.where(met, objects, -1), triangles, moved)
            band |= ~met | ((there == 0) != (self.counts[light].ravel() == 0))
        return (band & (objects >= 0)).reshape(self.objects.shape)


def cast_truth(scene: Scene, size: tuple[int, int]) -> Truth:
    """Return the ray casting results at the pixel centres of an image of (width, height) pixels."""
    width, height = size
    objects, triangles, points = seen_faces(scene, size)
    counts = [hard_counts(scene, light, objects, triangles, points) for light in scene.lights]
    unsure, unsure_counts = ([np.zeros(len(objects), bool) for _ in scene.lights] for _ in range(2))
    for x, y in product((-SNAP_DISTANCE, SNAP_DISTANCE), repeat=2):
        faces = seen_faces(scene, size, (x, y))
        for light, count, changes, count_changes in zip(scene.lights, counts, unsure, unsure_counts, strict=True):
            there = hard_counts(scene, light, *faces)
            changes |= (faces[0] != objects) | ((there == 0) != (count == 0))
            count_changes |= there != count
    normals = world_normals(scene, objects, triangles)
    for light, changes in zip(scene.lights, unsure, strict=True):
        towards = light.position[:3] - light.position[3] * points
        cosine = np.abs((towards * normals).sum(axis=1)) / np.linalg.norm(towards, axis=1)
        changes |= cosine < EDGE_ON
    shape = height, width
    arrays = [objects.reshape(shape), triangles.reshape(shape), points.reshape(*shape, 3)]
    by_light = [tuple(array.reshape(shape) for array in each) for each in (counts, unsure, unsure_counts)]
    for array in (*arrays, *by_light[0], *by_light[1], *by_light[2]):
        array.setflags(write=False)
    return Truth(scene, arrays[0], arrays[1], arrays[2], by_light[0], by_light[1], by_light[2])


def world_normals(scene: Scene, objects: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Return the unit normals (N, 3) float64 of triangles of objects, both by index; (0, 0, 1) for object -1."""
    normals = np.tile([0.0, 0.0, 1.0], (len(objects), 1))
    for number, thing in enumerate(scene.objects):
        here = objects == number
        a, b, c = thing.world_positions[thing.mesh.triangles[triangles[here]]].transpose(1, 0, 2)
        across = np.cross(b - a, c - a)
        normals[here] = across / np.linalg.norm(across, axis=1, keepdims=True)
    return normals


def changes_nearby(values: np.ndarray, width: int) -> np.ndarray:
    """Return (H, W) bool: where the pixels within `width` have different values."""
    height, across = values.shape
    framed = np.pad(values, width, mode="edge")
    span = range(2 * width + 1)
    return np.any([framed[y : y + height, x : x + across] != values for y in span for x in span], axis=0)


@dataclass(frozen=True, eq=False)
class Agreement:
    """Comparison of a run's visibility of one light with ray casting.

    Attributes
    ----------
    light : str
    band : (H, W) bool           the boundary band
    wrong : (H, W) bool          compared pixels that are lit in one and in shadow in the other
    compared : (H, W) bool       pixels where both are defined; a shadow map leaves pixels outside it undefined
    """

    light: str
    band: np.ndarray
    wrong: np.ndarray
    compared: np.ndarray

    @property
    def off_band(self) -> int:
        """Number of wrong pixels off the band; 0 if the technique is right."""
        return int((self.wrong & ~self.band).sum())

    @property
    def on_band(self) -> int:
        """Number of wrong pixels on the band."""
        return int((self.wrong & self.band).sum())

    def __str__(self) -> str:
        on, off = (int((self.compared & where).sum()) for where in (self.band, ~self.band))
        return f"{self.light}: {self.off_band} of {off} pixels wrong off the band, {self.on_band} of {on} on it"


def agreement(run: Run, truth: Truth | None = None, width: int = 1) -> list[Agreement]:
    """Return the agreement of a run with ray casting, for each light.

    The band is where an edge of an object or of its shadow passes within `width` pixels. For a technique with option
    `map_size` it is also where one passes within `width` texels of a map of this size that covers all casters.

    Parameters
    ----------
    truth : Truth                of the run's scene and size, if it has been cast before

    Examples
    --------
    >>> import softshadow as ss
    >>> from softshadow.testing import agreement
    >>> for each in agreement(ss.run("volume-zfail", "boxes", size=(64, 48))):
    ...     print(each.light, each.off_band)
    light 0
    """
    if run.scene is None:
        raise ValueError(f"run: expected one of a scene, this is a {run.technique} of a program")
    truth = cast_truth(run.scene, run.size) if truth is None else truth
    if truth.scene is not run.scene or truth.objects.shape != run.depth.shape:
        raise ValueError("truth: expected that of the run's own scene and size")
    agreements = []
    for index, seen in enumerate(run.lights):
        name = "unknown" if len(run.lights) == 1 else f"unknown: {seen.name}"
        known = run.valid & ~run.maps.get(name, np.zeros_like(run.valid))
        map_size = run.options.get("map_size")
        agreements.append(agreement_of(seen.visibility == 1, truth, known, index, width=width, map_size=map_size))
    return agreements


def agreement_of(
    lit: np.ndarray,
    truth: Truth,
    known: np.ndarray | None = None,
    light: int = 0,
    *,
    width: int = 1,
    map_size: int | None = None,
) -> Agreement:
    """Return the agreement of any renderer's shadows with ray casting, for one light.

    Parameters
    ----------
    lit : (H, W) bool            where the renderer says that the light is visible; row 0 on top
    truth : Truth                of the scene that it has drawn, from the same camera (`cast_truth`)
    known : (H, W) bool          where it says so at all; everywhere by default
    light : int                  index in the scene
    width, map_size : int        the band: pixels, and texels of a shadow map on a side

    Raises
    ------
    ValueError                   arrays of another size than the truth, or no such light

    Examples
    --------
    >>> import softshadow as ss
    >>> from softshadow.testing import agreement_of, cast_truth
    >>> truth = cast_truth(ss.Scene.named("boxes"), (64, 48))
    >>> agreement_of(truth.counts[0] == 0, truth).off_band
    0
    """
    shape = truth.objects.shape
    if np.shape(lit) != shape or (known is not None and np.shape(known) != shape):
        raise ValueError(f"lit, known: expected arrays of shape {shape}, that of the truth")
    if not 0 <= light < len(truth.counts):
        raise ValueError(f"light={light}: the scene has {len(truth.counts)}")
    band = truth.shadow_band(light, width)
    if map_size is not None:
        band |= truth.texel_band(light, map_size, width)
    compared = (truth.objects >= 0) & (True if known is None else np.asarray(known, bool))
    wrong = compared & (np.asarray(lit, bool) != truth.lit(light))
    return Agreement(truth.scene.lights[light].name, band, wrong, compared)
