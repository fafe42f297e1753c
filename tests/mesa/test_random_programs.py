"""Random GL programs leave the same colour, depth and stencil bits here and on Mesa.

A failing program is shrunk and printed as code that can be pasted into a test. ``SOFTSHADOW_PROGRAMS=500`` runs the
first 500 seeds of every family, ``SOFTSHADOW_PROGRAMS=300:500`` the 200 from 300 on.
"""

import os

import pytest

from mesa.gl_calls import Call, as_code, as_program, shrink
from mesa.random_programs import FAMILIES, random_program
from softshadow.testing import EXPECTED_VERSION, MesaError, compare, mesa_version, run_on_mesa

pytestmark = pytest.mark.mesa

SHORT_LANE = "12"  # programs of each family
LONG_LANE = "1000"


def seeds(lane: str) -> range:
    """Return the seeds to run, as the environment or the lane says."""
    start, _, stop = os.environ.get("SOFTSHADOW_PROGRAMS", lane).rpartition(":")
    return range(int(start or 0), int(stop))


def disagreement(calls: list[Call], size: tuple[int, int]) -> tuple[str, ...]:
    """Return what differs: names of buffers, or the exception that only one side raises; () where nothing does."""
    program = as_program(calls)
    try:
        run_on_mesa(program, size)
    except MesaError:
        return ()  # a shrunk program may be none: glVertex4f outside glBegin
    try:
        return tuple(found.buffer for found in compare(program, size).differences)
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
    differing = {}
    for seed in seeds(lane):
        calls, size = random_program(family, seed)
        found = disagreement(calls, size)
        if found:
            differing[seed] = found
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
        for seed in range(3):
            calls, size = random_program(family, seed)
            assert run_on_mesa(as_program(calls), size).errors == ()
