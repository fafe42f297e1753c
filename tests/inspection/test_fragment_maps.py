"""Fragments of a step per pixel: in agreement with the ledger and with the histories."""

from collections import Counter

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import softshadow as ss
from inspection.recorded_frames import SIZE, random_frame
from softshadow.inspection import Replay, Step, ledger_of, pixel_history
from softshadow.inspection.fragment_maps import fragment_maps

pytestmark = pytest.mark.interpreted

COUNTED = ("passed", "alpha failed", "stencil failed", "depth failed")


def steps_of(frame):
    replay = Replay(frame)
    return [Step(index, title, {}, frame, replay) for index, (title, _) in enumerate(frame.steps)]


@settings(max_examples=10)
@given(st.integers(0, 2**32 - 1))
def test_totals_are_those_of_the_ledger(seed):
    frame = random_frame(seed).frame
    for step, counts in zip(steps_of(frame), ledger_of(frame).steps, strict=True):
        maps = fragment_maps(step)
        assert maps.totals == counts.fragments
        assert maps.drawn.sum() == counts.all_fragments


@settings(max_examples=5)
@given(st.integers(0, 2**32 - 1))
def test_counts_and_last_fragments_are_those_of_the_histories(seed):
    frame = random_frame(seed).frame
    maps = [fragment_maps(step) for step in steps_of(frame)]
    width, height = SIZE
    for x, y in [(x, y) for y in range(height) for x in range(width)][:: 1 + seed % 5]:
        rows = [row for row in pixel_history(frame, x, y) if row.triangle is not None]
        for number, of_step in enumerate(maps):
            mine = [
                row for row in rows if row.step == number and row.verdict in of_step.verdicts[:1] + of_step.verdicts[2:]
            ]
            counts = Counter(row.verdict for row in mine)
            assert counts == Counter({v: int(of_step.by_verdict[n, y, x]) for n, v in enumerate(of_step.verdicts)})
            last = None if not mine else (mine[-1].object, mine[-1].triangle, mine[-1].verdict)
            assert of_step.last_at(x, y) == last


@pytest.mark.parametrize("name", ["volume-zfail", "map", "map-cube", "volume-wedges", "shadow-polygons", "planar"])
def test_totals_of_all_framebuffers_of_a_run_are_those_of_the_ledger(name):
    small = {"map_size": 32} if name.startswith("map") else {}
    run = ss.run(name, "boxes", size=(48, 36), **small)
    for step, counts in zip(run, run.ledger.steps, strict=True):
        names = {draw.framebuffer for draw in step.draws} | {0}
        totals = [run.fragments(step.index, framebuffer).totals for framebuffer in names]
        assert {verdict: sum(total[verdict] for total in totals) for verdict in counts.fragments} == counts.fragments


def test_maps_have_the_picture_s_size_and_cannot_be_written():
    run = ss.run("volume-zfail", "boxes", size=(48, 36))
    maps = run.fragments("count back faces")
    assert maps.drawn.shape == maps.last_draw.shape == (36, 48)
    assert not maps.depth_failed.flags.writeable
    assert (maps.depth_failed > 0).any()
    assert repr(maps).startswith("FragmentMaps(48 x 36: ")
    assert np.array_equal(maps.last_verdict == -1, maps.drawn == 0)
    assert np.array_equal(maps.drawn, maps.passed + maps.alpha_failed + maps.stencil_failed + maps.depth_failed)
