"""Tables of the corpus: (columns, rows) for the terminal, Markdown for the documentation."""

from __future__ import annotations

from collections.abc import Sequence
from statistics import geometric_mean

from softshadow.bench.corpus.programs import PROGRAMS
from softshadow.bench.corpus.results import ProgramTimes, by_threads, summary

LONG = 5.0  # milliseconds; shorter frames are not worth a second thread


def program_rows(results: Sequence[ProgramTimes]) -> tuple[list[str], list[list[str]]]:
    """Return a row for each program and number of threads."""
    columns = [
        "program", "size", "threads", "Mesa ms", "softshadow ms", "ratio", "first: Mesa", "softshadow", "ratio",
        "differing", "with FMA", "MB",
    ]  # fmt: skip
    return columns, [
        [
            each.name,
            f"{each.size[0]}x{each.size[1]}",
            str(each.threads),
            f"{each.mesa:.2f}",
            f"{each.own:.2f}",
            f"{each.ratio:.2f}",
            f"{each.mesa_first:.0f}",
            f"{each.own_first:.0f}",
            f"{each.first_ratio:.2f}",
            ", ".join(f"{buffer}: {count}" for buffer, count in each.differing.items() if count) or "0",
            str(each.differing_fused),
            "-" if each.memory is None else f"{each.memory:.0f}",
        ]
        for each in results
    ]


def summary_lines(results: Sequence[ProgramTimes]) -> list[str]:
    """Return the means and the worst in sentences, for each number of threads; then what a second thread gains."""
    groups = by_threads(results)
    lines = []
    for each in map(summary, groups.values()):
        threads = "1 thread" if each.threads == 1 else f"{each.threads} threads"
        lines.append(
            f"{threads}: steady frames run at {each.steady:.2f} times Mesa's speed (geometric mean of {each.programs} "
            f"programs), first frames at {each.first:.2f}; slowest {each.worst.name} at {each.worst.ratio:.2f}; "
            f"{each.faster} of {each.programs} are at least as fast as on Mesa"
        )
    if 1 in groups and 2 in groups:
        two = {each.name: each.own for each in groups[2]}
        gains = [each.own / two[each.name] for each in groups[1] if each.own > LONG and each.name in two]
        if gains:
            lines.append(
                f"the second thread makes the {len(gains)} programs with more than {LONG:g} ms a frame "
                f"{geometric_mean(gains):.2f} times as fast"
            )
    return lines


def markdown(results: Sequence[ProgramTimes]) -> str:
    """Return the table of a page: slowest first, with what each program draws."""
    groups = by_threads(results)
    columns = ["program", "what it draws", "Mesa ms", "softshadow ms", *(f"x ({n})" for n in groups), "first x"]
    lines = ["| " + " | ".join(columns) + " |", "|---|---|" + "---:|" * (len(columns) - 2)]
    first = min(groups)
    others = {number: {each.name: each for each in group} for number, group in groups.items()}
    for each in sorted(groups[first], key=lambda each: each.ratio):
        ratios = [f"{others[number][each.name].ratio:.2f}" for number in groups]
        title = PROGRAMS[each.name].title if each.name in PROGRAMS else ""
        cells = [f"`{each.name}`", title, f"{each.mesa:.2f}", f"{each.own:.2f}", *ratios, f"{each.first_ratio:.2f}"]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)
