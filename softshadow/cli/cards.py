"""``softshadow cards``: pixels to count by hand, with the answers on the back."""

from __future__ import annotations

import click

from softshadow.cli.arguments import SceneArguments, as_json, examples, force, scene_arguments, technique_options
from softshadow.cli.console import print_json, say_written
from softshadow.cli.names import TechniqueName
from softshadow.cli.runs import _about, _draw


@click.command(
    epilog=examples(
        "softshadow cards volume-zfail --scene boxes -n 3", "softshadow cards volume-zpass --seed 7 -n 1 -o cards.png"
    )
)
@click.argument("technique", type=TechniqueName())
@scene_arguments("320x240")
@technique_options
@click.option("-n", "--number", type=click.IntRange(1), default=6, show_default=True, help="How many cards.")
@click.option("--seed", type=int, default=0, show_default=True, help="The same seed chooses the same pixels.")
@click.option("-o", "--output", metavar="FILE", default="cards.pdf", show_default=True, help="A .pdf or .png file.")
@force
@as_json
def cards(
    technique: str, size: tuple[int, int], options: tuple[str, ...], number: int, seed: int, output: str, force: bool,
    as_json: bool, scene: SceneArguments,
) -> None:  # fmt: skip
    """Make cards on which students count the faces along a line of sight.

    A card shows a pixel in the picture and the cross-section through it, with the crossed faces numbered. The answers
    are on the back: print the PDF on both sides, turned over the long edge. It needs matplotlib.
    """
    from softshadow.report import counting_cards

    run = _draw(technique, size, options, scene)
    made = counting_cards(run, number, seed)
    written = made.save(output, force)
    if as_json:
        answers = [
            {"x": card.x, "y": card.y, "counts": [each.count for each in card.line.crossings], "stencil": card.line.end}
            for card in made.cards
        ]
        print_json("cards", written=written, cards=answers, **_about(run))
    else:
        say_written(written)
