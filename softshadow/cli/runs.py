"""``softshadow render``, ``steps`` and ``pixel``: one technique on one scene."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from softshadow.cli.arguments import as_json, chosen_scene, force, parsed_options, scene_arguments, technique_options
from softshadow.cli.console import named_warnings, print_json, say, say_if_compiling, table

if TYPE_CHECKING:
    from softshadow.runs import Run


def _run(technique: str, size: tuple[int, int], given: tuple[str, ...], **where: Any) -> Run:
    from softshadow.runs import run

    options = parsed_options(technique, given)
    with named_warnings():
        scene = chosen_scene(**where)
        say_if_compiling()
        return run(technique, scene, size, **options)


def _about(made: Run) -> dict[str, Any]:
    return {
        "technique": made.technique,
        "scene": made.scene.name,
        "size": made.size,
        "options": made.options,
        "warnings": [{"name": type(each).__name__, "text": str(each)} for each in made.warnings],
    }


@click.command(
    epilog="Examples:  softshadow render volume-zfail -o torus.png  |  "
    "softshadow render map --scene boxes --size 320x240 -O factor=0 -O units=0 -o acne.html"
)
@click.argument("technique")
@scene_arguments("640x480")
@technique_options
@click.option(
    "-o", "--output", metavar="OUT", help="A .png, .html or .npz file, or a folder/.  [default: TECHNIQUE.png]"
)
@force
@as_json
def render(
    technique: str, scene: str | None, mesh: str | None, light: tuple[float, ...] | None, size: tuple[int, int],
    given: tuple[str, ...], output: str | None, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Draw a scene with a technique, and write the picture, the report, or all buffers."""
    from softshadow.runs.saving import check_path

    target = output or f"{technique}.png"
    check_path(target, force)
    made = _run(technique, size, given, scene=scene, mesh=mesh, light=light)
    written = made.save(target, force=force)
    if as_json:
        shadowed = float(made.shadow_mask.mean()) if "visibility" in made.maps else None
        print_json("render", written=written, shadowed_share=shadowed, **_about(made))
    else:
        click.echo(written)


@click.command(
    epilog="Examples:  softshadow steps volume-zpass  |  softshadow steps planar -O method=stencil -o planar-steps/"
)
@click.argument("technique")
@scene_arguments("320x240")
@technique_options
@click.option("-o", "--output", metavar="FOLDER", help="Write pictures of every step and all buffers there, too.")
@force
@as_json
def steps(
    technique: str, scene: str | None, mesh: str | None, light: tuple[float, ...] | None, size: tuple[int, int],
    given: tuple[str, ...], output: str | None, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Count what every step of a technique does, and what it leaves in the stencil buffer."""
    import numpy as np

    made = _run(technique, size, given, scene=scene, mesh=mesh, light=light)
    counted = made.ledger.steps
    histograms = [dict(zip(*np.unique(step.stencil, return_counts=True), strict=True)) for step in made.steps]
    if output:
        say(f"written: {made.save(str(Path(output)) + '/', force=force)}")
    if as_json:
        rows = [
            {
                "title": counts.title,
                "draws": counts.draws,
                "triangles": counts.triangles,
                "fragments": counts.fragments,
                "stencil_updates": counts.stencil_updates,
                "stencil_counts": {int(value): int(pixels) for value, pixels in histogram.items()},
            }
            for counts, histogram in zip(counted, histograms, strict=True)
        ]
        print_json("steps", steps=rows, **_about(made))
        return
    columns = ["step", "title", "draws", "triangles", "fragments", "depth failed", "stencil updates", "stencil: pixels"]
    rows_of_text = [
        [
            str(index), counts.title, str(counts.draws), str(counts.triangles), str(counts.all_fragments),
            str(counts.fragments["depth failed"]), str(counts.stencil_updates),
            "  ".join(f"{value}: {pixels}" for value, pixels in histogram.items()),
        ]
        for index, (counts, histogram) in enumerate(zip(counted, histograms, strict=True))
    ]  # fmt: skip
    table(repr(made), columns, rows_of_text)


@click.command(
    epilog="Examples:  softshadow pixel volume-zfail 160 170  |  softshadow pixel map 100 120 --scene boxes --json"
)
@click.argument("technique")
@click.argument("x", type=int)
@click.argument("y", type=int)
@scene_arguments("320x240")
@technique_options
@as_json
def pixel(
    technique: str, x: int, y: int, scene: str | None, mesh: str | None, light: tuple[float, ...] | None,
    size: tuple[int, int], given: tuple[str, ...], as_json: bool,
) -> None:  # fmt: skip
    """Tell why a pixel is lit, shaded or dark: every fragment that met it. X from the left, Y from the top."""
    made = _run(technique, size, given, scene=scene, mesh=mesh, light=light)
    history = made.pixel(x, y)
    sentence = made.explain(x, y)
    if as_json:
        print_json(
            "pixel", x=x, y=y, gl_y=size[1] - 1 - y, explanation=sentence, fragments=history.to_dicts(), **_about(made)
        )
    else:
        click.echo(history)
        click.echo(sentence)
