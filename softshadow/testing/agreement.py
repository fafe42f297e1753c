"""How far a picture agrees with ray casting: off the boundary band it has to, on the band it may differ.

A rasterizer decides per sample, with edges snapped to a grid; a shadow map decides per texel. So nothing can be said
about a pixel that an edge runs through, and everything about the others.
"""

from dataclasses import dataclass

import numpy as np

from softshadow.inspection.hard_truth import hard_counts, seen_faces
from softshadow.runs import Run
from softshadow.scene import Scene
from softshadow.techniques.light_camera import light_camera

SNAPPED = 1 / 128  # pixels: more than what snapping to 1/256 moves an edge by
EDGE_ON = 1e-4  # cosine to the light: the side of a volume beside such a face is as deep as the face, to 24 bits


@dataclass(frozen=True, eq=False)
class Truth:
    """What rays find at the pixel centres of a scene; arrays with row 0 on top, read-only.

    Attributes
    ----------
    scene : Scene
    objects : (H, W) int             number of the object that is seen, -1 where there is none
    triangles : (H, W) int           and which of its triangles
    points : (H, W, 3) float64       where, in world space
    counts : tuple of (H, W) int32   per light: how many casting faces lie between it and the point. This is what a
                                     stencil buffer holds after shadow volumes. The point's own face and those in its
                                     plane are left out by number
    unsure : tuple of (H, W) bool    per light: where the object or the count changes within 1/128 of a pixel, which no
                                     neighbour need tell of a face smaller than a pixel; and faces edge-on to the light,
                                     on which the sides of volumes lie
    """

    scene: Scene
    objects: np.ndarray
    triangles: np.ndarray
    points: np.ndarray
    counts: tuple[np.ndarray, ...]
    unsure: tuple[np.ndarray, ...]

    def lit(self, light: int = 0) -> np.ndarray:
        """Return (H, W) bool: where the count of a light is 0, within its cone if it is a spot light."""
        return (self.counts[light] == 0) & self.scene.lights[light].shines_on(self.points)

    def band(self, light: int = 0, width: int = 1) -> np.ndarray:
        """Return (H, W) bool: where the object, the count of a light or its cone changes within `width` pixels."""
        values = (self.objects, self.counts[light], self.lit(light))
        return np.any([self.unsure[light], *(changes_nearby(value, width) for value in values)], axis=0)

    def texel_band(self, light: int, map_size: int, width: int = 1) -> np.ndarray:
        """Return (H, W) bool: where the count of a light changes within `width` texels of its shadow map.

        A point is moved on the plane of its own face to where the light's rays through the eight neighbouring texels
        meet it; where they do not meet it before the light, the point belongs to the band, too.
        """
        lamp = self.scene.lights[light]
        camera = light_camera(self.scene, lamp)
        right, up, forward = camera.frame
        objects, triangles, points = self.objects.ravel(), self.triangles.ravel(), self.points.reshape(-1, 3)
        normals = world_normals(self.scene, objects, triangles)
        texel = 2 * camera.half / map_size * width
        along = np.broadcast_to(forward, points.shape) if camera.parallel else points - camera.eye
        # the distance along the view: at distance 1 a texel of a perspective map is as wide as `half` says
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
            band |= ~met | (there != self.counts[light].ravel())
        return (band & (objects >= 0)).reshape(self.objects.shape)


def cast_truth(scene: Scene, size: tuple[int, int]) -> Truth:
    """Return what rays find at the pixel centres of a picture of (width, height)."""
    width, height = size
    objects, triangles, points = seen_faces(scene, size)
    counts = [hard_counts(scene, light, objects, triangles, points) for light in scene.lights]
    unsure = [np.zeros(len(objects), bool) for _ in scene.lights]
    for aside in ((SNAPPED, SNAPPED), (-SNAPPED, SNAPPED), (SNAPPED, -SNAPPED), (-SNAPPED, -SNAPPED)):
        beside = seen_faces(scene, size, aside)
        for light, count, changes in zip(scene.lights, counts, unsure, strict=True):
            changes |= (beside[0] != objects) | (hard_counts(scene, light, *beside) != count)
    normals = world_normals(scene, objects, triangles)
    for light, changes in zip(scene.lights, unsure, strict=True):
        towards = light.position[:3] - light.position[3] * points
        cosine = np.abs((towards * normals).sum(axis=1)) / np.linalg.norm(towards, axis=1)
        changes |= cosine < EDGE_ON
    shape = height, width
    arrays = [objects.reshape(shape), triangles.reshape(shape), points.reshape(*shape, 3)]
    by_light = [tuple(array.reshape(shape) for array in each) for each in (counts, unsure)]
    for array in (*arrays, *by_light[0], *by_light[1]):
        array.setflags(write=False)
    return Truth(scene, arrays[0], arrays[1], arrays[2], by_light[0], by_light[1])


