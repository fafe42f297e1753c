"""Arguments that several commands share: scene, camera, size, and options of the technique."""

from __future__ import annotations

import functools
import shlex
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from softshadow.cli.names import SceneName, complete_files, complete_options

if TYPE_CHECKING:
    from softshadow.scene import Camera, Light, Scene

MODELS = (".obj", ".ply", ".stl", ".off", ".glb", ".gltf")
YES, NO = ("true", "yes", "on", "1"), ("false", "no", "off", "0")
Numbers = tuple[float, ...]


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

    def __init__(self, homogeneous: bool = False) -> None:
        self.homogeneous = homogeneous

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Numbers:
        """Return the numbers of a text such as "2,5,3"."""
        if isinstance(value, tuple):
            return value
        try:
            numbers = tuple(float(part) for part in value.split(","))
        except ValueError:
            numbers = ()
        if self.homogeneous and len(numbers) not in (3, 4):
            self.fail(f"{value!r}: expected X,Y,Z (a point) or X,Y,Z,0 (a direction towards the light)", param, ctx)
        if not self.homogeneous and len(numbers) != 3:
            self.fail(f"{value!r}: expected X,Y,Z", param, ctx)
        return numbers


class Pixel(click.ParamType):
    """X,Y of a pixel: from the left, and from the top."""

    name = "X,Y"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[int, int]:
        """Return the numbers of a text such as "160,170"."""
        if isinstance(value, tuple):
            return value
        with suppress(ValueError):
            x, y = map(int, value.split(","))
            return x, y
        self.fail(f"{value!r}: expected X,Y in pixels, as in 160,170", param, ctx)


def examples(*commands: str) -> str:
    """Return the end of a help text with example commands, one in a line."""
    return "\n  ".join(("\b\nExamples:", *commands))


# -- the scene ---------------------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class SceneArguments:
    """What the command line says about the scene: its name or file, its lights, its camera."""

    name: str | None = None
    mesh: str | None = None
    lights: tuple[Numbers, ...] = ()
    eye: Numbers | None = None
    target: Numbers | None = None
    fov: float | None = None

    def load(self, default: str = "torus") -> Scene:
        """Return the scene that the arguments describe."""
        from dataclasses import replace

        from softshadow.errors import SceneError
        from softshadow.scene import Scene

        if self.name and self.mesh:
            raise click.UsageError("--scene and --mesh: expected only one of them")
        name = self.name or default
        if Path(name).suffix.lower() in MODELS:
            raise click.UsageError(f"--scene {name}: this is a model file; expected --mesh {name}")
        lights = self._lights()
        if self.mesh:
            scene = Scene.from_mesh(self.mesh)
        else:
            scene = Scene.load(name) if name.lower().endswith(".toml") else Scene.named(name)
        scene = replace(scene, lights=lights) if lights else scene
        try:
            return replace(scene, camera=self._camera(scene.camera))
        except SceneError as error:
            raise click.UsageError(f"--eye, --target, --fov: {error}") from None

    def _lights(self) -> tuple[Light, ...]:
        from softshadow.errors import SceneError
        from softshadow.scene import Light

        names = ["light"] if len(self.lights) == 1 else [f"light {i + 1}" for i in range(len(self.lights))]
        try:
            return tuple(Light(position, name=name) for position, name in zip(self.lights, names, strict=True))
        except SceneError as error:
            raise click.UsageError(f"--light: {error}") from None

    def _camera(self, camera: Camera) -> Camera:
        from softshadow.scene import Camera

        if self.eye is None and self.target is None and self.fov is None:
            return camera
        return Camera(
            camera.eye if self.eye is None else self.eye,
            camera.target if self.target is None else self.target,
            camera.up,
            camera.fov_y if self.fov is None else self.fov,
            camera.near,
            camera.far,
        )

    def text(self, size: tuple[int, int], default: str = "torus") -> str:
        """Return the arguments of this scene and a size, quoted for a shell."""
        words = ["--mesh", self.mesh] if self.mesh else ["--scene", self.name or default]
        words += [f"--light={_spelled(light)}" for light in self.lights]
        words += [f"--{name}={_spelled(at)}" for name, at in (("eye", self.eye), ("target", self.target)) if at]
        words += [f"--fov={self.fov:g}"] if self.fov is not None else []
        return shlex.join([*words, "--size", f"{size[0]}x{size[1]}"])


def _spelled(numbers: Numbers) -> str:
    return ",".join(repr(number).removesuffix(".0") for number in numbers)


