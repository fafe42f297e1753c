"""What a picture should be: surfaces lit as the pipeline lights them, shadows as rays find them."""

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
from softshadow.run import run
from softshadow.scene import Light, Scene
from softshadow.techniques import Steps, Technique
from softshadow.techniques.drawing import begin_frame, draw_objects, light_ambient_only, light_by, set_camera

DECIMALS = 5  # of a unit normal: what rounding of vertices leaves between triangles of one plane
MOST_PLANES = 1 << 32  # more than a mesh can have: numbers of two objects never meet
KEPT = 8  # expectations: enough for one failure after the other


class Expected(NamedTuple):
    """The truth about every pixel, row 0 on top.

    image : (H, W, 3) int16          with shadows, all lights in one drawing
    lit, dark : (H, W, 3) int16      without shadows, and without lights
    added : (H, W, 3) int16          with shadows, a drawing for each light: colours above 1 are cut off later
    shadow : (H, W) bool             a light is hidden
    seen, receiver : (H, W) bool     a surface is seen, and that of a receiver
    sure : (H, W) bool               off the boundary band: around it all points have the same lights
    on_receivers : (H, W) bool       off the boundary band where only receivers have shadows
    inside_faces : (H, W) bool       off creases: around it all points are in one plane
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


@lru_cache(maxsize=KEPT)
def expected(scene: Scene, size: tuple[int, int], flat: bool = False) -> Expected:
    """Return what a picture of the scene should be; `flat` is a light that gives every surface the same."""
    visible, seen = hard_visibility(scene, size)
    dark = drawn(scene, size, ())
    if flat:
        lit = drawn(replace(scene, ambient=np.ones(3)), size, ())
        parts = [lit - dark]
    else:
        lit = drawn(scene, size, scene.lights)
        unlit = replace(scene, ambient=np.zeros(3))
        none = drawn(unlit, size, ())
        parts = [drawn(unlit, size, (light,)) - none for light in scene.lights]
    added = dark + sum(np.where(one[..., None] == 1, part, 0) for one, part in zip(visible, parts, strict=True))
    hidden = np.logical_or.reduce([one < 1 for one in visible])
    receivers = [index for index, thing in enumerate(scene.objects) if thing.receives]
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
        sure=np.logical_and.reduce([uniform(plane) for plane in (seen, *visible)]),
        on_receivers=uniform(seen) & uniform(hidden & receiver),
        inside_faces=uniform(planes_of(scene, objects, triangles).reshape(seen.shape)),
    )


def planes_of(scene: Scene, objects: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Return a number (N,) for the object and the direction of the face that every pixel shows, -1 for none."""
    numbers = np.full(len(objects), -1)
    for index, thing in enumerate(scene.objects):
        normals = thing.mesh.face_normals / np.linalg.norm(thing.mesh.face_normals, axis=1, keepdims=True)
        _, plane = np.unique(np.round(normals, DECIMALS), axis=0, return_inverse=True)
        numbers[objects == index] = plane.ravel()[triangles[objects == index]] + MOST_PLANES * index
    return numbers


def drawn(scene: Scene, size: tuple[int, int], lights: tuple[Light, ...]) -> np.ndarray:
    """Return the scene's picture (H, W, 3) int16 with some of its lights and the ambient light, without shadows."""

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
    """Inside, nothing is said of what will look wrong: that is the point here."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", errors.Warning)
        yield