def world_normals(scene: Scene, objects: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Return (N, 3) float64: the unit normals of triangles of objects, by number; (0, 0, 1) for object -1."""
    normals = np.tile([0.0, 0.0, 1.0], (len(objects), 1))
    for number, thing in enumerate(scene.objects):
        here = objects == number
        a, b, c = thing.world_positions[thing.mesh.triangles[triangles[here]]].transpose(1, 0, 2)
        across = np.cross(b - a, c - a)
        normals[here] = across / np.linalg.norm(across, axis=1, keepdims=True)
    return normals


def changes_nearby(values: np.ndarray, width: int) -> np.ndarray:
    """Return (H, W) bool: where not all pixels within `width` have one value."""
    height, across = values.shape
    framed = np.pad(values, width, mode="edge")
    span = range(2 * width + 1)
    return np.any([framed[y : y + height, x : x + across] != values for y in span for x in span], axis=0)


@dataclass(frozen=True, eq=False)
class Agreement:
    """Where a run's visibility of one light is not that of ray casting.

    Attributes
    ----------
    light : str
    band : (H, W) bool        the boundary band
    wrong : (H, W) bool       lit and in shadow exchanged; only where both know an answer
    compared : (H, W) bool    where both do; what a shadow map does not see, it does not know
    """

    light: str
    band: np.ndarray
    wrong: np.ndarray
    compared: np.ndarray

    @property
    def off_band(self) -> int:
        """Wrong pixels off the band: 0 where the technique is right."""
        return int((self.wrong & ~self.band).sum())

    @property
    def on_band(self) -> int:
        """Wrong pixels on the band."""
        return int((self.wrong & self.band).sum())

    def __str__(self) -> str:
        on, off = (int((self.compared & where).sum()) for where in (self.band, ~self.band))
        return f"{self.light}: {self.off_band} of {off} pixels wrong off the band, {self.on_band} of {on} on it"


def agreement(run: Run, truth: Truth | None = None, width: int = 1) -> list[Agreement]:
    """Return for each light where a run agrees with ray casting.

    The band is where an edge of an object or of the shadow passes within `width` pixels; of a technique with option
    `map_size` also where one passes within `width` texels of a map of that size that looks at all casters, as that of
    `map` does.

    Parameters
    ----------
    truth : Truth      of the same scene and size, when it is there already

    Examples
    --------
    >>> import softshadow as ss
    >>> from softshadow.testing import agreement
    >>> for found in agreement(ss.run("volume-zfail", "boxes", size=(64, 48))):
    ...     print(found.light, found.off_band)
    light 0
    """
    known = cast_truth(run.scene, run.size) if truth is None else truth
    if known.scene is not run.scene or known.objects.shape != run.depth.shape:
        raise ValueError("truth: expected that of the run's own scene and size")
    found = []
    for index, seen in enumerate(run.lights):
        band = known.band(index, width)
        if "map_size" in run.options:
            band |= known.texel_band(index, run.options["map_size"], width)
        several = f" of {seen.name}" if len(run.lights) > 1 else ""
        unknown = run.maps.get(f"unknown{several}", np.zeros_like(run.valid))
        compared = run.valid & ~unknown & (known.objects >= 0)
        wrong = compared & ((seen.visibility == 1) != known.lit(index))
        found.append(Agreement(seen.name, band, wrong, compared))
    return found
