"""Stippled and smooth fragments and point sprites leave the bits of the textbook when they are drawn forward."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from draws import same_window
from fixed_function_pictures import random_picture
from softshadow.pipeline import choose, explain_paths, set_threads, threads, use_short_cuts
from softshadow.pipeline.fast import forward


@pytest.fixture(autouse=True)
def _compiled(monkeypatch):
    monkeypatch.setattr(choose.SPAN_KERNELS, "pays_after", 0)


def assert_same(seed, **options):
    with explain_paths() as paths:
        window = random_picture(seed, special=True, **options)
    with use_short_cuts(False):
        assert same_window(window, random_picture(seed, special=True, **options)), seed
    return {path.fill for path in paths}


@given(st.integers(0, 2**32 - 1), st.booleans(), st.booleans())
def test_special_fragments_leave_the_bits_of_the_textbook(seed, ordered, tested):
    assert_same(seed, ordered=ordered, tested=tested)


@given(st.integers(0, 2**32 - 1), st.booleans())
def test_bands_of_rows_share_special_fragments(seed, ordered):
    before, worth = threads(), forward.WORTH_BANDS
    try:
        set_threads(2)
        forward.WORTH_BANDS = 0
        assert_same(seed, size=(30, 150), ordered=ordered)
    finally:
        set_threads(before)
        forward.WORTH_BANDS = worth


def test_special_fragments_are_drawn_forward():
    fills = [assert_same(seed, ordered=True, units=seed % 3) for seed in range(12)]
    assert sum("span by span" in fill for fill in fills) > 8
    assert "span by span" not in assert_same(1, ordered=True, precision="exact")


@pytest.mark.interpreted
def test_the_interpreted_kernels_leave_the_bits_of_the_textbook():
    for seed in range(8):
        assert_same(seed, size=(12, 9), n_triangles=4, tested=seed % 2 == 1)
