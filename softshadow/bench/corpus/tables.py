"""Tables of the corpus: (columns, rows) for the terminal, Markdown for the documentation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from statistics import geometric_mean
from typing import Any

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
    """Return the table of a page, the lowest ratio first: times with the fewest threads, ratios with all numbers."""
    groups = {number: {each.name: each for each in group} for number, group in by_threads(results).items()}
    fewest = groups[min(groups)]
    columns = ["program", "what it draws", "Mesa, ms", "softshadow, ms", *map(_ratio_column, groups), "first frame"]
    lines = ["| " + " | ".join(columns) + " |", "|---|---|" + "---:|" * (len(columns) - 2)]
    for name, times in sorted(fewest.items(), key=lambda item: item[1].ratio):
        title = PROGRAMS[name].title if name in PROGRAMS else ""
        ratios = [f"{group[name].ratio:.2f}" if name in group else "" for group in groups.values()]
        cells = [f"`{name}`", title, f"{times.mesa:.2f}", f"{times.own:.2f}", *ratios, f"{times.first_ratio:.2f}"]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def _ratio_column(threads: int) -> str:
    return "ratio" if threads == 1 else f"{threads} threads"


def machine_line(machine: Mapping[str, Any]) -> str:
    """Return processor, system and versions of a report in one line."""
    versions = ", ".join(f"{name} {machine[name]}" for name in ("python", "numpy", "numba", "mesa") if name in machine)
    return f"{machine['cores']} cores of {machine['processor']} ({machine['system']}; {versions})"
