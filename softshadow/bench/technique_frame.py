"""A frame of a technique of the register, with all that it reads back between its steps."""

from __future__ import annotations

import warnings
from dataclasses import replace
from typing import Any

import numpy as np

from softshadow import techniques
from softshadow.errors import Warning as SoftShadowWarning
from softshadow.errors import nearest
from softshadow.scene import Light, Scene
from softshadow.testing.timing import Frame

AS_IN_SCENE = "as in the scene"
KINDS = (AS_IN_SCENE, "at infinity", "outside", "inside")
SPREAD = 2.4  # radians between two lights round the vertical through the scene's middle: never two in one direction


def prepare(
    gl: Any, size: tuple[int, int], *, technique: str, scene: str, lights: int = 0, kind: str = AS_IN_SCENE
) -> Frame:
    """A frame runs all steps of the technique, with its default options.

    Parameters
    ----------
    technique, scene : names of the registers
    lights : int              how many, turned about the scene; 0: those of the scene
    kind : str                where the lights stand, see `KINDS`
    """
    drawn = with_lights(Scene.named(scene), lights, kind)
    entry = techniques.get(technique)
    options = entry.validate_options({})

    def frame() -> None:
        gl.glPushAttrib(gl.GL_ALL_ATTRIB_BITS)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SoftShadowWarning)  # a light inside the scene is known to be one
            for _ in entry.steps(gl, drawn, size=size, **options):
                pass
        gl.glPopAttrib()

    return frame


def with_lights(scene: Scene, count: int, kind: str) -> Scene:
    """Return a scene with other lights: `count` of them, all of one kind, with the first light's brightness shared.

    Raises
    ------
    ValueError      unknown kind; the message has the nearest
    """
    if kind not in KINDS:
        raise ValueError(f"kind={kind!r}: {nearest(kind, KINDS)}")
    if not count and kind == AS_IN_SCENE:
        return scene
    first = placed(scene, scene.lights[0], kind)
    total = count or len(scene.lights)
    color = scene.lights[0].color / total
    lights = [Light(turned(scene, first, SPREAD * k), color, name=f"light {k}") for k in range(total)]
    return replace(scene, lights=tuple(lights))


def placed(scene: Scene, light: Light, kind: str) -> np.ndarray:
    """Return the (4,) position of a light of a kind, in about the direction of the light there is."""
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


def turned(scene: Scene, position: np.ndarray, angle: float) -> np.ndarray:
    """Return a position turned about the vertical through the middle of the casters."""
    middle, _ = bounds(scene)
    cosine, sine = np.cos(angle), np.sin(angle)
    turn = np.array([[cosine, 0, sine], [0, 1, 0], [-sine, 0, cosine]])
    centre = position[3] * middle
    return np.array([*(centre + turn @ (position[:3] - centre)), position[3]])


def bounds(scene: Scene) -> tuple[np.ndarray, float]:
    """Return the middle of the casters and the half length of their diagonal."""
    vertices = np.concatenate([thing.world_positions for thing in scene.casters or scene.objects])
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    return (low + high) / 2, float(np.linalg.norm(high - low) / 2)
