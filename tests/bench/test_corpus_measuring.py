"""Measuring the corpus: both sides in processes of their own, buffers compared, means and tables."""

import json
from dataclasses import replace
from typing import Any

import pytest

from cli.invocation import invoke, invoke_ok
from paths import ROOT
from softshadow.bench.corpus.measuring import frames_in_a_round
from softshadow.bench.corpus.programs import PROGRAMS
from softshadow.bench.corpus.results import ProgramTimes, from_json, summary, to_json
from softshadow.bench.corpus.tables import machine_line, markdown, program_rows, summary_lines

TINY = ["--size", "32x24", "--rounds", "1"]


def times(name: str, ratio: float, **more: Any) -> ProgramTimes:
    """Return the times of a program that takes 10 ms on softshadow."""
    row = ProgramTimes(
        name, (640, 480), 1, 10 * ratio, 10.0, ratio, 50.0, 100.0, {"color": 0, "depth": 0, "stencil": 0}, 3, 100.0
    )
    return replace(row, **more)


def test_summary_is_the_geometric_mean_and_the_worst() -> None:
    whole = summary([times("turning-cubes", 4.0), times("wave-grid", 0.25), times("foggy-hills", 8.0)])
    assert whole.steady == pytest.approx(2.0)
    assert whole.first == pytest.approx(0.5)
    assert (whole.worst.name, whole.programs, whole.faster) == ("wave-grid", 3, 2)


def test_results_survive_json() -> None:
    rows = [times("turning-cubes", 4.0), times("turning-cubes", 3.0, threads=2, memory=None)]
    assert from_json({"schema": "softshadow/bench-corpus/1", **to_json(rows)}) == rows
    for contents in ({}, {"schema": "softshadow/bench-corpus/1"}):
        with pytest.raises(ValueError, match="bench-corpus"):
            from_json(contents)


def test_tables_tell_differing_pixels_and_the_second_thread() -> None:
    rows = [
        times("turning-cubes", 4.0, differing={"color": 7, "depth": 0}),
        times("turning-cubes", 4.0, threads=2, own=5.0),
    ]
    columns, cells = program_rows(rows)
    assert [row[columns.index("differing")] for row in cells] == ["color: 7", "0"]
    assert "2.00 times as fast" in summary_lines(rows)[-1]
    assert markdown(rows).splitlines()[-1].startswith("| `turning-cubes` | A ring of lit cubes")


def test_report_of_the_documentation_has_all_programs_and_equal_buffers() -> None:
    contents = json.loads((ROOT / "benchmarks" / "corpus.json").read_text(encoding="utf-8"))
    results = from_json(contents)
    assert {each.name for each in results} == set(PROGRAMS)
    assert all(each.equal for each in results)
    assert "Mesa" in summary_lines(results)[0]
    assert contents["machine"]["processor"] in machine_line(contents["machine"])


def test_a_round_has_at_least_one_frame() -> None:
    assert [frames_in_a_round([ms]) for ms in (1000.0, 50.0, 0.1)] == [1, 3, 40]


@pytest.mark.slow  # all programs, in two processes
@pytest.mark.mesa
def test_command_measures_both_sides_and_prints_json() -> None:
    answer = json.loads(invoke_ok("bench", "corpus/colored-cube", "--against", "mesa", *TINY, "--json").stdout)
    (result,) = from_json(answer)
    assert result.differing == {"color": 0, "depth": 0, "stencil": 0}
    assert min(result.mesa, result.own, result.mesa_first, result.own_first) > 0
    assert answer["summary"][0]["worst"] == "colored-cube"


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        (["corpus"], 2, "expected --against mesa"),
        (["corpus", "w5", "--against", "mesa"], 2, "expected corpus, corpus/PROGRAM"),
        (["features", "w5", "--against", "mesa"], 2, "features/FEATURE+FEATURE"),
        (["features/fog+scissor", "--against", "mesa"], 2, "unknown feature"),
        (["corpus/ches-board", "--against", "mesa"], 2, "did you mean 'chess-board'"),
        (["corpus", "--against", "mesa", "--starts"], 2, "--starts"),
    ],
)
def test_what_cannot_be_measured_is_said(words: list[str], code: int, said: str) -> None:
    answer = invoke("bench", *words)
    assert answer.exit_code == code
    assert said in answer.stderr
