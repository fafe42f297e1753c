"""Random GL programs leave the same colour, depth and stencil bits here and on Mesa.

A failing program is shrunk and printed as code that can be pasted into a test. ``SOFTSHADOW_PROGRAMS=500`` runs the
first 500 seeds of every family, ``SOFTSHADOW_PROGRAMS=300:500`` the 200 from 300 on. With ``-n 0 -s`` each family
prints a line with the numbers of programs, of those that differ, and of those with a known difference.
"""

import os

import pytest

from mesa.gl_calls import Call, as_code, as_program, shrink
from mesa.known_differences import explanation
from mesa.random_programs import FAMILIES, random_program
from softshadow.testing import EXPECTED_VERSION, compare, differences, mesa_version, run_here, run_on_mesa

pytestmark = pytest.mark.mesa

SHORT_LANE = "6"  # programs of each of the 42 families: 252 in all
LONG_LANE = "136"  # 5,712 in all


def seeds(lane: str) -> range:
    """Return the seeds to run, as the environment or the lane says."""
    start, _, stop = os.environ.get("SOFTSHADOW_PROGRAMS", lane).rpartition(":")
    return range(int(start or 0), int(stop))


def disagreement(calls: list[Call], size: tuple[int, int]) -> tuple[str, ...]:
    """Return what differs: names of buffers, or the exception that only one side raises; () where nothing does."""
    program = as_program(calls)
    try:
        theirs = run_on_mesa(program, size)
    except Exception:
        return ()  # a shrunk program may be none: a glBegin without its glEnd
    try:
        return tuple(found.buffer for found in differences(run_here(program, size), theirs))
    except Exception as error:
        return (type(error).__name__,)


def describe(calls: list[Call], size: tuple[int, int]) -> str:
    """Return the differences of a program as text."""
    try:
        return str(compare(as_program(calls), size))
    except Exception as error:
        return f"{type(error).__name__}: {error}"


def check(family: str, lane: str) -> None:
    """Run the programs of a family; fail with the shortest form of the first one that differs."""
    differing, known = {}, 0
    for seed in seeds(lane):
        calls, size = random_program(family, seed)
        found = disagreement(calls, size)
        if explanation(calls, found) if found else "":
            known += 1
        elif found:
            differing[seed] = found
    print(f"{family}: {len(seeds(lane))} programs, {len(differing)} differ, {known} with a known difference")
    if not differing:
        return
    seed, found = next(iter(differing.items()))
    calls, size = random_program(family, seed)
    calls = shrink(calls, lambda candidate: found[0] in disagreement(candidate, size))
    summary = ", ".join(f"{one} ({' '.join(what)})" for one, what in list(differing.items())[:20])
    report = (
        f"{len(differing)} of {len(seeds(lane))} programs differ: seeds {summary}\n"
        f"{family} {seed}, size {size}:\n{as_code(calls)}{describe(calls, size)}"
    )
    if mesa_version() != EXPECTED_VERSION:
        pytest.skip(f"Mesa {mesa_version()} instead of {EXPECTED_VERSION}: {report}")
    pytest.fail(report, pytrace=False)


@pytest.mark.parametrize("family", FAMILIES)
def test_random_programs_leave_the_same_bits(family):
    check(family, SHORT_LANE)


@pytest.mark.slow
@pytest.mark.parametrize("family", FAMILIES)
def test_thousands_of_random_programs_leave_the_same_bits(family):
    check(family, LONG_LANE)


def test_every_random_program_is_one_without_gl_errors():
    for family in FAMILIES:
        for seed in range(2):
            calls, size = random_program(family, seed)
            assert run_on_mesa(as_program(calls), size).errors == ()
