"""``softshadow slides``: a technique or a lesson as slides, in one file."""

from __future__ import annotations

from pathlib import Path

import click
from click.core import ParameterSource
from click.shell_completion import CompletionItem

from softshadow.cli.arguments import (
    SceneArguments,
    as_json,
    examples,
    force,
    open_file,
    output_option,
    scene_arguments,
    technique_options,
)
from softshadow.cli.console import print_json, say_written
from softshadow.cli.names import TechniqueName
from softshadow.cli.runs import _draw

LESSON = "lesson:"


class TechniqueOrLesson(TechniqueName):
    """The name of a technique, or lesson:NUMBER."""

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the name; whether the lesson exists is checked by the command."""
        return value if value.startswith(LESSON) else super().convert(value, param, ctx)

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """Return the techniques and lessons that begin so."""
        from softshadow.lessons.copies import lesson_files, title_of

        lessons = {f"{LESSON}{file.stem[:2]}": title_of(file) for file in lesson_files()}
        named = [CompletionItem(name, help=title) for name, title in lessons.items() if name.startswith(incomplete)]
        return [*super().shell_complete(ctx, param, incomplete), *named]


@click.command(
    epilog=examples(
        "softshadow slides volume-zfail --scene boxes",
        "softshadow slides planar -O method=stencil -o planar-slides.html",
        "softshadow slides lesson:05 -o stencil-slides.html",
    )
)
@click.argument("technique", type=TechniqueOrLesson(), metavar="TECHNIQUE|lesson:NUMBER")
@scene_arguments("320x240")
@technique_options
@output_option("The slides.", "FILE.html", default="slides.html", show_default=True)
@open_file
@force
@as_json
@click.pass_context
def slides(
    ctx: click.Context, technique: str, scene: SceneArguments, size: tuple[int, int], options: tuple[str, ...],
    output: str, opened: bool, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Make slides: one for each step of a technique, or of a lesson.

    The file needs no network. The arrow keys show the next slide; printed from a browser, each slide is a page.
    """
    from softshadow.inspection.files import refuse_foreign
    from softshadow.report.slide_deck import check_path
    from softshadow.report.slide_deck import slides as slides_of

    check_path(output)
    refuse_foreign(Path(output), force)
    if technique.startswith(LESSON):
        from softshadow.lessons.deck import lesson_slides

        sized = ctx.get_parameter_source("size") != ParameterSource.DEFAULT
        if sized or options or scene != SceneArguments():
            raise click.UsageError(f"{technique}: a lesson has its own scene, size and options")
        made = lesson_slides(technique.removeprefix(LESSON))
    else:
        made = slides_of(_draw(technique, size, options, scene))
    written = made.save(output, force)
    if as_json:
        print_json("slides", written=written, title=made.title, titles=[each.title for each in made.slides])
    say_written(written, opened=opened)
