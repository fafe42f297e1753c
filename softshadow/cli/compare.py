"""``softshadow compare``: two techniques on one scene, or any number of them beside the true shadow."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from softshadow.cli.arguments import (
    ChosenTechnique,
    SceneArguments,
    as_json,
    check_opened,
    chosen_techniques,
    examples,
    force,
    open_file,
    output_option,
    scene_arguments,
    technique_options,
)
from softshadow.cli.compare_output import check_output, off_band, print_comparison_json, print_tables, write
from softshadow.cli.console import CHECK_FAILED, print_warnings_once, say_if_compiling, say_marked, say_written
from softshadow.cli.names import TechniqueChoice, is_scene

if TYPE_CHECKING:
    from softshadow.inspection.soft_truth import SoftTruth
    from softshadow.scene import Scene
    from softshadow.soft import Convergence, LawResult, TechniqueError

SAMPLES = 16  # of each light, for techniques that sample lights


@click.command(
    epilog=examples(
        "softshadow compare volume-zfail map --scene torus -o difference.png",
        "softshadow compare map:map_size=256 map:map_size=1024 --truth hard",
        "softshadow compare volume-zfail --truth hard --scene boxes --max-wrong 0",
        "softshadow compare --all-soft --scene soft-slab --size 80x60",
    )
)
@click.argument("names", metavar="TECHNIQUE[:KEY=VALUE,...]...", type=TechniqueChoice(), nargs=-1)
@click.option("--truth", type=click.Choice(["hard", "soft"]), help="Compare with the true shadow.")
@scene_arguments("320x240")
@technique_options
@click.option(
    "--all-soft",
    is_flag=True,
    help="All techniques that draw soft edges, and two hard ones; truth soft; the only name may be a scene.",
)
@click.option("--samples", type=click.IntRange(1), help="Truth soft: points of each light.  [default: 16]")
@click.option(
    "--seconds", type=click.FloatRange(0, min_open=True), help="Truth soft: as many points as fit in this time."
)
@click.option("--slopes", is_flag=True, help="Truth soft: also fit how the error falls with the number of points.")
@click.option("--laws", is_flag=True, help="Truth soft: also measure the laws of the penumbra.")
@click.option(
    "--max-wrong", type=click.IntRange(0), metavar="N", help="Exit with 1 if more pixels are wrong off the band."
)
@click.option("--max-rms", type=click.FloatRange(0), metavar="X", help="Exit with 1 if the RMS error is larger.")
@output_option("Also write pictures of the errors (.png), a page (.html), or a folder/ with a plot of the slopes, too.")
@open_file
@force
@as_json
@click.pass_context
def compare(
    context: click.Context, names: tuple[str, ...], truth: str | None, scene: SceneArguments, size: tuple[int, int],
    options: tuple[str, ...], all_soft: bool, samples: int | None, seconds: float | None, slopes: bool, laws: bool,
    max_wrong: int | None, max_rms: float | None, output: str | None, opened: bool, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Compare techniques with each other, or with the true shadow.

    Without --truth, two techniques are compared, and the second is the reference. The truth "hard" is ray casting to
    the centre of each light. The truth "soft" is the part of each light that a pixel's point sees: an exact area where
    the blockers can be clipped, else the share of many rays.

    An error is a difference of visibilities, from 0 to 1; a pixel is wrong if it is off by more than 0.1. The band is
    the outline of the reference's shadows, a pixel wide: there, rays and fragments may decide differently.
    """
    from softshadow.soft import convergence, law_table, soft_candidates

    truth = "soft" if all_soft and truth is None else truth
    names, scene = _without_scene(names, scene, all_soft)
    _check_usage(names, truth, all_soft, (samples, seconds, slopes or None, laws or None), slopes, output)
    check_opened(opened, output)
    chosen = chosen_techniques(soft_candidates() if all_soft else names, options)
    if output:
        check_output(output, force)
    fitted: list[Convergence] = []
    measured: list[LawResult] = []
    with print_warnings_once():
        drawn = scene.load(default="soft-slab" if truth == "soft" else "torus")
        say_if_compiling()
        if truth == "soft":
            from softshadow.inspection import soft_truth

            reference = soft_truth(drawn, size)
            against = str(reference)
            shown = results = [
                _beside_soft_truth(drawn, reference, each, samples or SAMPLES, seconds) for each in chosen
            ]
            sampled = dict.fromkeys(each.technique for each in results if "samples" in each.options)
            fitted = [one for name in sampled for one in convergence(drawn, reference, name)] if slopes else []
            measured = law_table([each.name for each in chosen]) if laws else []
        else:
            against, results, shown = _beside_hard_truth_or_second(drawn, size, chosen, truth)
    exceeded = [text for each in results for text in _exceeded(each, max_wrong, max_rms)]
    title = f"{drawn.name}, against {against}"
    written = write(output, title, results, shown, fitted, force) if output else []
    if as_json:
        print_comparison_json(drawn.name, size, truth, against, results, fitted, measured, exceeded, written, output)
    else:
        print_tables(title, results, fitted, measured, timed=truth == "soft")
    say_written(*written, opened=opened)
    for text in exceeded:
        say_marked("error", text)
    if exceeded:
        context.exit(CHECK_FAILED)