def scene_arguments(default_size: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return a decorator that adds --scene, --mesh, --light, --eye, --target, --fov and --size.

    The command gets `scene`, a `SceneArguments`, and `size`.
    """

    def add(function: Callable[..., Any]) -> Callable[..., Any]:
        @functools.wraps(function)
        def command(
            *arguments: Any, scene: str | None, mesh: str | None, light: tuple[Numbers, ...], eye: Numbers | None,
            target: Numbers | None, fov: float | None, **named: Any,
        ) -> Any:  # fmt: skip
            return function(*arguments, scene=SceneArguments(scene, mesh, light, eye, target, fov), **named)

        light_help = "Replace the lights: X,Y,Z is a point, X,Y,Z,0 a direction; repeatable, for several lights."
        for option in (
            click.option("--size", type=Size(), default=default_size, show_default=True, help="Image size in pixels."),
            click.option("--fov", type=float, metavar="DEGREES", help="Angle of view, from bottom to top."),
            click.option("--target", type=Point(), help="Point that the camera looks at."),
            click.option("--eye", type=Point(), help="Position of the camera."),
            click.option("--light", type=Point(homogeneous=True), multiple=True, help=light_help),
            click.option(
                "--mesh", metavar="FILE", shell_complete=complete_files,
                help="Put a model (OBJ, PLY, STL, OFF, GLB, glTF) on a floor.",
            ),
            click.option(
                "--scene", type=SceneName(), metavar="NAME|FILE.toml",
                help="A scene name or scene file.  [default: torus]",
            ),
        ):  # fmt: skip
            command = option(command)
        return command

    return add


# -- output ------------------------------------------------------------------------------------------------------------
as_json = click.option("--json", "as_json", is_flag=True, help="Print the result as JSON.")
force = click.option("--force", is_flag=True, help="Also overwrite files that softshadow did not write.")
open_file = click.option("--open", "opened", is_flag=True, help="Open the written file in the browser.")


def output_option(help_text: str, metavar: str = "OUT", **more: Any) -> Callable[[Callable[..., Any]], Any]:
    """Return a decorator that adds -o, with names of files as completion."""
    return click.option("-o", "--output", metavar=metavar, help=help_text, shell_complete=complete_files, **more)


def check_opened(opened: bool, output: str | None) -> None:
    """Raise an error if --open is given without a file to open."""
    if opened and output is None:
        raise click.UsageError("--open: expected a file to write, -o")


# -- options of techniques ---------------------------------------------------------------------------------------------
technique_options = click.option(
    "-O", "--option", "options", metavar="KEY=VALUE", multiple=True, shell_complete=complete_options,
    help="Set an option of the technique; repeatable.",
)  # fmt: skip


@dataclass(frozen=True)
class ChosenTechnique:
    """A technique with options, written NAME or NAME:KEY=VALUE,KEY=VALUE."""

    name: str
    options: dict[str, Any] = field(default_factory=dict)

    @property
    def label(self) -> str:
        """The technique and its options."""
        return " ".join([self.name, *(f"{key}={value}" for key, value in self.options.items())])


def chosen_techniques(texts: Sequence[str], shared: Sequence[str]) -> list[ChosenTechnique]:
    """Return techniques with their own options and those `shared` options that they have.

    Raises
    ------
    UsageError                   no technique has a shared option, or a text is not KEY=VALUE
    ValueError                   an unknown technique, or a value of another type
    """
    from softshadow import techniques
    from softshadow.errors import nearest

    chosen, unused = [], list(shared)
    for text in texts:
        name, colon, own = text.partition(":")
        known = techniques.get(name).options
        fitting = [each for each in shared if _key(each) in known]
        unused = [each for each in unused if each not in fitting]
        chosen.append(ChosenTechnique(name, parse_options(name, [*fitting, *(own.split(",") if colon else ())])))
    if unused:
        keys = dict.fromkeys(key for each in chosen for key in techniques.get(each.name).options)
        raise click.UsageError(f"--option {unused[0]!r}: no technique here has it; {nearest(_key(unused[0]), keys)}")
    return chosen


def parse_options(technique: str, texts: Sequence[str]) -> dict[str, Any]:
    """Return KEY=VALUE arguments as the technique's options, converted to their types; unknown keys stay strings."""
    from softshadow import techniques

    known = techniques.get(technique).options
    options: dict[str, Any] = {}
    for text in texts:
        key, value = _key(text), text.partition("=")[2]
        kind = known[key].kind if key in known else str
        options[key] = _convert(key, value, kind, known[key].expected if key in known else "")
    return options


def _key(text: str) -> str:
    """Return the key of KEY=VALUE, with underscores."""
    key, equals, _ = text.partition("=")
    if not equals:
        raise click.UsageError(f"--option {text!r}: expected KEY=VALUE")
    return key.replace("-", "_")


def _convert(key: str, value: str, kind: type, expected: str) -> Any:
    if kind is bool:
        if value.lower() in YES + NO:
            return value.lower() in YES
        raise ValueError(f"option {key}={value!r}: expected true or false")
    try:
        return kind(value)
    except ValueError:
        raise ValueError(f"option {key}={value!r}: expected {expected}") from None
