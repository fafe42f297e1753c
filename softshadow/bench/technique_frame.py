"""Technique workload: a frame of a technique, including what it reads back between its steps."""

from __future__ import annotations

import warnings
from dataclasses import replace
from typing import Any

import numpy as np

from softshadow import techniques
from softshadow.errors import Warning as SoftShadowWarning
from softshadow.errors import nearest
from softshadow.scene import Light, Scene
from softshadow.testing.timing import DrawFrame

AS_IN_SCENE = "as in the scene"
KINDS = (AS_IN_SCENE, "at infinity", "outside", "inside")
SPREAD = 2.4  # radians between lights around the vertical axis; no two lights get the same direction


def prepare(
    gl: Any, size: tuple[int, int], *, technique: str, scene: str, lights: int = 0, kind: str = AS_IN_SCENE
) -> DrawFrame:
    """Prepare the scene; a frame draws all steps of the technique with its default options.

    Parameters
    ----------
    technique, scene : str       names
    lights : int                 number of lights around the scene; 0: the scene's own lights
    kind : str                   where the lights are, see `KINDS`
    """
    lit_scene = with_lights(Scene.named(scene), lights, kind)
    entry = techniques.get(technique)
    options = entry.validate_options({})

    def frame() -> None:
        gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SoftShadowWarning)  # a light inside the scene is intended
            for _ in entry.steps(gl, lit_scene, size=size, **options):
                pass
        gl.glPopAttrib()

    return frame


def with_lights(scene: Scene, n_lights: int, kind: str) -> Scene:
    """Return a scene with `n_lights` lights of one kind, which share the first light's brightness.

    Raises
    ------
    ValueError                   unknown kind; the message suggests the nearest
    """
    if kind not in KINDS:
        raise ValueError(f"kind={kind!r}: {nearest(kind, KINDS)}")
    if not n_lights and kind == AS_IN_SCENE:
        return scene
    first = place_light(scene, scene.lights[0], kind)
    total = n_lights or len(scene.lights)
    color = scene.lights[0].color / total
    lights = [Light(rotate_about_casters(scene, first, SPREAD * k), color, name=f"light {k}") for k in range(total)]
    return replace(scene, lights=tuple(lights))


def place_light(scene: Scene, light: Light, kind: str) -> np.ndarray:
    """Return the position (4,) of a light of another kind, in about the direction of the scene's light."""
    middle, reach = bounds(scene)
    towards = light.position[:3] - light.position[3] * middle
    towards = towards / np.linalg.norm(towards)
    if kind == "at infinity":
        return np.array([*towards, 0.0])
    if kind == "outside":
        return np.array([*(middle + 2.5 * reach * towards), 1.0])
    if kind == "inside":
        return np.array([*(middle + 0.05 * reach * towards), 1.0])
    return light.position


def rotate_about_casters(scene: Scene, position: np.ndarray, angle: float) -> np.ndarray:
    """Return a position (4,) rotated about the vertical axis through the casters' centre."""
    middle, _ = bounds(scene)
    cosine, sine = np.cos(angle), np.sin(angle)
    turn = np.array([[cosine, 0, sine], [0, 1, 0], [-sine, 0, cosine]])
    center = position[3] * middle
    return np.array([*(center + turn @ (position[:3] - center)), position[3]])


def bounds(scene: Scene) -> tuple[np.ndarray, float]:
    """Return the centre of the casters' bounding box and half the length of its diagonal."""
    vertices = np.concatenate([thing.world_positions for thing in scene.casters or scene.objects])
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    return (low + high) / 2, float(np.linalg.norm(high - low) / 2)
