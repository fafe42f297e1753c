"""How a run is asked for again on the command line, as far as a run can know."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING

from softshadow import techniques
from softshadow.scene import Scene, scene_names

if TYPE_CHECKING:
    from softshadow.run import Run


def scene_spelled(scene: Scene, size: tuple[int, int]) -> str:
    """Return the arguments for a scene and a size; a scene of a file, or one with lights of its own, is a placeholder.

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


def options_spelled(run: Run) -> str:
    """Return the arguments for the options of a run that are not the technique's defaults, each after a space."""
    known = techniques.get(run.technique).options
    changed = [(key, value) for key, value in run.options.items() if value != known[key].default]
    return "".join(f" -O {shlex.quote(f'{key}={value}')}" for key, value in changed)
