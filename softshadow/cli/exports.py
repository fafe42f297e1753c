"""``softshadow export`` and ``view3d``: a buffer of a run as a file, and its geometry as a page or model."""

from __future__ import annotations

import click

from softshadow.cli.arguments import (
    SceneArguments,
    as_json,
    examples,
    force,
    scene_arguments,
    technique_options,
)
from softshadow.cli.console import print_json, say_written
from softshadow.cli.names import TechniqueName
from softshadow.cli.runs import _about, _draw


@click.command(
    epilog=examples(
        "softshadow export volume-zfail stencil -o stencil.npz",
        "softshadow export map ZS -o shadow-map.png --scene boxes",
    )
)
@click.argument("technique", type=TechniqueName())
@click.argument("buffer")
@scene_arguments("640x480")
@technique_options
@click.option("-o", "--output", metavar="FILE", help="A .npz, .exr or .png file.  [default: BUFFER.npz]")
@click.option("--step", metavar="N|TITLE", help="The step after which; by default the last that has the buffer.")
@force
@as_json
def export(
    technique: str, buffer: str, size: tuple[int, int], options: tuple[str, ...], output: str | None,
    step: str | None, force: bool, as_json: bool, scene: SceneArguments,
) -> None:  # fmt: skip
    """Write one buffer or map of a run to a file.

    BUFFER is color, depth, stencil, or the name of a map. A .npz or .exr file (which needs OpenEXR) has every value
    exactly, a .png file is the picture that reports show.
    """
    from softshadow.inspection.buffer_files import check_extension

    target = output or f"{buffer}.npz"
    check_extension(target)
    run = _draw(technique, size, options, scene)
    chosen = int(step) if step is not None and step.lstrip("-").isdigit() else step
    try:
        written = run.export(buffer, target, chosen, force)
    except (KeyError, IndexError) as error:
        raise ValueError(f"--step {step!r}: {error.args[0]}") from None
    if as_json:
        print_json("export", written=written, buffer=buffer, step=chosen, **_about(run))
    else:
        say_written(written)


@click.command(
    epilog=examples("softshadow view3d volume-zfail 300 300", "softshadow view3d map --scene boxes -o map.html")
)
@click.argument("technique", type=TechniqueName())
@click.argument("x", type=int, required=False)
@click.argument("y", type=int, required=False)
@scene_arguments("640x480")
@technique_options
@click.option(
    "-o", "--output", metavar="FILE", help="A .html page, or a .glb or .ply model.  [default: TECHNIQUE-3d.html]"
)
@click.option("--of-light", metavar="NAME", help="The light, by its name.  [default: the first]")
@force
@as_json
def view3d(
    technique: str, x: int | None, y: int | None, size: tuple[int, int], options: tuple[str, ...],
    output: str | None, of_light: str | None, force: bool, as_json: bool, scene: SceneArguments,
) -> None:  # fmt: skip
    """Show what a technique builds in three dimensions, and the counted faces along a pixel's line of sight.

    The page works offline. X counts from the left, Y from the top.
    """
    if (x is None) != (y is None):
        raise click.UsageError("expected both X and Y, or neither")
    run = _draw(technique, size, options, scene)
    view = run.view3d(x, y, of_light)
    written = view.save(output or f"{technique}-3d.html", force)
    if as_json:
        crossings = [
            {
                "caster": each.caster,
                "part": each.part,
                "number": each.number,
                "change": each.change,
                "count": each.count,
            }
            for each in view.crossings
        ]
        print_json("view3d", written=written, crossings=crossings, **_about(run))
        return
    if view.line is not None:
        click.echo(view.line)
    say_written(written)
