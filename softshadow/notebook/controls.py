"""Which sliders and choices the player has: the position of a light, and the options that a technique declares.

A control is a dictionary, as the browser gets it: `key`, `label`, `help`, `group` (light, main or more), `value`, and
`kind`: "range" with `min`, `max` and `step`; "stops", a slider over `choices`, which are numbers; "choice" of a text;
"switch"; "number", which may be empty (None) where the technique chooses the value.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from softshadow.scene import Light, Scene
from softshadow.techniques import Option, Technique

Control = dict[str, Any]
LIGHT = "light."  # the keys of the light's coordinates begin with it
SIDES = (16, 32, 64, 128, 256, 512, 1024, 2048, 4096)  # texels
# options that are shown first, with the ends of their sliders; numbers of pictures or taps cost time in proportion
MAIN = {
    "map_size": SIDES,
    "factor": (-8, 8, 0.1),
    "units": (-64, 64, 0.5),
    "bias": (0, 0.02, 0.0001),
    "normal_bias": (0, 0.1, 0.001),
    "offset": (-8, 8, 0.1),
    "kernel": (1, 15, 1),
    "taps": (1, 16, 1),
    "search": (1, 32, 1),
    "blur": (0, 16, 1),
    "samples": (1, 64, 1),
    "layers": (1, 32, 1),
    "texture_size": SIDES,
    "exponent": (1, 87, 0.5),
    "bleed": (0, 0.99, 0.01),
}
STEPS = 200  # of a slider whose ends follow from the default


def controls_of(technique: Technique, options: dict[str, Any], scene: Scene, light: Light) -> list[Control]:
    """Return the controls of a technique on a scene; `options` has a value for every option of the technique."""
    return [*light_controls(scene, light), *(option_control(name, o, options[name]) for name, o in ordered(technique))]


def ordered(technique: Technique) -> list[tuple[str, Option]]:
    """Return the options of a technique: first those that are shown first."""
    return sorted(technique.options.items(), key=lambda item: list(MAIN).index(item[0]) if item[0] in MAIN else 99)


def light_controls(scene: Scene, light: Light) -> list[Control]:
    """Return a slider for each coordinate of a light: around the casters, or of a direction."""
    things = scene.casters or scene.objects
    vertices = np.concatenate([thing.world_positions for thing in things])
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    middle = np.zeros(3) if light.is_directional else (low + high) / 2
    offset = light.position[:3] - middle
    size = 0.0 if light.is_directional else float((high - low).max())
    reach = max(1.5 * float(np.abs(offset).max()), size)
    step = 10.0 ** math.floor(math.log10(reach / STEPS))
    meaning = "of the direction towards the light" if light.is_directional else "of the light's position"
    controls = []
    for axis, name in enumerate("xyz"):
        ends = [math.floor((middle[axis] - reach) / step) * step, math.ceil((middle[axis] + reach) / step) * step]
        controls.append(
            {
                "key": f"{LIGHT}{name}",
                "label": f"light {name}",
                "group": "light",
                "kind": "range",
                "help": f"{name} {meaning}",
                "value": float(light.position[axis]),
                "min": round(ends[0], 9),
                "max": round(ends[1], 9),
                "step": step,
            }
        )
    return controls


def option_control(name: str, option: Option, value: Any) -> Control:
    """Return the control of an option that has a value."""
    control: Control = {
        "key": name,
        "label": name.replace("_", " "),
        "group": "main" if name in MAIN else "more",
        "help": ": ".join(part for part in (option.help, option.expected) if part),
        "value": value,
    }
    if option.choices:
        return control | {"kind": "choice", "choices": list(option.choices)}
    if option.kind is bool:
        return control | {"kind": "switch"}
    if option.kind is str:
        return control | {"kind": "text"}
    if option.default is None:
        return control | {"kind": "number"}
    ends = MAIN.get(name)
    if ends is SIDES:
        return control | {"kind": "stops", "choices": sorted({n for n in SIDES if n <= option.maximum} | {value})}
    return control | {"kind": "range"} | _range(option, ends, value)


def _range(option: Option, ends: tuple[float, ...] | None, value: float) -> dict[str, float]:
    """Return the ends and the step of a slider that the option allows and that the value lies between."""
    if ends is None:
        reach = 4 * max(abs(option.default), abs(value), 1)
        low = option.minimum if math.isfinite(option.minimum) else -reach
        high = min(option.maximum, max(reach, low + 1))
        step = 1 if option.kind is int else float(f"{(high - low) / STEPS:.1g}")
    else:
        low, high, step = ends
    low, high = max(min(low, value), option.minimum), min(max(high, value), option.maximum)
    return {"min": low, "max": high, "step": step}


def moved_light(scene: Scene, light: Light, values: dict[str, Any]) -> Scene:
    """Return the scene with the light at the position that the controls have."""
    position = [float(values[f"{LIGHT}{name}"]) for name in "xyz"]
    moved = replace(light, position=np.array([*position, light.position[3]]))
    return replace(scene, lights=tuple(moved if each is light else each for each in scene.lights))


def options_in(values: dict[str, Any], technique: Technique) -> dict[str, Any]:
    """Return the options among the values of the controls; a browser has no whole numbers but those it writes so."""
    return {
        name: int(value) if technique.options[name].kind is int and value == int(value or 0) else value
        for name, value in values.items()
        if name in technique.options
    }
