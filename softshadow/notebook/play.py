"""`play`: a technique on a scene with sliders, drawn again at every change."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from softshadow import techniques
from softshadow.errors import nearest
from softshadow.notebook.extra import needed
from softshadow.scene import Scene
from softshadow.techniques import Steps, Technique

if TYPE_CHECKING:
    from softshadow.notebook.player import Player


def play(
    technique: str | Technique | Callable[..., Steps],
    scene: Scene | str,
    size: tuple[int, int] = (320, 240),
    *,
    light: str | None = None,
    **options: Any,
) -> Player:
    """Return a widget with the picture of a technique, and sliders for the light and the technique's options.

    A click on the picture explains the pixel, and lists its history below. In Python, ``widget.run`` is the current
    `Run` and ``widget.pixel`` the clicked pixel; both can be observed: ``widget.observe(print, "pixel")``. The sliders
    follow when ``widget.values`` is set.

    Parameters
    ----------
    technique                    as for `run`
    scene : Scene or str         a scene, or a name of `scene_names`
    size : (width, height)       pixels
    light : str                  name of the light to move; the first one by default
    options                      of the technique, to begin with

    Raises
    ------
    ValueError, TypeError        as `run`; or there is no such light
    ImportError                  anywidget is not installed
    """
    needed("anywidget", "play")
    from softshadow.notebook.player import Player

    technique = techniques.get(technique)
    scene = Scene.named(scene) if isinstance(scene, str) else scene
    lights = {each.name: each for each in scene.lights}
    if light is not None and light not in lights:
        raise ValueError(f"light={light!r}: {nearest(light, lights)}")
    return Player(technique, scene, size, lights[light] if light is not None else scene.lights[0], options)
