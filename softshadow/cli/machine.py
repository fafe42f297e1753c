"""``softshadow warmup`` and ``softshadow doctor``: the machine this runs on."""

from __future__ import annotations

import time
from typing import Any

import click

from softshadow.cli.arguments import as_json
from softshadow.cli.console import print_json, say, table

PACKAGES = ("numpy", "numba", "llvmlite", "trimesh", "pillow", "imageio", "click", "rich", "pydantic", "jinja2")
EXTRAS = {
    "mesa": "OpenGL",
    "properties": "hypothesis",
    "truth": "embreex",
    "notebook": "anywidget",
    "exr": "OpenEXR",
    "video": "av",
}
WARM_SIZE = (64, 48)


@click.command(epilog="Examples:  softshadow warmup  |  softshadow warmup --json")
@as_json
def warmup(as_json: bool) -> None:
    """Compile the kernels, and the states that the techniques use, and keep the code on disk."""
    import warnings

    from softshadow import techniques
    from softshadow.errors import Warning as SoftShadowWarning
    from softshadow.kernel_cache import cache_folder
    from softshadow.pipeline import use_short_cuts
    from softshadow.runs import run

    start = time.perf_counter()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SoftShadowWarning)  # of small pictures of scenes that nobody will see
        for name in techniques.names():
            for options in _option_sets(name):
                text = ", ".join(f"{key}={value}" for key, value in options.items())
                say(f"compiling {name}{f' ({text})' if text else ''} ...")
                for policy in (False, "always"):
                    with use_short_cuts(policy):
                        run(name, "boxes", WARM_SIZE, **options)
    seconds = time.perf_counter() - start
    if as_json:
        print_json("warmup", seconds=seconds, cache_folder=cache_folder())
    else:
        click.echo(f"ready in {seconds:.1f} s, code kept in {cache_folder() or 'no folder: none can be written'}")


def _option_sets(name: str) -> list[dict[str, Any]]:
    """Return the defaults of a technique, and each other choice and switch of it on its own."""
    from softshadow import techniques

    sets: list[dict[str, Any]] = [{}]
    for key, option in techniques.get(name).options.items():
        others = option.choices if option.choices else (True, False) if option.kind is bool else ()
        sets += [{key: value} for value in others if value != option.default]
    return sets


@click.command(epilog="Examples:  softshadow doctor  |  softshadow doctor --json")
@as_json
def doctor(as_json: bool) -> None:
    """Tell versions, cache folder, threads, and which extras are there."""
    import importlib.util
    import platform

    import softshadow
    from softshadow.kernel_cache import cache_folder
    from softshadow.pipeline import threads
    from softshadow.testing import EXPECTED_VERSION, mesa_available, mesa_reason, mesa_version

    found = {name: _version(name) for name in PACKAGES}
    extras = {name: importlib.util.find_spec(module) is not None for name, module in EXTRAS.items()}
    mesa = f"{mesa_version()} (compared with {EXPECTED_VERSION})" if mesa_available() else f"no: {mesa_reason()}"
    facts = {
        "softshadow": softshadow.__version__,
        "python": platform.python_version(),
        "system": f"{platform.system()} {platform.machine()}",
        "threads": threads(),
        "cache folder": str(cache_folder() or "none can be written: kernels are compiled on every start"),
        "Mesa": mesa,
    }
    if as_json:
        print_json("doctor", **{_key(name): fact for name, fact in facts.items()}, packages=found, extras=extras)
        return
    rows = [[key, str(value)] for key, value in facts.items()]
    rows += [[name, version] for name, version in found.items()]
    rows += [
        [f"extra {name}", "there" if there else f"pip install 'softshadow[{name}]'"] for name, there in extras.items()
    ]
    table("softshadow doctor", ["what", "found"], rows)


def _key(name: str) -> str:
    return name.lower().replace(" ", "_")


def _version(name: str) -> str:
    import importlib.metadata

    try:
        return importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return "missing"
