"""Fill under any state, many pixels at a time; equals `raster.fill.fill_triangles`, see fast/test_any_state.py.

The textbook asks at every pixel what the state is. Here the state is numbers (`fragment_numbers.py`), and rows are
filled in chunks of 32 columns by a few loops without branches. Depths are tested in floats, 16 to a vector, stencil
values in bytes, 32 to a vector; between the two loops, the results of the depth test are bytes. Columns outside the
triangle are masked out: their stored values are written back.

Where the first store of a loop writes either a new value or the one that is there, the compiler makes it a masked
store, for which AMD processors take a dozen cycles. So each loop first stores something else in scratch memory: whether
depths are equal, as a maximum, or which fragments pass, which is not read afterwards.
"""

import threading
from typing import Any

import numpy as np

from softshadow.jit import kernel
from softshadow.kernel_cache import KernelGroup
from softshadow.pipeline.fast.fragment_numbers import (
    ALL,
    DEPTH_WRITE,
    LARGEST,
    NONE,
    READ,
    REF,
    SFAIL,
    WRITE,
    ZFAIL,
    ZPASS,
    depth_of,
    depth_passes,
    depth_test_of,
    numbers_of,
    stencil_passes,
    stencil_test_of,
    stencil_update_of,
    updated,
)  # fmt: skip
from softshadow.pipeline.fast.small_triangles import small_fill_for
from softshadow.pipeline.memory.scratch import apart, row_columns
from softshadow.pipeline.raster.coverage import bounds, row_spans
from softshadow.pipeline.raster.fill import FillKernel
from softshadow.pipeline.raster.fragment_ops import FragmentOps
from softshadow.pipeline.raster.spans import ONLY
from softshadow.pipeline.records import NO_TRIANGLE, SEVERAL_TRIANGLES, DepthRange, FillBuffers, Region, Setup

CHUNK_LOG2 = 5  # columns processed in one go, 32: what rows are padded to (`image.PITCH`)
CHUNK = 1 << CHUNK_LOG2
# these and those of `stencil_tiles`: one takes some two seconds to compile, and gains 10 ns a fragment
FILL_KERNELS = KernelGroup("fills", pays_after=100_000_000)


def any_state_kernel(writes_ids: int, ties: list[int] | None = None) -> FillKernel:
    """Return the kernel that fills under any state without alpha test.

    Parameters
    ----------
    writes_ids : 0, LAST or ONLY
    ties : receives numbers, if a fragment has the depth that is stored, or could have it
    """

    def fill_kernel(
        front: FragmentOps,
        back: FragmentOps,
        triangles: Setup,
        numbers: np.ndarray,
        region: Region,
        depth_range: DepthRange,
        buffers: FillBuffers,
    ) -> None:
        tests_stencil = front.stencil_test or back.stencil_test
        if not (tests_stencil or front.depth_write or back.depth_write or writes_ids):
            return
        depth, stencil, ids = buffers.depth, buffers.stencil, buffers.ids
        pitch = min(depth.shape[1], stencil.shape[1], *([ids.shape[1]] if writes_ids else []))
        room = fill_scratch(pitch, region)
        KERNELS[bool(tests_stencil), bool(writes_ids)](
            writes_ids, *numbers_of(front, back), front.depth_largest, triangles.corners, triangles.depth,
            triangles.front, numbers, region, depth_range, pitch, depth, stencil, ids, *room,
        )  # fmt: skip
        if ties is not None and (tests_stencil or room[-1].any()):
            ties.append(1)

    return fill_kernel


class _FillMemory(threading.local):
    """The scratch arrays of fills, for each thread."""

    def __init__(self) -> None:
        self.row, self.box, self.ties = apart(CHUNK, np.uint8), apart(CHUNK, np.uint8), apart(CHUNK, np.int32)


_memory = _FillMemory()


def fill_scratch(pitch: int, region: Region) -> tuple[np.ndarray, ...]:
    """Return the scratch arrays of a fill, its last five arguments; the next fill of this thread uses the same.

    The last one is not 0 after the fill where a fragment has the stored depth; with ids and without stencil test only.
    """
    if len(_memory.row) < pitch:
        _memory.row = apart(pitch, np.uint8)
    _memory.ties.fill(0)
    return *row_columns(region.end_row), _memory.row, _memory.box, _memory.ties


