"""Arguments that several commands share: scene, size, and options of the technique."""

from __future__ import annotations

import shlex
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from softshadow.scene import Scene

MODELS = (".obj", ".ply", ".stl", ".off", ".glb", ".gltf")
YES, NO = ("true", "yes", "on", "1"), ("false", "no", "off", "0")


class Size(click.ParamType):
    """WIDTHxHEIGHT, in pixels."""

    name = "WxH"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[int, int]:
        """Return (width, height) of a text such as "640x480"."""
        if isinstance(value, tuple):
            return value
        width, times, height = value.lower().partition("x")
        try:
            if times:
                return int(width), int(height)
        except ValueError:
            pass
        self.fail(f"{value!r}: expected WIDTHxHEIGHT in pixels, as in 640x480", param, ctx)


class Point(click.ParamType):
    """X,Y,Z, or X,Y,Z,W in homogeneous coordinates."""

    name = "X,Y,Z"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[float, ...]:
        """Return the numbers of a text such as "2,5,3"."""
        if isinstance(value, tuple):
            return value
        try:
            numbers = tuple(float(part) for part in value.split(","))
        except ValueError:
            numbers = ()
        if len(numbers) not in (3, 4):
            self.fail(f"{value!r}: expected X,Y,Z (a point) or X,Y,Z,0 (a direction towards the light)", param, ctx)
        return numbers


def examples(*commands: str) -> str:
    """Return the end of a help text with example commands, one in a line."""
    return "\n  ".join(("\b\nExamples:", *commands))


def scene_arguments(default_size: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return a decorator that adds --scene, --mesh, --light and --size."""

    def add(function: Callable[..., Any]) -> Callable[..., Any]:
        size_help = "Image size in pixels."
        light_help = "Replace the lights: X,Y,Z is a point, X,Y,Z,0 a direction."
        for option in (
            click.option("--size", type=Size(), default=default_size, show_default=True, help=size_help),
            click.option("--light", type=Point(), help=light_help),
            click.option("--mesh", metavar="FILE", help="Put a model (OBJ, PLY, STL, OFF, GLB, glTF) on a floor."),
            click.option("--scene", metavar="NAME|FILE.toml", help="A scene name or scene file.  [default: torus]"),
        ):
            function = option(function)
        return function

    return add


as_json = click.option("--json", "as_json", is_flag=True, help="Print the result as JSON.")
force = click.option("--force", is_flag=True, help="Also overwrite files that softshadow did not write.")
technique_options = click.option(
    "-O", "--option", "options", metavar="KEY=VALUE", multiple=True, help="Set an option of the technique; repeatable."
)


def load_scene(scene: str | None, mesh: str | None, light: tuple[float, ...] | None, default: str = "torus") -> Scene:
    """Return the scene that the arguments describe."""
    from dataclasses import replace

    from softshadow.scene import Light, Scene

    if scene and mesh:
        raise click.UsageError("--scene and --mesh: expected only one of them")
    if mesh:
        return Scene.from_mesh(mesh, light=light) if light else Scene.from_mesh(mesh)
    name = scene or default
    if Path(name).suffix.lower() in MODELS:
        raise click.UsageError(f"--scene {name}: this is a model file; expected --mesh {name}")
    chosen = Scene.load(name) if name.lower().endswith(".toml") else Scene.named(name)
    return replace(chosen, lights=(Light(light),)) if light else chosen


def scene_arguments_text(
    scene: str | None, mesh: str | None, light: tuple[float, ...] | None, size: tuple[int, int], default: str = "torus"
) -> str:
    """Return the command line arguments for a scene and size, quoted for a shell."""
    words = ["--mesh", mesh] if mesh else ["--scene", scene or default]
    if light:
        words += [f"--light={','.join(repr(number).removesuffix('.0') for number in light)}"]
    return shlex.join([*words, "--size", f"{size[0]}x{size[1]}"])


def parse_options(technique: str, texts: tuple[str, ...]) -> dict[str, Any]:
    """Return KEY=VALUE arguments as the technique's options, converted to their types; unknown keys stay strings."""
    from softshadow import techniques

    known = techniques.get(technique).options
    options: dict[str, Any] = {}
    for text in texts:
        key, equals, value = text.partition("=")
        if not equals:
            raise click.UsageError(f"--option {text!r}: expected KEY=VALUE")
        key = key.replace("-", "_")
        kind = known[key].kind if key in known else str
        options[key] = _convert(key, value, kind, known[key].expected if key in known else "")
    return options


def _convert(key: str, value: str, kind: type, expected: str) -> Any:
    if kind is bool:
        if value.lower() in YES + NO:
            return value.lower() in YES
        raise ValueError(f"option {key}={value!r}: expected true or false")
    try:
        return kind(value)
    except ValueError:
        raise ValueError(f"option {key}={value!r}: expected {expected}") from None
