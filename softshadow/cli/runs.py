"""``softshadow render``, ``steps``, ``pixel`` and ``section``: draw a scene, and show the result."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from softshadow.cli.arguments import (
    SceneArguments,
    as_json,
    check_opened,
    examples,
    force,
    open_file,
    output_option,
    parse_options,
    scene_arguments,
    technique_options,
)
from softshadow.cli.console import print_json, print_warnings_once, say_if_compiling, say_written, show, table
from softshadow.cli.names import TechniqueName

if TYPE_CHECKING:
    from softshadow.runs import Run


def _draw(technique: str, size: tuple[int, int], options: tuple[str, ...], scene: SceneArguments) -> Run:
    from softshadow.runs import run

    values = parse_options(technique, options)
    with print_warnings_once():
        drawn = scene.load()
        say_if_compiling()
        return run(technique, drawn, size, **values)


def _about(run: Run) -> dict[str, Any]:
    """Return what a run is, as the beginning of a JSON result."""
    return {
        "technique": run.technique,
        "scene": run.scene.name if run.scene is not None else None,
        "size": run.size,
        "options": run.options,
        "warnings": [{"name": type(each).__name__, "text": str(each)} for each in run.warnings],
    }


@click.command(
    epilog=examples(
        "softshadow render volume-zfail -o torus.png",
        "softshadow render map --scene boxes --size 320x240 -O factor=0 -O units=0 -o acne.html",
        "softshadow render map --eye 3,4,3 --target 0,0.5,0 --fov 60 -o from-above.png",
        "softshadow render --all --scene boxes --size 160x120 -o all-techniques/",
    )
)
@click.argument("technique", type=TechniqueName(), required=False)
@scene_arguments("640x480")
@technique_options
@click.option("--all", "all_techniques", is_flag=True, help="Draw with every technique, into a folder.")
@output_option("A .png, .html, .npz, .glb or .ply file, or a folder/.  [default: TECHNIQUE.png, or all-techniques/]")
@open_file
@click.option(
    "--explain-path", is_flag=True, help="Also print which way every draw went through the pipeline, and why."
)
@force
@as_json
def render(
    technique: str | None, scene: SceneArguments, size: tuple[int, int], options: tuple[str, ...],
    all_techniques: bool, output: str | None, opened: bool, explain_path: bool, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Draw a scene with a technique and write the result.

    The suffix of OUT selects the result: an image (.png), a report (.html), all buffers (.npz), the geometry of the
    shadows (.glb, .ply), or a folder with an image of every step. With --all, the folder gets the image of every
    technique, and sheet.png with all of them.
    """
    from softshadow.pipeline import explain_paths
    from softshadow.runs.saving import check_path

    if all_techniques == (technique is not None):
        raise click.UsageError("expected the name of a TECHNIQUE, or --all")
    if technique is None:
        from softshadow.cli.all_techniques import render_all

        if explain_path:
            raise click.UsageError("--explain-path: expected the name of a TECHNIQUE")
        render_all(scene, size, options, output or "all-techniques/", opened, force, as_json)
        return
    target = output or f"{technique}.png"
    check_path(target, force)
    with explain_paths() as paths:
        run = _draw(technique, size, options, scene)
    written = run.save(target, force=force)
    if as_json:
        shadowed = float(run.shadow_mask.mean()) if "visibility" in run.maps else None
        explained = {"paths": [vars(path) for path in paths]} if explain_path else {}
        print_json("render", written=written, shadowed_share=shadowed, **explained, **_about(run))
    elif explain_path:
        columns = ["object", "way", "fill", "shading", "why"]
        rows = [
            [path.label, path.way, path.fill or "-", path.shading or "-", "; ".join(path.reasons)] for path in paths
        ]
        table("draws", columns, rows)
    say_written(written, opened=opened)


