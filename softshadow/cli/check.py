"""``softshadow check``: students' programs beside the buffers that an exercise expects."""

from __future__ import annotations

import csv
import sys
from contextlib import redirect_stdout
from typing import TYPE_CHECKING

import click

from softshadow.cli.arguments import as_json, examples
from softshadow.cli.console import CHECK_FAILED, print_json, print_warnings_once, say, say_if_compiling, show, table
from softshadow.cli.names import complete_files

if TYPE_CHECKING:
    from softshadow.checking import Exercise, Grade

LIMITS = {"seconds": "--time", "megabytes": "--memory"}  # Python arguments, and the options they correspond to


@click.command(
    epilog=examples(
        "softshadow check --list",
        "softshadow check lesson:05",
        "softshadow check exercise.py student.py",
    )
)
@click.argument("exercise", metavar="[EXERCISE]", required=False, shell_complete=complete_files)
@click.argument("submissions", metavar="[FILE.py]...", nargs=-1, shell_complete=complete_files)
@click.option("--list", "lists", is_flag=True, help="List the exercises of the lessons.")
@click.option("--time", "seconds", type=float, default=60, show_default=True, help="Seconds that a program may run.")
@click.option(
    "--memory", "megabytes", type=int, default=2048, show_default=True,
    help="MB that a program may use. Only on Linux.",
)  # fmt: skip
@click.option("--csv", "as_csv", is_flag=True, help="Print a row for each file, comma-separated.")
@as_json
@click.pass_context
def check(
    context: click.Context, exercise: str | None, submissions: tuple[str, ...], lists: bool, seconds: float,
    megabytes: int, as_csv: bool, as_json: bool,
) -> None:  # fmt: skip
    """Check whether students' programs leave the buffers that an exercise expects.

    EXERCISE is a teacher's file or lesson:NAME. Without a FILE.py its task is printed, and the code to begin with; but
    a file that has the line exercise = "lesson:05", or both program(gl) and expected(gl), is checked by itself. The
    exit code is 1 if a check fails. Each program runs in its own process with a time and a memory limit. This is no
    sandbox: run programs that you do not trust in a container.
    """
    if as_csv and as_json:
        raise click.UsageError("--csv and --json: expected only one of them")
    if lists:
        _list(as_json)
        return
    if exercise is None:
        raise click.UsageError("expected an EXERCISE, or --list")
    from softshadow.checking import Grader, Limits, exercise_for, load_exercise

    try:
        limits = Limits(seconds, megabytes)
    except ValueError as error:
        argument, _, rest = str(error).partition("=")
        raise click.UsageError(f"{LIMITS[argument]}={rest}") from None
    if not submissions and (named := exercise_for(exercise)):
        exercise, submissions = named, (exercise,)
    with redirect_stdout(sys.stderr):  # what an exercise prints is no part of the result
        loaded = load_exercise(exercise)
    if not submissions:
        _describe(loaded, as_json)
        return
    grades: list[Grade] = []
    with print_warnings_once():
        say_if_compiling()
        with redirect_stdout(sys.stderr):
            grader = Grader(loaded, limits)
        for number, file in enumerate(submissions):
            if len(submissions) > 1:
                say(f"{number + 1} of {len(submissions)}: {file}")
            grades.append(grader.grade(file))
    if as_json:
        rows = [grade.to_dict() for grade in grades]
        print_json("check", exercise=loaded.source, title=loaded.title, points=loaded.points, submissions=rows)
    elif as_csv:
        _print_csv(grades)
    elif len(grades) == 1:
        _print(loaded, grades[0])
    else:
        titles = [each.title for each in loaded.checks]
        rows_of = [[grade.submission, f"{grade.points:g}", *(v.kind for v in grade.verdicts)] for grade in grades]
        table(f"{loaded.title}, {loaded.points:g} points", ["file", "points", *titles], rows_of)
    if not all(grade.passed for grade in grades):
        context.exit(CHECK_FAILED)


def _list(as_json: bool) -> None:
    from softshadow.checking.lesson_exercises import LESSON
    from softshadow.lessons.copies import lesson_files, title_of

    rows = [{"name": f"{LESSON}{file.stem}", "title": title_of(file)} for file in lesson_files()]
    if as_json:
        print_json("check", exercises=rows)
    else:
        table("Exercises of the lessons", ["name", "title"], [list(each.values()) for each in rows])
        say("softshadow check NAME prints a task; lesson:05 is enough")


def _describe(exercise: Exercise, as_json: bool) -> None:
    """Print the task of an exercise as comments, and the code to begin with: a file that a student can go on with."""
    if as_json:
        checks = [{"title": each.title, "program": each.program, "points": each.points} for each in exercise.checks]
        print_json(
            "check", exercise=exercise.source, title=exercise.title, task=exercise.task, size=exercise.size,
            start=exercise.start, points=exercise.points, checks=checks,
        )  # fmt: skip
        return
    lines = [exercise.title, "", *exercise.task.splitlines()]
    click.echo("\n".join(f"# {line}".rstrip() for line in lines))
    if exercise.start:
        click.echo(f"\n{exercise.start.rstrip()}")


def _print(exercise: Exercise, grade: Grade) -> None:
    shown: set[str] = set()
    for test, verdict in zip(grade.checks, grade.verdicts, strict=True):
        points = test.points if verdict.passed else 0
        click.echo(f"{test.title}: {verdict.kind} ({points:g} of {test.points:g} points)")
        if (text := str(verdict)) not in shown:  # an error ends all checks of its function
            show(text)
        shown.add(text)
        if test.hint and not verdict.passed:
            show(f"Hint: {test.hint}")
        click.echo()
    click.echo(f"{grade.submission}: {grade.points:g} of {exercise.points:g} points")


def _print_csv(grades: list[Grade]) -> None:
    rows = csv.writer(sys.stdout, lineterminator="\n")
    rows.writerow(["file", "points", "passed", *(each.title for each in grades[0].checks)])
    for grade in grades:
        kinds = [each.kind for each in grade.verdicts]
        rows.writerow([grade.submission, f"{grade.points:g}", str(grade.passed).lower(), *kinds])
