"""``softshadow compare``: the errors of techniques on one scene, against ray casting or exact areas."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from softshadow.cli.arguments import as_json, examples, force, load_scene, scene_arguments
from softshadow.cli.console import print_json, print_warnings_once, say, say_if_compiling, table


@click.command(
    epilog=examples(
        "softshadow compare soft-slab --all-soft --size 160x120",
        "softshadow compare soft-torus volume-sampled map-sampled --samples 64 --size 160x120",
    )
)
@click.argument("names", metavar="[SCENE] [TECHNIQUE]...", nargs=-1)
@scene_arguments("320x240")
@click.option("--all-soft", is_flag=True, help="All techniques that draw soft edges, and two hard ones.")
@click.option("--samples", type=click.IntRange(1), default=16, show_default=True, help="Points of each light.")
@click.option("--seconds", type=click.FloatRange(0, min_open=True), help="As many points as fit in this time instead.")
@click.option("--slopes", is_flag=True, help="Also fit how the error falls with the number of points.")
@click.option("--laws", is_flag=True, help="Also measure the laws of the penumbra.")
@click.option(
    "-o",
    "--output",
    metavar="FOLDER/",
    help="Also write pictures of the errors, and a plot of the slopes.",
)
@force
@as_json
def compare(
    names: tuple[str, ...], scene: str | None, mesh: str | None, light: tuple[float, ...] | None,
    size: tuple[int, int], all_soft: bool, samples: int, seconds: float | None, slopes: bool, laws: bool,
    output: str | None, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Compare techniques with the soft shadows of the scene's lights.

    The reference is the part of each light that a pixel's point sees: an exact area where the blockers can be clipped,
    else the share of many rays. The table splits the error by umbra, penumbra and lit.
    """
    from softshadow import techniques
    from softshadow.inspection.files import write_whole
    from softshadow.inspection.pictures import save_png
    from softshadow.inspection.soft_truth import soft_truth
    from softshadow.soft import (
        compare_techniques,
        contact_sheet_of,
        convergence,
        law_table,
        save_convergence_plot,
        soft_candidates,
    )

    scene, names = _scene_of(scene, names)
    if all_soft == bool(names):
        raise click.UsageError("expected names of techniques, or --all-soft")
    chosen = soft_candidates() if all_soft else names
    for name in chosen:
        techniques.get(name)  # before the truth is computed, which may take a while
    folder = None if output is None else Path(output)
    with print_warnings_once():
        drawn = load_scene(scene, mesh, light, default="soft-slab")
        if folder is not None:
            folder.mkdir(parents=True, exist_ok=True)
        say_if_compiling()
        truth = soft_truth(drawn, size)
        results = compare_techniques(drawn, truth, chosen, samples=samples, seconds=seconds)
        sampled = [each.technique for each in results if "samples" in each.options]
        fitted = [one for name in sampled for one in convergence(drawn, truth, name)] if slopes else []
        measured = law_table(chosen) if laws else []
    written = []
    if folder is not None:
        sheet = contact_sheet_of(results)
        written.append(write_whole(folder / "errors.png", lambda path: save_png(sheet, path), force))
        if fitted:
            written.append(write_whole(folder / "slopes.svg", lambda path: save_convergence_plot(fitted, path), force))
    if as_json:
        print_json(
            "compare", scene=drawn.name, size=size, truth=str(truth), written=written,
            techniques=[_facts(each) for each in results],
            slopes=[{"technique": each.technique, "pattern": each.pattern, "slope": each.slope} for each in fitted],
            laws=[
                {"technique": each.technique, "law": each.law.name, "before": each.before, "after": each.after,
                 "expected_before": each.law.before.penumbra, "expected_after": each.law.after.penumbra,
                 "holds": each.holds}
                for each in measured
            ],
        )  # fmt: skip
        return
    columns = ["technique", "s", "RMS", "max", "RMS umbra", "RMS penumbra", "RMS lit", "off by > 0.1"]
    table(f"{drawn.name}, against {truth}", columns, [_row(each) for each in results])
    if fitted:
        rows = [[each.technique, each.pattern, f"{each.slope:.2f}"] for each in fitted]
        table("RMS error falls like samples to the power of", ["technique", "points", "slope"], rows)
    if measured:
        rows = [
            [each.technique, each.law.name, f"{each.before:.2f} -> {each.after:.2f}",
             f"{each.law.before.penumbra:.2f} -> {each.law.after.penumbra:.2f}",
             "holds" if each.holds else "direction only" if each.direction_holds else "no"]
            for each in measured
        ]  # fmt: skip
        table("laws of the penumbra: its width", ["technique", "law", "measured", "by the law", ""], rows)
    for path in written:
        say(f"written: {path}")


def _scene_of(scene: str | None, names: tuple[str, ...]) -> tuple[str | None, tuple[str, ...]]:
    """Return the scene, which may be the first name, and the names of techniques."""
    from softshadow import techniques

    if scene is None and names and names[0] not in techniques.names():
        return names[0], names[1:]
    return scene, names


def _facts(result: Any) -> dict[str, Any]:
    parts = {
        name: {"pixels": part.pixels, "rms": part.rms, "max": part.max, "wrong": part.wrong}
        for name, part in result.comparison.parts.items()
    }
    return {"technique": result.technique, "options": result.options, "seconds": result.seconds, "parts": parts}


def _row(result: Any) -> list[str]:
    parts = result.comparison.parts
    return [
        result.label, f"{result.seconds:.3f}", f"{parts['all'].rms:.4f}", f"{parts['all'].max:.3f}",
        *(f"{parts[name].rms:.4f}" for name in ("umbra", "penumbra", "lit")), str(parts["all"].wrong),
    ]  # fmt: skip
