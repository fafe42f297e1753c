"""Depth and stencil test of one row of a triangle; equals `raster.ordered.process_fragments`, see fast/test_forward.py.

`test_span` does both tests under any state, over any number of fragments. The others do the usual ones in one loop over
whole portions of a row, which is a vector also where the row is short.
"""

from __future__ import annotations

import numpy as np

from softshadow.jit import copied_kernel, kernel
from softshadow.pipeline.fast.fragment_block import DEPTH, MASK, W, whole_portions
from softshadow.pipeline.fast.fragment_numbers import (
    DEPTH_WRITE,
    LARGEST,
    READ,
    REF,
    SFAIL,
    WRITE,
    ZFAIL,
    ZPASS,
    depth_of,
    depth_passes,
    depth_test_of,
    stencil_passes,
    stencil_test_of,
    stencil_update_of,
    updated,
)


@copied_kernel
def test_depths(numbers, largest, f, planes, t, depth_range, j, left, length, depth, at, is_masked, whole):
    """Do what `test_span` does for fragments that are tested for depth only, in one loop over whole portions.

    A loop of any length over a few fragments takes them one by one. So the buffer must have as many columns from `left`
    on as `whole_portions` says. If `is_masked`, fragments whose MASK is not set fail.
    """
    first, mask, count, depth_test = np.uint64(left), MASK + at, np.int32(length), depth_test_of(numbers, f)
    z0, dz, dz_row, offset = planes[t, 0], planes[t, 1], planes[t, 2], planes[t, 3]
    row_at, start_at = np.float32(np.int32(j)), np.float32(np.int32(left))
    writes, unmasked = np.int32(-1 if numbers[f, DEPTH_WRITE] else 0), np.int32(0 if is_masked else -1)
    every, some = np.int32(-1), np.int32(0)
    for n in range(whole_portions(length)):
        place = np.int32(n)
        z = depth_of(z0, dz, dz_row, offset, start_at + np.float32(place), row_at, depth_range, largest)
        inside, stored, before = np.int32(-1 if place < count else 0), depth[j, first + n], whole[mask + n]
        passes = np.int32(depth_passes(depth_test, z, stored) & np.int32(inside & np.int32(before | unmasked)))
        outside = np.int32(~inside)
        whole[mask + n] = np.int32(passes | np.int32(before & outside))
        every, some = np.int32(every & np.int32(passes | outside)), np.int32(some | passes)
        depth[j, first + n] = z if np.int32(passes & writes) else stored
    return every != 0, some != 0


@copied_kernel
def test_stencil(numbers, f, j, left, length, stencil, whole):
    """Write MASK: which fragments pass a stencil test that changes no value; return whether all and whether some do.

    In one loop over whole portions, as `test_depths`.
    """
    test, ref, read = stencil_test_of(numbers, f), numbers[f, REF], numbers[f, READ]
    first, count, every, some = np.uint64(left), np.int32(length), np.int32(-1), np.int32(0)
    for n in range(whole_portions(length)):
        inside = np.int32(-1 if np.int32(n) < count else 0)
        allowed = stencil_passes(test, ref, np.uint8(stencil[j, first + n] & read))
        passes = np.int32(inside & np.int32(np.int8(allowed)))  # 255 as int8 is -1
        whole[MASK + n] = passes
        every, some = np.int32(every & np.int32(passes | ~inside)), np.int32(some | passes)
    return every != 0, some != 0


