"""``softshadow render``, ``steps``, ``pixel`` and ``section``: draw a scene, and show the result."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from softshadow.cli.arguments import (
    as_json,
    examples,
    force,
    load_scene,
    parse_options,
    scene_arguments,
    technique_options,
)
from softshadow.cli.console import print_json, print_warnings_once, say, say_if_compiling, table

if TYPE_CHECKING:
    from softshadow.runs import Run


def _draw(technique: str, size: tuple[int, int], options: tuple[str, ...], **scene_arguments: Any) -> Run:
    from softshadow.runs import run

    values = parse_options(technique, options)
    with print_warnings_once():
        scene = load_scene(**scene_arguments)
        say_if_compiling()
        return run(technique, scene, size, **values)


def _about(run: Run) -> dict[str, Any]:
    return {
        "technique": run.technique,
        "scene": run.scene.name,
        "size": run.size,
        "options": run.options,
        "warnings": [{"name": type(each).__name__, "text": str(each)} for each in run.warnings],
    }


@click.command(
    epilog=examples(
        "softshadow render volume-zfail -o torus.png",
        "softshadow render map --scene boxes --size 320x240 -O factor=0 -O units=0 -o acne.html",
    )
)
@click.argument("technique")
@scene_arguments("640x480")
@technique_options
@click.option(
    "-o",
    "--output",
    metavar="OUT",
    help="A .png, .html, .npz, .glb or .ply file, or a folder/.  [default: TECHNIQUE.png]",
)
@click.option(
    "--explain-path", is_flag=True, help="Also print which way every draw went through the pipeline, and why."
)
@force
@as_json
def render(
    technique: str, scene: str | None, mesh: str | None, light: tuple[float, ...] | None, size: tuple[int, int],
    options: tuple[str, ...], output: str | None, explain_path: bool, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Draw a scene with a technique and write the result.

    The suffix of OUT selects the result: an image (.png), a report (.html), all buffers (.npz), the geometry of the
    shadows (.glb, .ply), or a folder with an image of every step.
    """
    from softshadow.pipeline import explain_paths
    from softshadow.runs.saving import check_path

    target = output or f"{technique}.png"
    check_path(target, force)
    with explain_paths() as paths:
        run = _draw(technique, size, options, scene=scene, mesh=mesh, light=light)
    written = run.save(target, force=force)
    if as_json:
        shadowed = float(run.shadow_mask.mean()) if "visibility" in run.maps else None
        explained = {"paths": [vars(path) for path in paths]} if explain_path else {}
        print_json("render", written=written, shadowed_share=shadowed, **explained, **_about(run))
        return
    if explain_path:
        columns = ["object", "way", "fill", "shading", "why"]
        rows = [
            [path.label, path.way, path.fill or "-", path.shading or "-", "; ".join(path.reasons)] for path in paths
        ]
        table("draws", columns, rows)
    click.echo(written)


@click.command(
    epilog=examples("softshadow steps volume-zpass", "softshadow steps planar -O method=stencil -o planar-steps/")
)
@click.argument("technique")
@scene_arguments("320x240")
@technique_options
@click.option("-o", "--output", metavar="FOLDER", help="Also write images of every step and all buffers.")
@force
@as_json
def steps(
    technique: str, scene: str | None, mesh: str | None, light: tuple[float, ...] | None, size: tuple[int, int],
    options: tuple[str, ...], output: str | None, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Print statistics and stencil counts of every step."""
    import numpy as np

    run = _draw(technique, size, options, scene=scene, mesh=mesh, light=light)
    ledger = run.ledger.steps
    histograms = [dict(zip(*np.unique(step.stencil, return_counts=True), strict=True)) for step in run.steps]
    if output:
        say(f"written: {run.save(str(Path(output)) + '/', force=force)}")
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
            for counts, histogram in zip(ledger, histograms, strict=True)
        ]
        print_json("steps", steps=rows, **_about(run))
        return
    columns = ["step", "title", "draws", "triangles", "fragments", "depth failed", "stencil updates", "stencil: pixels"]
    rows_of_text = [
        [
            str(index), counts.title, str(counts.draws), str(counts.triangles), str(counts.all_fragments),
            str(counts.fragments["depth failed"]), str(counts.stencil_updates),
            "  ".join(f"{value}: {pixels}" for value, pixels in histogram.items()),
        ]
        for index, (counts, histogram) in enumerate(zip(ledger, histograms, strict=True))
    ]  # fmt: skip
    table(repr(run), columns, rows_of_text)


@click.command(
    epilog=examples("softshadow pixel volume-zfail 160 170", "softshadow pixel map 100 120 --scene boxes --json")
)
@click.argument("technique")
@click.argument("x", type=int)
@click.argument("y", type=int)
@scene_arguments("320x240")
@technique_options
@as_json
def pixel(
    technique: str, x: int, y: int, scene: str | None, mesh: str | None, light: tuple[float, ...] | None,
    size: tuple[int, int], options: tuple[str, ...], as_json: bool,
) -> None:  # fmt: skip
    """Explain why a pixel is lit or in shadow.

    Lists every fragment at the pixel. X counts from the left, Y from the top.
    """
    run = _draw(technique, size, options, scene=scene, mesh=mesh, light=light)
    history = run.pixel(x, y)
    sentence = run.explain(x, y)
    if as_json:
        print_json(
            "pixel", x=x, y=y, gl_y=size[1] - 1 - y, explanation=sentence, fragments=history.to_dicts(), **_about(run)
        )
    else:
        click.echo(history)
        click.echo(sentence)


@click.command(epilog=examples("softshadow section --scene soft-slab", "softshadow section 300 330 -o torus.svg"))
@click.argument("x", type=int, required=False)
@click.argument("y", type=int, required=False)
@scene_arguments("640x480")
@click.option("-o", "--output", metavar="FILE.svg", default="section.svg", show_default=True, help="The drawing.")
@force
@as_json
def section(
    x: int | None, y: int | None, scene: str | None, mesh: str | None, light: tuple[float, ...] | None,
    size: tuple[int, int], output: str, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Draw a scene cut by a plane, with its shadow volumes and wedges.

    The plane is vertical, through the light and the casters; or, with X and Y, through the light, the eye and what this
    pixel shows. Then the counts along the line of sight are drawn, too.
    """
    from softshadow.report import cross_section, save_svg

    if (x is None) != (y is None):
        raise click.UsageError("expected both X and Y, or neither")
    pixel = None if x is None or y is None else (x, y)
    with print_warnings_once():
        drawing = cross_section(load_scene(scene=scene, mesh=mesh, light=light), pixel, size)
    written = save_svg(drawing, output, force)
    if as_json:
        crossings = [{"caster": each.caster, "step": each.step, "count": each.count} for each in drawing.crossings]
        print_json("section", written=written, crossings=crossings)
        return
    for each in drawing.crossings:
        click.echo(f"{each.step:+d} = {each.count}  {each.caster}")
    click.echo(written)
