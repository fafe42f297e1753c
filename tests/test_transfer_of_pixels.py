"""Pixel transfer in formulas that a reader can check: scale, bias, maps, shift and offset (GL 2.1, sec. 3.6.3)."""

import numpy as np
import pytest

from softshadow import tokens as gl
from softshadow.frozen import evolve
from softshadow.mapped_memory import MappedMemory
from softshadow.pixel_transfer import PixelTransfer

INITIAL = PixelTransfer()


def test_the_initial_state_changes_nothing():
    rgba = np.random.default_rng(1).uniform(-1, 2, (3, 4, 4)).astype(np.float32)
    np.testing.assert_array_equal(INITIAL.color(rgba), rgba)
    assert (INITIAL.changes_color, INITIAL.changes_depth, INITIAL.changes_stencil) == (False, False, False)
    assert INITIAL.uploaded_stencil(np.array([0, 255, 256])).tolist() == [0, 255, 0]


def test_scale_and_bias_belong_to_a_channel():
    transfer = evolve(INITIAL, scales=((2.0, 0.5), (1.0, 0.0), (1.0, -1.0), (0.0, 0.25)))
    colored = transfer.color(np.array([[[1, 1, 1, 1]]], np.float32))
    assert colored.tolist() == [[[2.5, 1.0, 0.0, 0.25]]]


def test_a_map_gives_its_nearest_entry():
    maps = {**INITIAL.maps, gl.GL_PIXEL_MAP_R_TO_R: np.array([0.1, 0.2, 0.3], np.float32)}
    transfer = evolve(INITIAL, map_color=True, maps=maps)
    red = np.array([-1, 0.24, 0.26, 0.74, 0.76, 7], np.float32)
    looked_up = transfer.color(np.stack([red] * 4, axis=-1)[np.newaxis])[0]
    assert looked_up[:, 0].tolist() == np.array([0.1, 0.1, 0.2, 0.2, 0.3, 0.3], np.float32).tolist()
    assert not looked_up[:, 1:].any()  # the other maps have one entry, 0


@pytest.mark.parametrize(
    ("shift", "offset", "expected"), [(1, 0, 6), (-1, 0, 1), (0, -3, 0), (2, -1, 11), (0, -4, 255)]
)
def test_indices_are_shifted_then_moved(shift, offset, expected):
    transfer = evolve(INITIAL, index_shift=shift, index_offset=offset)
    assert transfer.uploaded_stencil(np.array([3])).tolist() == [expected]
    assert transfer.read_stencil(np.array([3], np.uint8)).tolist() == [expected]


def test_depths_are_clamped_after_scale_and_bias():
    transfer = evolve(INITIAL, depth=(2.0, -0.5))
    assert transfer.scaled_depth(np.array([0, 0.5, 1], np.float32)).tolist() == [0.0, 0.5, 1.0]


def test_mapped_memory_is_an_address_and_an_array():
    memory = MappedMemory.of(np.arange(8, dtype=np.uint8))
    memory[2:4] = 9
    assert (int(memory), len(memory)) == (memory.array.ctypes.data, 8)
    assert memory.view(np.uint16)[1] == 0x0909
