"""Many small draws, each under a state of its own: dashed or smooth lines, widgets, leaves, several views.

What a draw costs besides its pixels shows here. Where such draws cannot wait for each other (`pipeline.queue`), a
program takes ten times as long.
"""

from __future__ import annotations

from dataclasses import replace

from softshadow.bench.corpus.program import program
from softshadow.bench.corpus.small_draws import pictures, scenes

FAMILY = "small-draws"
PROGRAMS = tuple(
    replace(each, name=f"{FAMILY}/{each.name}")
    for each in map(
        program,
        (
            pictures.pencil_sketch,
            pictures.dashed_boxes,
            pictures.widgets,
            scenes.leaves,
            scenes.stars,
            scenes.four_views,
            scenes.depth_of_field,
            scenes.surface_plot,
            scenes.watched_cubes,
            pictures.sized_points,
            pictures.wall_of_bricks,
            pictures.curves,
            pictures.clock,
            scenes.snowmen,
        ),
    )
)
