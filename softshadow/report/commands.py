"""The command line that repeats a run, as far as the run determines it."""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from typing import Any

from softshadow import techniques
from softshadow.scene import Scene, scene_names


def heading(technique: str, scene: Scene | None, options: Mapping[str, Any]) -> str:
    """Return what a run shows; without a scene, the program that was recorded."""
    if scene is not None:
        return f"{technique} on {scene.name}"
    return f"{technique} of {options.get('program', 'a program')}"


def question_spelled(technique: str, scene: Scene | None, size: tuple[int, int], options: Mapping[str, Any]) -> str:
    """Return the command line, or the call, that tells the history of a pixel X Y of a run."""
    if scene is not None:
        return f"softshadow pixel {technique} X Y {scene_spelled(scene, size)}{options_spelled(technique, options)}"
    if technique == "replay":
        place = f"--until {options['until']}" if "until" in options else f"--frame {options['frame']}"
        return f"softshadow replay {shlex.quote(str(options['program']))} {place} --pixel X Y"
    return "run.pixel(X, Y)"


def scene_spelled(scene: Scene, size: tuple[int, int]) -> str:
    """Return the arguments for a scene and a size; FILE stands for a scene that is not built in, or was changed.

    Examples
    --------
    >>> scene_spelled(Scene.named("boxes"), (64, 48))
    '--scene boxes --size 64x48'
    """
    return f"--scene {scene.name if _is_built_in(scene) else 'FILE'} --size {size[0]}x{size[1]}"


def _is_built_in(scene: Scene) -> bool:
    if scene.name not in scene_names():
        return False
    lights = [light.position.tolist() for light in Scene.named(scene.name).lights]
    return lights == [light.position.tolist() for light in scene.lights]


def options_spelled(technique: str, options: Mapping[str, Any]) -> str:
    """Return the arguments for the options that differ from the technique's defaults, each after a space.

    Of a technique that is not one of this package, all options are spelled.
    """
    declared = techniques.get(technique).options if technique in techniques.names() else {}
    changed = [(key, value) for key, value in options.items() if key not in declared or value != declared[key].default]
    return "".join(f" -O {shlex.quote(f'{key}={value}')}" for key, value in changed)