@click.command(
    epilog=examples(
        "softshadow steps volume-zpass",
        "softshadow steps volume-zfail --scene overlapping --size 320x240",
        "softshadow steps planar -O method=stencil -o planar-steps/",
    )
)
@click.argument("technique", type=TechniqueName())
@scene_arguments("320x240")
@technique_options
@output_option("Also write images of every step and all buffers.", "FOLDER")
@open_file
@force
@as_json
def steps(
    technique: str, scene: SceneArguments, size: tuple[int, int], options: tuple[str, ...], output: str | None,
    opened: bool, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Print statistics and stencil counts of every step."""
    check_opened(opened, output)
    run = _draw(technique, size, options, scene)
    written = [run.save(str(Path(output)) + "/", force=force)] if output else []
    if as_json:
        print_json("steps", steps=step_facts(run), **_about(run))
    else:
        print_steps(run)
    say_written(*written, opened=opened)


def step_facts(run: Run) -> list[dict[str, Any]]:
    """Return the numbers of every step of a run for JSON."""
    return [
        {
            "title": counts.title,
            "draws": counts.draws,
            "triangles": counts.triangles,
            "fragments": counts.fragments,
            "stencil_updates": counts.stencil_updates,
            "stencil_counts": histogram,
        }
        for counts, histogram in zip(run.ledger.steps, stencil_histograms(run), strict=True)
    ]


def print_steps(run: Run) -> None:
    """Print the numbers of every step of a run as a table."""
    columns = ["step", "title", "draws", "triangles", "fragments", "depth failed", "stencil updates", "stencil: pixels"]
    rows = [
        [
            str(index), counts.title, str(counts.draws), str(counts.triangles), str(counts.all_fragments),
            str(counts.fragments["depth failed"]), str(counts.stencil_updates),
            "  ".join(f"{value}: {pixels}" for value, pixels in histogram.items()),
        ]
        for index, (counts, histogram) in enumerate(zip(run.ledger.steps, stencil_histograms(run), strict=True))
    ]  # fmt: skip
    table(repr(run), columns, rows)


def stencil_histograms(run: Run) -> list[dict[int, int]]:
    """Return how many pixels have each stencil value, for every step of a run."""
    import numpy as np

    counts = [np.unique(step.stencil, return_counts=True) for step in run.steps]
    return [dict(zip(values.tolist(), pixels.tolist(), strict=True)) for values, pixels in counts]


@click.command(
    epilog=examples("softshadow pixel volume-zfail 160 170", "softshadow pixel map 100 120 --scene boxes --json")
)
@click.argument("technique", type=TechniqueName())
@click.argument("x", type=int)
@click.argument("y", type=int)
@scene_arguments("320x240")
@technique_options
@as_json
def pixel(
    technique: str, x: int, y: int, scene: SceneArguments, size: tuple[int, int], options: tuple[str, ...],
    as_json: bool,
) -> None:  # fmt: skip
    """Explain why a pixel is lit or in shadow.

    Lists every fragment at the pixel. X counts from the left, Y from the top. For the pixels of a listing, see
    `softshadow listings NAME --pixel X,Y`.
    """
    run = _draw(technique, size, options, scene)
    with print_warnings_once():
        history = run.pixel(x, y)
        sentence = run.explain(x, y)
    if as_json:
        print_json(
            "pixel", x=x, y=y, gl_y=size[1] - 1 - y, explanation=sentence, fragments=history.to_dicts(), **_about(run)
        )
    else:
        show(history)
        show(sentence)


@click.command(epilog=examples("softshadow section --scene soft-slab", "softshadow section 300 330 -o torus.svg"))
@click.argument("x", type=int, required=False)
@click.argument("y", type=int, required=False)
@scene_arguments("640x480")
@output_option("The drawing.", "FILE.svg", default="section.svg", show_default=True)
@open_file
@force
@as_json
def section(
    x: int | None, y: int | None, scene: SceneArguments, size: tuple[int, int], output: str, opened: bool, force: bool,
    as_json: bool,
) -> None:  # fmt: skip
    """Draw a scene cut by a plane, with its volumes.

    Penumbra wedges of area lights are drawn, too. The plane is vertical, through the light and the casters; or, with X
    and Y, through the light, the eye and what this pixel shows. Then the counts along the line of sight are drawn, too.
    """
    from softshadow.report import cross_section, save_svg

    if (x is None) != (y is None):
        raise click.UsageError("expected both X and Y, or neither")
    pixel = None if x is None or y is None else (x, y)
    with print_warnings_once():
        drawing = cross_section(scene.load(), pixel, size)
    written = save_svg(drawing, output, force)
    if as_json:
        crossings = [{"caster": each.caster, "step": each.step, "count": each.count} for each in drawing.crossings]
        print_json("section", written=written, crossings=crossings)
    else:
        for each in drawing.crossings:
            click.echo(f"{each.step:+d} = {each.count}  {each.caster}")
    say_written(written, opened=opened)
