"""What shows the errors of the slides gives these numbers, here and on Mesa."""

import pytest

from softshadow import course, demonstrations, gl
from softshadow.demonstrations import PROGRAMS, Measured, measure, measure_one
from softshadow.demonstrations.demonstration import WINDOW
from softshadow.demonstrations.page import entry
from softshadow.testing import differences, run_here, run_on_mesa

# by the slide, and as it is
NUMBERS = {
    "names-of-gl": (0, 1),
    "culled-faces": (0, 4096),
    "steps-of-a-unit": (10, 19),
    "replaced-value": (1, 7),
    "reference-is-written": (0, 4096),
    "stencil-bits": (1, 8),
    "stencil-before-depth": (3, 3),
    "stencil-write-mask": (0, 255),
    "function-without-test": (4096, 0),
    "negative-differences": (0, 78),
    "silhouette-loops": (1, 2),
    "volume-draws": (1, 2),
    "missing-penumbra": (0, 511),
    "start-values": (0, 1),
    "mask-of-always": (1460, 1460),
    "count-or-difference": (2037, 0),
    "second-frame": (1460, 0),
    "vertices-on-the-plane": (12, 48),
    "unclamped-light": (519, 0),
    "sign-of-w": (1579, 1579),
    "two-masks": (4376, 4376),
    "kept-shadow": (1778, 0),
    "colour-of-the-shadow": (1563, 0),
    "model-matrix": (723, 0),
    "distance-of-equal-depths": (13628, 0),
    "wedge-planes": (996, 0),
    "moved-vertex": (103, 0),
    "penumbra-width": (500, 334),
}
QUICK = ("names-of-gl", "culled-faces", "replaced-value", "stencil-write-mask", "function-without-test", "start-values")
programs = [pytest.param(name, marks=() if name in QUICK else pytest.mark.slow) for name in NUMBERS]


def test_every_program_is_counted() -> None:
    assert set(NUMBERS) == set(PROGRAMS)


@pytest.mark.parametrize("name", programs)
def test_program_gives_these_numbers(name: str) -> None:
    with gl.create_context(*WINDOW):
        assert tuple(PROGRAMS[name].program(gl)) == NUMBERS[name]


@pytest.mark.slow
@pytest.mark.mesa
@pytest.mark.parametrize("name", [name for name, each in PROGRAMS.items() if each.on_mesa])
def test_program_leaves_the_same_bits_and_numbers_on_mesa(name: str) -> None:
    program = PROGRAMS[name].program
    assert differences(run_here(program, WINDOW), run_on_mesa(program, WINDOW)) == ()


def shows(erratum: course.Erratum, measured: Measured) -> bool:
    """Whether the numbers show that the slide is wrong, or, where it is not, that it is right."""
    if measured.kind == "source":
        return True
    if measured.kind == "listing":
        return sum(measured.numbers) > 0 or (erratum.number, measured.name) == ("E38", "volume-five-passes-eye")
    before, after = measured.numbers
    if measured.kind == "failure":
        return before > after
    return (before == after) == erratum.stands


@pytest.mark.slow
@pytest.mark.parametrize("number", list(course.ERRATA))
def test_what_shows_an_error_shows_it_and_the_page_has_its_numbers(number: str) -> None:
    erratum = course.get(number)
    text = entry(erratum)
    assert text.startswith(f"**{number}: {erratum.title}** ({erratum.place})")
    assert all(part in text for part in (erratum.says, erratum.wrong, erratum.right))
    for measured in measure(number):
        assert shows(erratum, measured), str(measured)
        assert str(measured) in text


def test_an_error_is_measured_and_an_unknown_demonstration_refused() -> None:
    (measured,) = measure("E64")
    assert shows(course.get("E64"), measured)
    assert str(measured) == "default of the stencil write mask, 8 bits: 0 → 255"
    assert str(measured) in entry(course.get("E64"))
    with pytest.raises(ValueError, match="demonstration 'program:stencil-bit': did you mean 'stencil-bits'"):
        measure_one("E57", "program:stencil-bit")
    assert demonstrations.__all__