def compiled_for(tests_stencil: bool, writes_ids: bool) -> Any:
    """Return the kernel that tests stencil values or not, and writes ids or not; loops that it lacks cost no time."""
    fill_small = small_fill_for(tests_stencil, writes_ids)

    @kernel
    def fill(
        which_ids, ops, byte_ops, largest, corners, planes, faces, numbers, region, depth_range, pitch, depth, stencil,
        ids, lefts, rights, passed, covered, ties,
    ):  # fmt: skip
        # `ops` are the numbers of both facings, `pitch` the columns that all buffers have; the last five are scratch
        last_start = pitch - CHUNK
        n = 0
        while n < numbers.shape[0]:
            n = fill_small(
                which_ids, ops, byte_ops, largest, corners, planes, faces, numbers, n, region, depth_range, pitch,
                depth, stencil, ids, passed, covered, ties,
            )  # fmt: skip
            if n == numbers.shape[0]:
                break
            t = np.uint64(numbers[n])  # unsigned: no wrap-around of negative indices is compiled in
            n += 1
            first, end = bounds(corners, t)
            first, end = max(first, region.first_row), min(end, region.end_row)
            if first >= end:  # in other bands of rows, or between the samples
                continue
            row_spans(corners, t, first, end, region.downwards, region.left, region.right, lefts, rights)
            z0, dz, dz_row, offset = planes[t, 0], planes[t, 1], planes[t, 2], planes[t, 3]
            f = np.uint64(faces[t])
            depth_test, writes_depth = depth_test_of(ops, f), np.int32(-1 if ops[f, DEPTH_WRITE] else 0)
            if tests_stencil:
                stencil_test, ref, read = stencil_test_of(byte_ops, f), byte_ops[f, REF], byte_ops[f, READ]
                write, most = byte_ops[f, WRITE], byte_ops[f, LARGEST]
                sfail, zfail = stencil_update_of(byte_ops, f, SFAIL), stencil_update_of(byte_ops, f, ZFAIL)
                zpass = stencil_update_of(byte_ops, f, ZPASS)
            if writes_ids:
                triangle = np.int32(t)
                repeated = SEVERAL_TRIANGLES if which_ids == ONLY else triangle
            for row in range(first, end):
                j, row_at = np.uint64(row), np.float32(np.int32(row))
                left, right = lefts[j], rights[j]
                # one chunk from `left` on, or all those that meet the row
                start = min(int(left), last_start) if right - left <= CHUNK else int(left) >> CHUNK_LOG2 << CHUNK_LOG2
                if tests_stencil:
                    # for the whole row: bytes read right after they were written in other portions would have to wait
                    for at in range(start, right, CHUNK):
                        start_at = np.float32(np.int32(at))
                        for k in range(CHUNK):
                            i, column = np.uint64(at) + np.uint64(k), start_at + np.float32(np.int32(k))
                            z = depth_of(z0, dz, dz_row, offset, column, row_at, depth_range, largest)
                            passed[i] = np.uint8(depth_passes(depth_test, z, depth[j, i]))
                    for at in range(start, right, CHUNK):
                        begin = min(max(left - at, 0), CHUNK)
                        count = np.uint8(min(max(right - at, begin), CHUNK) - begin)
                        for k in range(CHUNK):
                            i = np.uint64(at) + np.uint64(k)
                            hit, s = passed[i], stencil[j, i]
                            # left of the first column, the difference wraps round to large numbers
                            inside = ALL if np.uint8(np.uint8(k) - np.uint8(begin)) < count else NONE
                            allowed = stencil_passes(stencil_test, ref, np.uint8(s & read))
                            passing, failing = updated(zpass, s, most), updated(zfail, s, most)
                            after, denied = passing if hit else failing, updated(sfail, s, most)
                            after = after if allowed else denied
                            stencil[j, i] = np.uint8(s ^ np.uint8(np.uint8(s ^ after) & np.uint8(write & inside)))
                            passed[i] = np.uint8(np.uint8(hit & inside) & allowed)
                for at in range(start, right, CHUNK):
                    start_at, begin, stop = np.float32(np.int32(at)), np.int32(left - at), np.int32(right - at)
                    if writes_ids:
                        id_j = np.uint64(row - region.first_row)
                        for k in range(CHUNK):
                            i, place = np.uint64(at) + np.uint64(k), np.int32(k)
                            column = start_at + np.float32(place)
                            z = depth_of(z0, dz, dz_row, offset, column, row_at, depth_range, largest)
                            stored, before = depth[j, i], ids[id_j, i]
                            if tests_stencil:
                                passes = np.int32(-1 if passed[i] else 0)
                                ties[np.uint64(k)] = passes
                            else:
                                within = np.int32(-1 if (place >= begin) & (place < stop) else 0)
                                passes = np.int32(depth_passes(depth_test, z, stored) & within)
                                tied = np.int32((1 if z == stored else 0) & within)
                                ties[np.uint64(k)] = max(ties[np.uint64(k)], tied)
                            number = triangle if before == NO_TRIANGLE else repeated
                            depth[j, i] = z if np.int32(passes & writes_depth) else stored
                            ids[id_j, i] = number if passes else before
                    elif writes_depth:
                        for k in range(CHUNK):
                            i, place = np.uint64(at) + np.uint64(k), np.int32(k)
                            column = start_at + np.float32(place)
                            z = depth_of(z0, dz, dz_row, offset, column, row_at, depth_range, largest)
                            stored = depth[j, i]
                            if tests_stencil:
                                passes = np.int32(-1 if passed[i] else 0)
                            else:
                                within = np.int32(-1 if (place >= begin) & (place < stop) else 0)
                                passes = np.int32(depth_passes(depth_test, z, stored) & within)
                            ties[np.uint64(k)] = passes
                            depth[j, i] = z if passes else stored

    return fill


KERNELS = {
    (tests_stencil, writes_ids): compiled_for(tests_stencil, writes_ids)
    for tests_stencil in (False, True)
    for writes_ids in (False, True)
}
