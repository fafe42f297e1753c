"""The correct picture of a scene: surfaces lit by the pipeline, shadows by ray casting."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from softshadow import errors
from softshadow.inspection.comparison import uniform
from softshadow.inspection.hard_truth import hard_visibility, seen_faces
from softshadow.runs import run
from softshadow.scene import Light, Scene
from softshadow.techniques import Steps, Technique
from softshadow.techniques.drawing import begin_frame, draw_objects, light_ambient_only, light_by, set_camera

DECIMALS = 5  # of a unit normal: rounded vertices tilt the triangles of one plane by less
MOST_PLANES = 1 << 32  # more than a mesh can have, so that planes of two objects never get the same number
CACHED = 8  # expected pictures; the runs of one failure share them


class Expected(NamedTuple):
    """The correct colours and shadows of every pixel, row 0 on top.

    image : (H, W, 3) int16          with shadows, all lights in one pass
    lit, dark : (H, W, 3) int16      without shadows, and without lights
    added : (H, W, 3) int16          with shadows, the sum of one pass for each light, clamped to 255 at the end
    shadow : (H, W) bool             a light is hidden
    seen, receiver : (H, W) bool     a surface is seen; it belongs to a receiver
    sure : (H, W) bool               off the boundary band: the neighbours see the same lights
    on_receivers : (H, W) bool       the same, if only receivers had shadows
    inside_faces : (H, W) bool       off creases: the neighbours lie in the same plane
    """

    image: np.ndarray
    lit: np.ndarray
    dark: np.ndarray
    added: np.ndarray
    shadow: np.ndarray
    seen: np.ndarray
    receiver: np.ndarray
    sure: np.ndarray
    on_receivers: np.ndarray
    inside_faces: np.ndarray


@lru_cache(maxsize=CACHED)
def expected(scene: Scene, size: tuple[int, int], flat: bool = False) -> Expected:
    """Return the correct picture of the scene; with `flat`, lit surfaces have their plain colour, without shading."""
    visibilities, seen = hard_visibility(scene, size)
    dark = drawn(scene, size, ())
    if flat:
        lit = drawn(replace(scene, ambient=np.ones(3)), size, ())
        light_colors = [lit - dark]
    else:
        lit = drawn(scene, size, scene.lights)
        unlit = replace(scene, ambient=np.zeros(3))
        none = drawn(unlit, size, ())
        light_colors = [drawn(unlit, size, (light,)) - none for light in scene.lights]
    lights = zip(visibilities, light_colors, strict=True)
    added = dark + sum(np.where(visibility[..., None] == 1, color, 0) for visibility, color in lights)
    hidden = np.logical_or.reduce([visibility < 1 for visibility in visibilities])
    receivers = [index for index, item in enumerate(scene.objects) if item.receives]
    objects, triangles, _ = seen_faces(scene, size)
    receiver = np.isin(objects, receivers).reshape(seen.shape)
    added = np.minimum(added, 255)
    return Expected(
        image=np.where(hidden[..., None], added, lit),
        lit=lit,
        dark=dark,
        added=added,
        shadow=hidden,
        seen=seen,
        receiver=receiver,
        sure=np.logical_and.reduce([uniform(values) for values in (seen, *visibilities)]),
        on_receivers=uniform(seen) & uniform(hidden & receiver),
        inside_faces=uniform(planes_of(scene, objects, triangles).reshape(seen.shape)),
    )


def planes_of(scene: Scene, objects: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Return a number (N,) for the plane that every pixel shows, by object and normal, -1 for none."""
    numbers = np.full(len(objects), -1)
    for index, item in enumerate(scene.objects):
        normals = item.mesh.face_normals / np.linalg.norm(item.mesh.face_normals, axis=1, keepdims=True)
        _, plane = np.unique(np.round(normals, DECIMALS), axis=0, return_inverse=True)
        numbers[objects == index] = plane.ravel()[triangles[objects == index]] + MOST_PLANES * index
    return numbers


def drawn(scene: Scene, size: tuple[int, int], lights: tuple[Light, ...]) -> np.ndarray:
    """Return the scene without shadows, lit by the ambient light and some of its lights, (H, W, 3) int16."""

    def steps(gl: Any, scene: Scene, *, size: tuple[int, int]) -> Steps:
        begin_frame(gl, scene)
        set_camera(gl, scene.camera, size)
        light_ambient_only(gl, scene)
        light_by(gl, scene, lights, ambient=True)
        draw_objects(gl, scene.objects)
        yield "draw the scene"

    with without_warnings():
        return run(Technique("no shadows", "No shadows", "", "", steps, {}), scene, size).image.astype(np.int16)


@contextmanager
def without_warnings() -> Iterator[None]:
    """Silence this package's warnings inside the block: the pictures are meant to be wrong."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", errors.Warning)
        yield
