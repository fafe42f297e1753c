"""The vertex stage of a run; equals `geometry.vertex.process_vertices`, see fast/test_batch.py.

From the table of the draws to the arrays that kernels fill, in parts that threads share.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from softshadow.pipeline.fast.batch.lighting import PLACED_COLUMNS
from softshadow.pipeline.fast.batch.table import REAL, Table
from softshadow.pipeline.fast.batch.vertices import prepare_draws, process_vertices
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.memory.threads import parts_of, share

VERTICES_PER_TASK = 1 << 13  # that a thread processes in one go
PLACED = 6  # of the inputs: the array that `prepare_draws` fills


class Outputs(NamedTuple):
    """What the vertex stage makes of the vertices of a run; back is None without two-sided lighting."""

    clip: np.ndarray
    codes: np.ndarray
    window: np.ndarray
    values: np.ndarray
    back: np.ndarray | None

    @property
    def for_kernels(self) -> tuple[np.ndarray, ...]:
        """The arrays, with one that is not written in the place of a missing one."""
        return *self[:4], self.values if self.back is None else self.back

    @property
    def columns(self) -> np.ndarray:
        """All values that clipping interpolates: none of back faces if it makes no new vertices."""
        if self.back is None or not self.codes.any():
            return self.values
        return np.hstack([self.values, self.back])


def empty_outputs(n: int, table: Table, k: int) -> Outputs:
    """Return the arrays for `n` vertices with `k` varyings."""
    back = scratch((n, k), REAL) if table.layout.two_side else None
    return Outputs(scratch((n, 4), REAL), scratch(n, np.int32), scratch((n, 4), REAL), scratch((n, k), REAL), back)


def inputs_of(table: Table) -> tuple[Any, ...]:
    """Return the inputs of the vertex stage, as kernels take them."""
    placed = np.zeros((len(table.rows), table.lights.shape[1], PLACED_COLUMNS), REAL)
    return (
        table.layout, table.numbers, table.rows, table.lights, table.materials, table.flags, placed, table.generated,
        table.planes, table.user_planes, table.unit_rows, table.positions, table.colors, table.normals,
        table.reflectances, table.secondaries, table.fog_coordinates, table.texcoords, table.scales, table.shifts,
    )  # fmt: skip


def write_outputs(table: Table, inputs: tuple[Any, ...], outputs: Outputs) -> None:
    """Process the vertices of all draws, in parts that threads share."""
    prepare_draws(*inputs[:3], table.lights, table.flags, inputs[PLACED])
    parts = parts_of(len(outputs.clip), VERTICES_PER_TASK)
    share(lambda part: process_vertices(*parts[part], *inputs, *outputs.for_kernels), len(parts))