@copied_kernel
def test_depths_and_update_stencil(
    numbers, byte_numbers, largest, f, planes, t, depth_range, j, left, length, depth, stencil, whole
):
    """Do what `test_span` does where there are both tests, in one loop over whole portions, as `test_depths`."""
    first, count, depth_test = np.uint64(left), np.int32(length), depth_test_of(numbers, f)
    test, ref, read = stencil_test_of(byte_numbers, f), byte_numbers[f, REF], byte_numbers[f, READ]
    write, most = byte_numbers[f, WRITE], byte_numbers[f, LARGEST]
    sfail, zfail = stencil_update_of(byte_numbers, f, SFAIL), stencil_update_of(byte_numbers, f, ZFAIL)
    zpass = stencil_update_of(byte_numbers, f, ZPASS)
    z0, dz, dz_row, offset = planes[t, 0], planes[t, 1], planes[t, 2], planes[t, 3]
    row_at, start_at = np.float32(np.int32(j)), np.float32(np.int32(left))
    writes, every, some = np.int32(-1 if numbers[f, DEPTH_WRITE] else 0), np.int32(-1), np.int32(0)
    for n in range(whole_portions(length)):
        place = np.int32(n)
        z = depth_of(z0, dz, dz_row, offset, start_at + np.float32(place), row_at, depth_range, largest)
        stored, s, inside = depth[j, first + n], stencil[j, first + n], np.int32(-1 if place < count else 0)
        hit, allowed = depth_passes(depth_test, z, stored), stencil_passes(test, ref, np.uint8(s & read))
        passing, failing, denied = updated(zpass, s, most), updated(zfail, s, most), updated(sfail, s, most)
        after = passing if hit else failing
        after = after if allowed else denied
        changed = np.uint8(np.uint8(s ^ after) & write)
        stencil[j, first + n] = np.uint8(s ^ changed) if inside else s
        passes = np.int32(np.int32(hit & np.int32(np.int8(allowed))) & inside)  # 255 as int8 is -1
        whole[MASK + n] = passes
        every, some = np.int32(every & np.int32(passes | ~inside)), np.int32(some | passes)
        depth[j, first + n] = z if np.int32(passes & writes) else stored
    return every != 0, some != 0


@kernel
def test_span(
    tests_depth, tests_stencil, numbers, byte_numbers, largest, f, planes, t, depth_range, j, left, length, depth,
    stencil, at, room, whole,
):  # fmt: skip
    """Test up to SIZE fragments of row `j` of triangle `t`; return whether all and whether some of them pass.

    `f` is the facing. MASK receives which fragments pass, from place `at` of the block on.
    """
    first, mask, z = np.uint64(left), MASK + at, DEPTH + at
    if tests_depth:
        write_depths(planes, t, depth_range, largest, j, left, length, z, room)
        depth_test = depth_test_of(numbers, f)
        for n in range(length):
            whole[mask + n] = depth_passes(depth_test, room[z + n], depth[j, first + n])
    else:
        for n in range(length):
            whole[mask + n] = -1
    if tests_stencil:
        update_stencil(byte_numbers, f, j, first, length, stencil, mask, whole)
    every, some = np.int32(-1), np.int32(0)
    for n in range(length):
        every &= whole[mask + n]
        some |= whole[mask + n]
    if numbers[f, DEPTH_WRITE] and some:
        write_passing(j, first, length, depth, at, room, whole)
    return every != 0, some != 0


@kernel
def write_passing(j, first, length, depth, at, room, whole):
    """Write the depths of the fragments where MASK is set to row `j`, from column `first` on."""
    for n in range(length):
        z = room[DEPTH + at + n] if whole[MASK + at + n] else depth[j, first + n]
        room[W + at + n] = z  # is not read: without it, the next store would be a masked one, see `any_state`
        depth[j, first + n] = z


@kernel
def write_depths(planes, t, depth_range, largest, j, left, length, row, room):
    """Write the depths of fragments in row `j` of triangle `t`, in buffer units, from place `row` of the block on."""
    z0, dz, dz_row, offset = planes[t, 0], planes[t, 1], planes[t, 2], planes[t, 3]
    row_at, start_at = np.float32(np.int32(j)), np.float32(np.int32(left))
    for n in range(length):
        column = start_at + np.float32(np.int32(n))
        room[row + n] = depth_of(z0, dz, dz_row, offset, column, row_at, depth_range, largest)


@kernel
def update_stencil(numbers, f, j, first, length, stencil, mask, whole):
    """Test and update stencil values from column `first` on; row `mask`, where the depth passes, becomes where both do.

    `numbers` are the bytes of `fragment_numbers.numbers_of`.
    """
    test, ref, read = stencil_test_of(numbers, f), numbers[f, REF], numbers[f, READ]
    write, most = numbers[f, WRITE], numbers[f, LARGEST]
    sfail, zfail = stencil_update_of(numbers, f, SFAIL), stencil_update_of(numbers, f, ZFAIL)
    zpass = stencil_update_of(numbers, f, ZPASS)
    for n in range(length):
        hit, s = whole[mask + n], stencil[j, first + n]
        allowed = stencil_passes(test, ref, np.uint8(s & read))
        passing, failing, denied = updated(zpass, s, most), updated(zfail, s, most), updated(sfail, s, most)
        after = passing if hit else failing
        after = after if allowed else denied
        stencil[j, first + n] = np.uint8(s ^ np.uint8(np.uint8(s ^ after) & write))
        whole[mask + n] = hit if allowed else 0
