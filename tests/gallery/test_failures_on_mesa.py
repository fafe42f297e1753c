"""A failure is one of the algorithm, not of this rasterizer: on Mesa's llvmpipe the same pixels are wrong."""

from typing import Any

import pytest

import softshadow as ss
from softshadow import techniques
from softshadow.gallery.calls import recorded
from softshadow.gallery.failure import Failure
from softshadow.techniques import Technique
from softshadow.testing import differences, run_here, run_on_mesa

SIZE = (80, 60)


def draw(gl: Any, failure: Failure) -> None:
    """Draw the failing program."""
    setting = failure.with_failure
    technique = setting.technique if isinstance(setting.technique, Technique) else techniques.get(setting.technique)
    scene = setting.make_scene() if setting.make_scene else failure.scene
    options = technique.validate_options(setting.options)
    for _ in recorded(technique, setting.altered_calls, []).steps(gl, scene, size=SIZE, **options):
        pass


@pytest.mark.thin(2)
@pytest.mark.mesa
@pytest.mark.filterwarnings("ignore::softshadow.errors.Warning")
@pytest.mark.parametrize("name", list(ss.failures))
def test_failing_program_leaves_the_same_bits_on_mesa(name: str) -> None:
    failure = ss.failures[name].at(SIZE)
    here = run_here(lambda gl: draw(gl, failure), SIZE)
    there = run_on_mesa(lambda gl: draw(gl, failure), SIZE)
    assert differences(here, there) == ()
