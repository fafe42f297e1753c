"""``softshadow warmup`` and ``softshadow doctor``: compiled code and installed packages on this machine."""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import click

from softshadow.cli.arguments import as_json, examples
from softshadow.cli.console import print_json, say, table

PACKAGES = ("numpy", "numba", "llvmlite", "trimesh", "pillow", "imageio", "click", "rich", "pydantic", "jinja2")
EXTRAS = {
    "mesa": "OpenGL", "properties": "hypothesis", "truth": "embreex", "notebook": "ipykernel", "exr": "OpenEXR",
    "trace": "cramjam", "sweep": "distributed", "video": "av",
}  # fmt: skip
WARM_SIZE = (64, 48)
LARGE_IMAGE = 256  # pixels of a side
PROGRAM_SIZE = (160, 120)  # enough for bounds of depths over tiles
FEWER = {"samples": 9, "map_size": 64}  # still eight maps at once, and one alone


@click.command(epilog=examples("softshadow warmup", "softshadow warmup --json"))
@as_json
def warmup(as_json: bool) -> None:
    """Compile the kernels of all techniques and of ordinary GL programs, and cache them."""
    import warnings

    from softshadow.errors import Warning as SoftShadowWarning
    from softshadow.kernel_cache import cache_folder

    start = time.perf_counter()
    with warnings.catch_warnings(), _without_collection(), _without_announcement():
        warnings.simplefilter("ignore", SoftShadowWarning)  # the images are not used
        _draw_techniques()
        _draw_programs()
        _move_images()
    seconds = time.perf_counter() - start
    if as_json:
        print_json("warmup", seconds=seconds, cache_folder=cache_folder())
    else:
        folder = cache_folder()
        where = f"compiled code is in {folder}" if folder else "not cached: no cache folder is writable"
        click.echo(f"ready in {seconds:.1f} s, {where}")


def _draw_techniques() -> None:
    """Run each technique with its default options, and with each other value of a choice or switch."""
    from softshadow import techniques
    from softshadow.pipeline import use_short_cuts
    from softshadow.runs import run
    from softshadow.scene import Scene

    scene = Scene.named("boxes")
    with use_short_cuts("always"):
        for name in techniques.names():
            for options in _option_sets(name):
                text = ", ".join(f"{key}={value}" for key, value in options.items() if key not in FEWER)
                say(f"compiling {name}{f' ({text})' if text else ''} ...")
                run(name, scene, WARM_SIZE, **options)


def _draw_programs() -> None:
    """Draw the first two frames of each program of the corpus, whose small draws use other kernels than techniques.

    The second frame draws some arrays again, which has kernels of its own.
    """
    from softshadow import gl
    from softshadow.bench.corpus.programs import PROGRAMS

    for program in PROGRAMS.values():
        say(f"compiling what {program.name} draws with ...")
        with gl.create_context(*PROGRAM_SIZE):
            frame = program.prepare(gl, PROGRAM_SIZE)
            for number in range(2):
                frame(number)
                gl.glFinish()


def _move_images() -> None:
    """Make a texture of an image, and read the window: kernels convert the pixels of large ones, and filter levels."""
    import numpy as np

    from softshadow import gl

    side = LARGE_IMAGE
    say("compiling what large images are converted with ...")
    with gl.create_context(side, side):
        gl.glTexImage2D(
            gl.GL_TEXTURE_2D, 0, gl.GL_RGB, side, side, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE,
            np.zeros((side, side, 3), np.uint8),
        )  # fmt: skip
        gl.glReadPixels(0, 0, side, side, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGB, 1, 2, 0, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, None)
        gl.glGenerateMipmap(gl.GL_TEXTURE_2D)  # of an image with a side that is not even
        gl.gluBuild2DMipmaps(
            gl.GL_TEXTURE_2D, gl.GL_RGB, 3, 5, gl.GL_RGB, gl.GL_UNSIGNED_BYTE, np.zeros((5, 12), np.uint8)
        )


@contextmanager
def _without_collection() -> Iterator[None]:
    """Pause garbage collection: between two kernels and at the end it would look at all that the compiler has made."""
    import gc

    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        if was_enabled:
            gc.enable()


@contextmanager
def _without_announcement() -> Iterator[None]:
    """Do not let programs say that they wait for the compiler, and that `warmup` helps."""
    logger = logging.getLogger("softshadow")
    before = logger.level
    logger.setLevel(logging.ERROR)
    try:
        yield
    finally:
        logger.setLevel(before)


def _option_sets(name: str) -> list[dict[str, Any]]:
    """Return the technique's default options, and one set for each other value of a choice or switch."""
    from softshadow import techniques

    options = techniques.get(name).options
    fewer = {key: number for key, number in FEWER.items() if key in options}
    sets: list[dict[str, Any]] = [fewer]
    for key, option in options.items():
        others = option.choices if option.choices else (True, False) if option.kind is bool else ()
        sets += [{**fewer, key: value} for value in others if value != option.default]
    return sets


@click.command(epilog=examples("softshadow doctor", "softshadow doctor --json"))
@as_json
def doctor(as_json: bool) -> None:
    """Show versions, cache folder, threads and installed extras."""
    import importlib.util
    import platform

    import softshadow
    from softshadow.kernel_cache import cache_folder
    from softshadow.pipeline import threads
    from softshadow.testing import EXPECTED_VERSION, mesa_available, mesa_reason, mesa_version

    versions = {name: _version(name) for name in PACKAGES}
    extras = {name: importlib.util.find_spec(module) is not None for name, module in EXTRAS.items()}
    mesa = f"{mesa_version()} (softshadow reproduces {EXPECTED_VERSION})" if mesa_available() else mesa_reason()
    facts = {
        "softshadow": softshadow.__version__,
        "python": platform.python_version(),
        "system": f"{platform.system()} {platform.machine()}",
        "threads": threads(),
        "cache folder": str(cache_folder() or "none is writable: kernels are compiled at every start"),
        "Mesa": mesa,
    }
    if as_json:
        print_json("doctor", **{_key(name): fact for name, fact in facts.items()}, packages=versions, extras=extras)
        return
    rows = [[key, str(value)] for key, value in facts.items()]
    rows += [[name, version] for name, version in versions.items()]
    rows += [
        [f"extra {name}", "installed" if installed else f"missing: pip install 'softshadow[{name}]'"]
        for name, installed in extras.items()
    ]
    table("softshadow doctor", ["item", "value"], rows)


def _key(name: str) -> str:
    return name.lower().replace(" ", "_")


def _version(name: str) -> str:
    import importlib.metadata

    try:
        return importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return "missing"
