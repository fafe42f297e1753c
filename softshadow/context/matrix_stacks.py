"""Matrix stacks that compute their matrices when something reads them.

A call such as glTranslate only queues its numbers. The first reader (a draw, a query, a light's position) has all
queued operations carried out by one compiled function. A pop drops what was queued since its push.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np

from softshadow.context import matrix_products as products
from softshadow.context.matrix_products import IDENTITY, LOAD, LOOK_AT, MULTIPLY, PUSH, ROTATE, SCALE, SIZES, TRANSLATE
from softshadow.matrices import frustum, ortho, perspective_elements, sine_and_cosine
from softshadow.programs.inverse import (
    GENERAL,
    GENERAL_SCALE,
    ROTATION,
    UNIFORM_SCALE,
    UNKNOWN,
    known_kind,
)
from softshadow.programs.inverse import (
    TRANSLATION as TRANSLATED,
)

NUMBER = 8  # bytes
CAPACITY = 512 * NUMBER  # of the queue
SAME_SCALE = 1e-8  # a scale is uniform if its factors differ by less (Mesa, math/m_matrix.c)
PACK_1, PACK_4, PACK_6, PACK_10, PACK_17 = (struct.Struct(f"={n}d").pack_into for n in (1, 4, 6, 10, 17))
PACKED_PUSH = struct.pack("=d", PUSH)
FEW = 1000 * NUMBER  # bytes computed before compiled code pays: a program that draws little need not load it


class MatrixStack:
    """One of GL's matrix stacks, with the identity on it.

    Its last entry is the current matrix. Entries are read-only (4, 4) arrays, and stay the same objects until a call
    changes them. `kinds` says which transformations each entry may contain: Mesa inverts by kind
    (`softshadow.programs.inverse`).

    Parameters
    ----------
    limit : int              the number of matrices that it holds
    real : float32, or float64 for contexts with exact precision
    """

    def __init__(self, limit: int, real: type[np.floating]) -> None:
        self.limit = limit
        self.kinds = [0]
        self._is_single = real is np.float32
        self._carry_out: Any = products.carry_out_by_textbook
        self._computed = 0
        self._levels = np.zeros((limit, 4, 4), real)
        self._levels[0] = np.eye(4)
        self._identity = _read_only(self._levels[0])
        # the matrices that are known; None if operations on it are still queued
        self._known: list[np.ndarray | None] = [self._identity]
        self._memory = bytearray(CAPACITY)
        self._queue = np.frombuffer(self._memory, np.float64)
        self._end = 0  # bytes in use
        self._level = 0  # that the first queued operation applies to
        self._starts = [0]  # byte where the operations on each level begin; -1 if its push has been carried out

    def __len__(self) -> int:
        return len(self.kinds)

    def __getitem__(self, index: int) -> np.ndarray:
        entry = self._known[index]
        if entry is None:
            self._compute()
            entry = self._levels[index if index >= 0 else len(self) + index].copy()
            entry.flags.writeable = False
            self._known[index] = entry
        return entry

    @property
    def current(self) -> np.ndarray:
        """The current matrix, read-only."""
        known = self._known[-1]
        return self[-1] if known is None else known

    @property
    def kind(self) -> int:
        """The kind of the current matrix; an unknown one is derived from its elements, as Mesa does at each draw."""
        kind = self.kinds[-1]
        if kind & UNKNOWN:
            kind = self.kinds[-1] = known_kind(self.current, kind)
        return kind

    def drawn(self) -> tuple[np.ndarray, int]:
        """Return the current matrix and its kind, for a draw."""
        matrix, kind = self._known[-1], self.kinds[-1]
        return self[-1] if matrix is None else matrix, self.kind if kind & UNKNOWN else kind

    # -- stack ---------------------------------------------------------------------------------------------------------
    def push(self) -> None:
        """Push a copy of the current matrix; the caller knows that there is room."""
        kinds, known = self.kinds, self._known
        kinds.append(self.kind if kinds[-1] & UNKNOWN else kinds[-1])
        known.append(known[-1])
        end = self._end
        if end + NUMBER > CAPACITY:
            end = self._compute()
        self._memory[end : end + NUMBER] = PACKED_PUSH
        self._starts.append(end)
        self._end = end + NUMBER

    def pop(self) -> None:
        """Return to the matrix before the last push; the caller knows that there is one."""
        self.kinds.pop()
        self._known.pop()
        start = self._starts.pop()
        if start >= 0:
            self._end = start
        else:  # the push has been carried out, so all that is queued applies to its level
            self._end, self._level = 0, self._level - 1

    @property
    def equals_pushed(self) -> bool:
        """Whether the current matrix has the same bytes as the one below it."""
        self._compute()
        level = len(self.kinds) - 1
        return self._levels[level].tobytes() == self._levels[level - 1].tobytes()

    # -- operations ----------------------------------------------------------------------------------------------------
    def translate(self, x: float, y: float, z: float) -> None:
        """Multiply by a translation."""
        try:
            PACK_4(self._memory, self._end, TRANSLATE, x, y, z)
        except struct.error:
            self._make_room(x, y, z)
            PACK_4(self._memory, self._end, TRANSLATE, x, y, z)
        self._end += 4 * NUMBER
        self._known[-1] = None
        self.kinds[-1] |= TRANSLATED

    def scale(self, x: float, y: float, z: float) -> None:
        """Multiply by a scale."""
        try:
            PACK_4(self._memory, self._end, SCALE, x, y, z)
        except struct.error:
            self._make_room(x, y, z)
            PACK_4(self._memory, self._end, SCALE, x, y, z)
        self._end += 4 * NUMBER
        self._known[-1] = None
        self.kinds[-1] |= UNIFORM_SCALE if max(abs(x - y), abs(x - z)) < SAME_SCALE else GENERAL_SCALE

    def rotate(self, angle: float, x: float, y: float, z: float) -> None:
        """Multiply by a rotation: degrees about an axis."""
        sine, cosine = sine_and_cosine(float(angle), self._is_single)
        try:
            PACK_6(self._memory, self._end, ROTATE, sine, cosine, x, y, z)
        except struct.error:
            self._make_room(sine, cosine, x, y, z)
            PACK_6(self._memory, self._end, ROTATE, sine, cosine, x, y, z)
        self._end += 6 * NUMBER
        self._known[-1] = None
        self.kinds[-1] |= ROTATION

    def load_identity(self) -> None:
        """Replace the current matrix by the identity."""
        if self._known[-1] is not self._identity:
            self._forget()
            self._enqueue(PACK_1, IDENTITY)
            self._known[-1] = self._identity
        # Mesa keeps the kind of the old matrix, and so inverts products with the identity more generally
        self.kinds[-1] &= ~UNKNOWN

    def load(self, matrix: np.ndarray) -> None:
        """Replace the current matrix by a read-only (4, 4) array."""
        self._forget()
        self._enqueue_matrix(LOAD, matrix)
        self._known[-1] = matrix
        self.kinds[-1] = GENERAL | UNKNOWN

    def multiply(self, matrix: np.ndarray) -> None:
        """Multiply by a (4, 4) array."""
        self._enqueue_matrix(MULTIPLY, matrix)
        self._known[-1] = None
        self.kinds[-1] |= GENERAL | UNKNOWN

    def perspective(self, fov_y: float, aspect: float, near: float, far: float) -> None:
        """Multiply by gluPerspective's matrix."""
        packed = _packed_perspective(fov_y, aspect, near, far)
        end = self._end
        if end + len(packed) > CAPACITY:
            end = self._compute()
        self._memory[end : end + len(packed)] = packed
        self._end = end + len(packed)
        self._known[-1] = None
        self.kinds[-1] |= GENERAL | UNKNOWN

    def frustum(self, *planes: float) -> None:
        """Multiply by glFrustum's matrix: left, right, bottom, top, near, far."""
        self._enqueue(PACK_17, MULTIPLY, *_elements(frustum, tuple(map(float, planes)), self._is_single))
        self._known[-1] = None
        self.kinds[-1] |= GENERAL

    def ortho(self, *planes: float) -> None:
        """Multiply by glOrtho's matrix: left, right, bottom, top, near, far."""
        self._enqueue(PACK_17, MULTIPLY, *_elements(ortho, tuple(map(float, planes)), self._is_single))
        self._known[-1] = None
        self.kinds[-1] |= GENERAL_SCALE | TRANSLATED

    def look_at(self, *places: float) -> None:
        """Multiply by gluLookAt's matrix: eye, centre and up, nine numbers."""
        self._enqueue(PACK_10, LOOK_AT, *places)
        self._known[-1] = None
        self.kinds[-1] |= GENERAL | TRANSLATED | UNKNOWN

    # -- queue ---------------------------------------------------------------------------------------------------------
    def _enqueue(self, pack: Any, *numbers: float) -> None:
        """Append an operation."""
        try:
            pack(self._memory, self._end, *numbers)
        except struct.error:
            self._make_room(*numbers)
            pack(self._memory, self._end, *numbers)
        self._end += len(numbers) * NUMBER

    def _enqueue_matrix(self, code: int, matrix: np.ndarray) -> None:
        if self._end + SIZES[code] * NUMBER > CAPACITY:
            self._compute()
        start = self._end // NUMBER
        self._queue[start] = code
        self._queue[start + 1 : start + 17].reshape(4, 4)[...] = matrix.T
        self._end += SIZES[code] * NUMBER

    def _make_room(self, *numbers: float) -> None:
        """Empty the full queue, after an operation with these numbers could not be appended.

        Raises
        ------
        TypeError
            One of them is not a number.
        """
        for number in numbers:
            float(number)
        self._compute()

    def _forget(self) -> None:
        """Drop the queued operations on the current matrix, which is about to be replaced."""
        start = self._starts[-1]
        self._end = 0 if start < 0 or len(self) == 1 else start + NUMBER

    def _compute(self) -> int:
        """Carry out the queued operations; return 0, the bytes in use."""
        if self._end:
            self._level = self._carry_out(self._queue, self._end // NUMBER, self._levels, self._level)
            self._starts = [-1] * len(self._starts)
            self._computed, self._end = self._computed + self._end, 0
            if self._computed >= FEW and self._is_single and hasattr(products.carry_out, "py_func"):
                self._carry_out = products.carry_out
        return 0


@lru_cache(maxsize=64)
def _packed_perspective(fov_y: float, aspect: float, near: float, far: float) -> bytes:
    """Return the product with gluPerspective's matrix as an operation of the queue."""
    x, y, z, shift = perspective_elements(float(fov_y), float(aspect), float(near), float(far))
    return struct.pack("=17d", MULTIPLY, x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, -1, 0, 0, shift, 0)


@lru_cache(maxsize=64)
def _elements(make: Callable[..., np.ndarray], planes: tuple[float, ...], single: bool) -> tuple[float, ...]:
    """Return a projection's 16 elements, column after column; programs make the same one in every frame."""
    return tuple(make(*planes, real=np.float32 if single else np.float64).T.ravel().tolist())


def _read_only(matrix: np.ndarray) -> np.ndarray:
    copy = matrix.copy()
    copy.flags.writeable = False
    return copy
