"""Fill kernels compiled for one state; equal to `raster.fill.fill_triangles`, see fast/test_specialize.py.

The kernel closes over the numbers that change the code (functions, operations, enables, formats); the compiler folds
them away and vectorises the loops. Compiled code is kept on disk per state. `choose.py` decides which states are
compiled.
"""

import hashlib
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from softshadow.jit import inlined, kernel
from softshadow.kernel_cache import cache_folder
from softshadow.pipeline.fast.small_triangles import common_pitch, fill_small, is_small
from softshadow.pipeline.fast.stencil_tiles import fill_in_tiles
from softshadow.pipeline.raster.fill import FillKernel, fill_rows
from softshadow.pipeline.raster.fragment_ops import FragmentOps
from softshadow.pipeline.records import BACK, EITHER, FRONT

# both facings' codes, whether they differ, and what is written of ids; or the code of one facing, for tiles
StateKey = tuple[FragmentOps, FragmentOps, int, int] | FragmentOps

compiled: dict[StateKey, FillKernel] = {}  # in this process


def is_on_disk(key: StateKey) -> bool:
    """Return whether the code of a state was compiled before, by this or another process."""
    marker = _marker(key)
    return marker is not None and marker.exists()


def _marker(key: StateKey) -> Path | None:
    """Return the empty file that says that a state's code is on disk."""
    folder = cache_folder()
    return folder / f"state-{hashlib.blake2b(repr(key).encode(), digest_size=8).hexdigest()}" if folder else None


def kernel_of(key: StateKey) -> FillKernel:
    """Return the kernel of a state, compiled on its first call."""
    if key not in compiled:
        compiled[key] = specialize_in_tiles(key) if isinstance(key, FragmentOps) else specialize(*key)
        marker = _marker(key)
        if marker is not None:
            with suppress(OSError):  # the folder was deleted meanwhile: the state is compiled for this process only
                marker.touch()
    return compiled[key]


def tiles_kernel(keys: Sequence[FragmentOps]) -> FillKernel:
    """Return the kernel that fills in tiles, for order-independent states of one facing each, or of both (one key).

    All front-facing triangles are filled before the back-facing ones. So each facing uses the code that is compiled
    for draws that cull the other one.
    """
    facings = (FRONT, BACK) if len(keys) > 1 else (EITHER,)
    kernels = [(kernel_of(key), facing) for key, facing in zip(keys, facings, strict=True)]

    def fill_facings(front: FragmentOps, back: FragmentOps, *rest: Any) -> None:
        for fill_facing, facing in kernels:
            fill_facing(back if facing == BACK else front, facing, *rest)

    return fill_facings


@inlined
def with_numbers(code, numbers):
    """Return the operations of `code` with the reference values and masks of `numbers`."""
    return FragmentOps(
        code.alpha_test, code.alpha_func, code.stencil_test, code.stencil_func, code.sfail, code.zfail, code.zpass,
        code.stencil_largest, code.depth_test, code.depth_func, code.depth_write, code.depth_largest,
        numbers.alpha_ref, numbers.ref, numbers.read_mask, numbers.write_mask,
    )  # fmt: skip


def specialize(front_code: FragmentOps, back_code: FragmentOps, two_sided: int, writes_ids: int) -> FillKernel:
    """Return `fill_triangles` compiled for the code of one state; reference values and masks stay arguments."""
    if not two_sided:  # half the code

        @kernel
        def fill_one_sided(front, back, triangles, numbers, region, depth_range, buffers):
            # taken out of the tuples once: for every triangle, counting the references would take as long as drawing it
            corners, planes, faces_front = triangles.corners, triangles.depth, triangles.front
            columns, depth, stencil, ids = buffers.columns, buffers.depth, buffers.stencil, buffers.ids
            ops, n = with_numbers(front_code, front), 0
            while n < numbers.shape[0]:
                n = fill_small(
                    ops, EITHER, writes_ids, corners, planes, faces_front, numbers, n, region, depth_range, depth,
                    stencil, ids,
                )  # fmt: skip
                if n < numbers.shape[0]:
                    t = int(numbers[n])
                    fill_rows(ops, writes_ids, corners, planes, t, region, depth_range, columns, depth, stencil, ids)
                    n += 1

        return fill_one_sided

    @kernel
    def fill_two_sided(front, back, triangles, numbers, region, depth_range, buffers):
        corners, planes, faces_front = triangles.corners, triangles.depth, triangles.front
        columns, depth, stencil, ids = buffers.columns, buffers.depth, buffers.stencil, buffers.ids
        front_ops, back_ops, n = with_numbers(front_code, front), with_numbers(back_code, back), 0
        pitch = common_pitch(writes_ids, depth, stencil, ids)
        while n < numbers.shape[0]:
            n = fill_small(
                front_ops, FRONT, writes_ids, corners, planes, faces_front, numbers, n, region, depth_range, depth,
                stencil, ids,
            )  # fmt: skip
            n = fill_small(
                back_ops, BACK, writes_ids, corners, planes, faces_front, numbers, n, region, depth_range, depth,
                stencil, ids,
            )  # fmt: skip
            if n < numbers.shape[0] and not is_small(corners, np.uint64(numbers[n]), region, pitch):
                t = int(numbers[n])
                if faces_front[t]:
                    fill_rows(
                        front_ops, writes_ids, corners, planes, t, region, depth_range, columns, depth, stencil, ids
                    )  # fmt: skip
                else:
                    fill_rows(
                        back_ops, writes_ids, corners, planes, t, region, depth_range, columns, depth, stencil, ids
                    )  # fmt: skip
                n += 1

    return fill_two_sided


def specialize_in_tiles(code: FragmentOps) -> Callable[..., None]:
    """Return `fill_in_tiles` compiled for the code of one facing."""

    @kernel
    def fill(ops, facing, triangles, numbers, region, depth_range, buffers):
        fill_in_tiles(with_numbers(code, ops), facing, triangles, numbers, region, depth_range, buffers)

    return fill