def _without_scene(
    names: tuple[str, ...], scene: SceneArguments, all_soft: bool
) -> tuple[tuple[str, ...], SceneArguments]:
    """Return the names of techniques, and the scene: with --all-soft, the only name may be that of the scene."""
    scenes = [name for name in names if is_scene(name)]
    if all_soft and len(names) == len(scenes) == 1 and scene.name is None and scene.mesh is None:
        return (), replace(scene, name=scenes[0])
    if scenes:
        raise click.UsageError(f"{scenes[0]!r} is a scene; expected a technique here, and --scene {scenes[0]}")
    return names, scene


def _check_usage(
    names: Sequence[str], truth: str | None, all_soft: bool, soft_only: Sequence[Any], slopes: bool, output: str | None
) -> None:
    if all_soft and (names or truth != "soft"):
        raise click.UsageError("--all-soft: expected no name of a technique beside it, and no truth but soft")
    if truth is None and len(names) != 2:
        raise click.UsageError(f"expected two techniques, or --truth hard or soft; got {' '.join(names) or 'none'}")
    if not names and not all_soft:
        raise click.UsageError("expected names of techniques, or --all-soft")
    if truth != "soft" and any(each is not None for each in soft_only):
        raise click.UsageError("--samples, --seconds, --slopes and --laws: expected --truth soft beside them")
    if slopes and output is not None and Path(output).suffix.lower() in (".png", ".html"):
        raise click.UsageError(f"--output {output}: expected a folder/, which also holds the plot of --slopes")


# -- the comparisons ---------------------------------------------------------------------------------------------------
def _beside_soft_truth(
    scene: Scene, truth: SoftTruth, chosen: ChosenTechnique, samples: int, seconds: float | None
) -> TechniqueError:
    from softshadow import techniques
    from softshadow.soft import error_in_time, error_of

    if "samples" not in techniques.get(chosen.name).options or "samples" in chosen.options:
        return error_of(scene, truth, chosen.name, **chosen.options)
    if seconds is not None:
        return error_in_time(scene, truth, chosen.name, seconds, **chosen.options)
    return error_of(scene, truth, chosen.name, samples=samples, **chosen.options)


def _beside_hard_truth_or_second(
    scene: Scene, size: tuple[int, int], chosen: Sequence[ChosenTechnique], truth: str | None
) -> tuple[str, list[TechniqueError], list[TechniqueError]]:
    """Return the reference's name, the errors, and what pictures show: the same, or both of two techniques."""
    from softshadow.runs import run
    from softshadow.soft import TechniqueError

    runs = [run(each.name, scene, size, **each.options) for each in chosen]
    if truth == "hard":
        comparisons = [each.compare(truth="hard") for each in runs]
        against = comparisons[0].against
    else:
        comparisons, against = [runs[0].compare(runs[1])], chosen[1].label
    results = [
        TechniqueError(each.name, each.options, 0.0, comparison, drawn)
        for each, comparison, drawn in zip(chosen, comparisons, runs, strict=False)
    ]
    if truth is not None:
        return against, results, results
    second = TechniqueError(chosen[1].name, chosen[1].options, 0.0, runs[1].compare(runs[1]), runs[1])
    return against, results, [*results, second]


def _exceeded(result: TechniqueError, max_wrong: int | None, max_rms: float | None) -> list[str]:
    """Return a sentence for each bound that a technique exceeds."""
    wrong, rms = off_band(result.comparison).wrong, result.comparison.rms
    texts = []
    if max_wrong is not None and wrong > max_wrong:
        texts.append(f"{result.label}: {wrong} wrong pixels off the band; expected at most {max_wrong}")
    if max_rms is not None and rms > max_rms:
        texts.append(f"{result.label}: RMS error {rms:.6g}; expected at most {max_rms:g}")
    return texts
