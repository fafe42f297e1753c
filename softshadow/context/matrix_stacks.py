"""Matrix stacks that compute their matrices when something reads them.

A call such as glTranslate only queues its numbers. The first reader (a draw, a query, a light's position) has all
queued operations carried out by one compiled function. A push only leaves room in the queue, and a pop drops what was
queued since its push: a program that draws nothing between them pays for neither.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from softshadow.context import matrix_products as products
from softshadow.context.matrix_kinds import derived_kind
from softshadow.context.matrix_products import IDENTITY, LOAD, LOOK_AT, MULTIPLY, PUSH, ROTATE, SCALE, SIZES, TRANSLATE
from softshadow.kernel_cache import KernelGroup
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
LAST = CAPACITY - NUMBER  # the last place for a push
KNOWN = ~UNKNOWN
SAME_SCALE = 1e-8  # a scale is uniform if its factors differ by less (Mesa, math/m_matrix.c)
PACK_1, PACK_4, PACK_6, PACK_10 = (struct.Struct(f"={n}d").pack_into for n in (1, 4, 6, 10))
MATRIX = struct.Struct("=17d")  # a code and 16 elements, column after column
# bytes computed before compiled code pays, by what has to be done for it first: a program that draws little needs none
FEW_TO_LOAD, FEW_TO_COMPILE = 250 * NUMBER, 1000 * NUMBER
MATRIX_KERNELS = KernelGroup("matrices")


class MatrixStack:
    """One of GL's matrix stacks, with the identity on it.

    Its last entry is the current matrix. Entries are read-only (4, 4) arrays, and stay the same objects until a call
    changes them. `kind` says which transformations the current matrix may contain: Mesa inverts by kind
    (`softshadow.programs.inverse`).

    Attributes
    ----------
    known : (4, 4) or None   the current matrix; None if operations on it are still queued
    unresolved_kind : int    the kind as the calls have left it
    below : list             kinds and matrices of the entries below, and the byte of the push onto each
    most_below : int         how many entries there can be
    end : int                bytes of the queue that are in use
    level : int              that the first queued operation applies to: pushes onto lower ones have been carried out

    Parameters
    ----------
    limit : int              the number of matrices that it holds
    real : float32, or float64 for contexts with exact precision
    """

    def __init__(self, limit: int, real: type[np.floating]) -> None:
        self.limit = limit
        self._is_single = real is np.float32
        self._carry_out: Any = products.carry_out_by_textbook
        self._computed = 0
        self._dtype = np.dtype(real)
        self._size = 16 * self._dtype.itemsize  # bytes of a matrix
        self._matrices = bytearray(limit * self._size)
        self._bytes = memoryview(self._matrices)
        self._levels = np.frombuffer(self._matrices, real).reshape(limit, 4, 4)
        self._levels[0] = np.eye(4)
        self._identity = self._copy(0)
        self.unresolved_kind = 0
        self.known: np.ndarray | None = self._identity
        self.below: list[tuple[int, np.ndarray | None, int]] = []
        self.most_below = limit - 1
        self._memory = bytearray(CAPACITY)
        self._queue = np.frombuffer(self._memory, np.float64)
        self.end, self.level = 0, 0
        self._drawn = b""  # by the latest draw

    def __len__(self) -> int:
        return len(self.below) + 1

    def __getitem__(self, index: int) -> np.ndarray:
        level = range(len(self))[index]
        if level == len(self.below):
            return self.current
        kind, entry, push = self.below[level]
        if entry is None:
            self._compute()
            entry = self._copy(level)
            self.below[level] = kind, entry, push
        return entry

    def _read(self) -> np.ndarray:
        """Return the current matrix, after the queued operations."""
        self._compute()
        self.known = matrix = self._copy(len(self.below))
        return matrix

    def _copy(self, level: int) -> np.ndarray:
        """Return a computed matrix, read-only."""
        start = level * self._size
        return np.ndarray((4, 4), self._dtype, bytes(self._bytes[start : start + self._size]))

    @property
    def current(self) -> np.ndarray:
        """The current matrix, read-only."""
        return self._read() if self.known is None else self.known

    @property
    def kind(self) -> int:
        """The kind of the current matrix; an unknown one is derived from its elements, as Mesa does at each draw."""
        if self.unresolved_kind & UNKNOWN:
            self.unresolved_kind = self._derive_kind()
        return self.unresolved_kind

    def _derive_kind(self) -> int:
        matrix = self.current
        is_compiled = self._carry_out is not products.carry_out_by_textbook
        return int(derived_kind(matrix)) if is_compiled else known_kind(matrix)

    def drawn(self) -> tuple[np.ndarray, int]:
        """Return the current matrix and its kind, for a draw."""
        matrix, kind = self.known, self.unresolved_kind
        return self._read() if matrix is None else matrix, self.kind if kind & UNKNOWN else kind

    def drawn_bytes(self) -> tuple[bytes, int]:
        """Return what `drawn` does, with the bytes of the matrix: an array of it costs as much as computing it."""
        if self.end:
            self._compute()
        kind, start = self.unresolved_kind, len(self.below) * self._size
        matrix = self._bytes[start : start + self._size]
        if matrix != self._drawn:  # else it is the same object, so that equal ones are known
            self._drawn = bytes(matrix)
        return self._drawn, self.kind if kind & UNKNOWN else kind

    # -- stack ---------------------------------------------------------------------------------------------------------
    def push(self) -> bool:
        """Push a copy of the current matrix; return False if the stack is full."""
        below, kind, end = self.below, self.unresolved_kind, self.end
        if len(below) == self.most_below:
            return False
        if kind & UNKNOWN or end > LAST:
            kind, end = self.kind, self._compute()
        below.append((kind, self.known, end))
        self.end = end + NUMBER
        return True

    def pop(self) -> bool:
        """Return to the matrix before the last push; return False if there is none."""
        below = self.below
        try:
            self.unresolved_kind, self.known, push = below.pop()
        except IndexError:
            return False
        if len(below) >= self.level:
            self.end = push
        else:  # the push has been carried out, so all that is queued applies to its level
            self.end, self.level = 0, len(below)
        return True

    @property
    def equals_pushed(self) -> bool:
        """Whether the current matrix has the same bytes as the one below it."""
        known = self.known
        if known is not None and known is self.below[-1][1]:
            return True
        if self.end:
            self._compute()
        size, matrices = self._size, self._matrices
        start = len(self.below) * size
        return matrices[start : start + size] == matrices[start - size : start]

    # -- operations ----------------------------------------------------------------------------------------------------
    def translate(self, x: float, y: float, z: float) -> None:
        """Multiply by a translation."""
        try:
            PACK_4(self._memory, self.end, TRANSLATE, x, y, z)
        except struct.error:
            self._make_room(x, y, z)
            PACK_4(self._memory, self.end, TRANSLATE, x, y, z)
        self.end += 4 * NUMBER
        self.known = None
        self.unresolved_kind |= TRANSLATED

    def translate_in_turn(self, moves: Sequence[tuple[float, float, float]]) -> np.ndarray:
        """Multiply by translations, one after the other; return the matrices (N, 4, 4) after each, read-only."""
        self._compute()
        current = self._levels[len(self.below)]
        matrices = np.empty((1 + len(moves), 4, 4), self._dtype)
        matrices[0] = current
        numbers = [number for move in moves for number in (PUSH, TRANSLATE, *move)]
        self._carry_out(np.array(numbers, np.float64), len(numbers), matrices, 0)
        self._computed += len(numbers) * NUMBER
        current[...] = matrices[-1]
        matrices.setflags(write=False)
        if moves:
            self.known = matrices[-1]
            self.unresolved_kind |= TRANSLATED
        return matrices[1:]

    def scale(self, x: float, y: float, z: float) -> None:
        """Multiply by a scale."""
        try:
            PACK_4(self._memory, self.end, SCALE, x, y, z)
        except struct.error:
            self._make_room(x, y, z)
            PACK_4(self._memory, self.end, SCALE, x, y, z)
        self.end += 4 * NUMBER
        self.known = None
        self.unresolved_kind |= UNIFORM_SCALE if max(abs(x - y), abs(x - z)) < SAME_SCALE else GENERAL_SCALE

    def rotate(self, angle: float, x: float, y: float, z: float) -> None:
        """Multiply by a rotation: degrees about an axis."""
        sine, cosine = sine_and_cosine(float(angle), self._is_single)
        try:
            PACK_6(self._memory, self.end, ROTATE, sine, cosine, x, y, z)
        except struct.error:
            self._make_room(sine, cosine, x, y, z)
            PACK_6(self._memory, self.end, ROTATE, sine, cosine, x, y, z)
        self.end += 6 * NUMBER
        self.known = None
        self.unresolved_kind |= ROTATION

    def load_identity(self) -> None:
        """Replace the current matrix by the identity."""
        if self.known is not self._identity:
            self._forget()
            self._enqueue(PACK_1, IDENTITY)
            self.known = self._identity
        # Mesa keeps the kind of the old matrix, and so inverts products with the identity more generally
        self.unresolved_kind &= KNOWN

    def load(self, matrix: np.ndarray) -> None:
        """Replace the current matrix by a read-only (4, 4) array."""
        self._forget()
        self._enqueue_matrix(LOAD, matrix)
        self.known = np.ndarray((4, 4), self._dtype, matrix.tobytes())  # row after row, as all others
        self.unresolved_kind = GENERAL | UNKNOWN

    def multiply(self, matrix: np.ndarray) -> None:
        """Multiply by a (4, 4) array."""
        self._enqueue_matrix(MULTIPLY, matrix)
        self.known = None
        self.unresolved_kind |= GENERAL | UNKNOWN

    def perspective(self, fov_y: float, aspect: float, near: float, far: float) -> None:
        """Multiply by gluPerspective's matrix; do nothing for arguments that GLU ignores."""
        packed = packed_perspective(fov_y, aspect, near, far)
        if packed:
            self.multiply_packed(packed)

    def multiply_packed(self, packed: bytes) -> None:
        """Multiply by a matrix of `packed_perspective`."""
        self._append(packed)
        self.unresolved_kind |= GENERAL | UNKNOWN

    def frustum(self, *planes: float) -> None:
        """Multiply by glFrustum's matrix: left, right, bottom, top, near, far."""
        self._append(_packed(frustum, tuple(map(float, planes)), self._is_single))
        self.unresolved_kind |= GENERAL

    def ortho(self, *planes: float) -> None:
        """Multiply by glOrtho's matrix: left, right, bottom, top, near, far."""
        self._append(_packed(ortho, tuple(map(float, planes)), self._is_single))
        self.unresolved_kind |= GENERAL_SCALE | TRANSLATED

    def look_at(self, *places: float) -> None:
        """Multiply by gluLookAt's matrix: eye, centre and up, nine numbers."""
        self._enqueue(PACK_10, LOOK_AT, *places)
        self.known = None
        self.unresolved_kind |= GENERAL | TRANSLATED | UNKNOWN

    # -- queue ---------------------------------------------------------------------------------------------------------
    def _enqueue(self, pack: Any, *numbers: float) -> None:
        """Append an operation."""
        try:
            pack(self._memory, self.end, *numbers)
        except struct.error:
            self._make_room(*numbers)
            pack(self._memory, self.end, *numbers)
        self.end += len(numbers) * NUMBER

    def _append(self, packed: bytes) -> None:
        """Append a product with a packed matrix."""
        end = self.end
        if end + len(packed) > CAPACITY:
            end = self._compute()
        self._memory[end : end + len(packed)] = packed
        self.end = end + len(packed)
        self.known = None

    def _enqueue_matrix(self, code: int, matrix: np.ndarray) -> None:
        if self.end + SIZES[code] * NUMBER > CAPACITY:
            self._compute()
        start = self.end // NUMBER
        self._queue[start] = code
        self._queue[start + 1 : start + 17].reshape(4, 4)[...] = matrix.T
        self.end += SIZES[code] * NUMBER

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
        self.end = self.below[-1][2] + NUMBER if len(self.below) > self.level else 0

    def _compute(self) -> int:
        """Carry out the queued operations; return 0, the bytes in use."""
        if self.end:
            for _, _, push in self.below[self.level :]:
                self._queue[push // NUMBER] = PUSH
            self.level = self._carry_out(self._queue, self.end // NUMBER, self._levels, self.level)
            self._computed, self.end = self._computed + self.end, 0
            if self._computed >= FEW_TO_LOAD and self._carry_out is products.carry_out_by_textbook:
                self._choose_code()
        return 0

    def _choose_code(self) -> None:
        """Let compiled code multiply from now on if it is on disk or compiling it pays; it computes in float32."""
        pays = self._computed >= FEW_TO_COMPILE or MATRIX_KERNELS.are_compiled()
        if pays and self._is_single and hasattr(products.carry_out, "py_func"):
            self._carry_out = products.carry_out
            MATRIX_KERNELS.note_compiled()


@lru_cache(maxsize=64)
def packed_perspective(fov_y: float, aspect: float, near: float, far: float) -> bytes:
    """Return the product with gluPerspective's matrix as an operation of the queue; none for what GLU ignores."""
    sine = math.sin(math.radians(fov_y / 2)) if math.isfinite(fov_y) else math.nan
    if far == near or sine == 0 or aspect == 0:
        return b""
    x, y, z, shift = perspective_elements(float(fov_y), float(aspect), float(near), float(far))
    return MATRIX.pack(MULTIPLY, x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, -1, 0, 0, shift, 0)


@lru_cache(maxsize=64)
def _packed(make: Callable[..., np.ndarray], planes: tuple[float, ...], single: bool) -> bytes:
    """Return the product with a projection as an operation of the queue; programs make the same one in every frame."""
    matrix = make(*planes, real=np.float32 if single else np.float64)
    return MATRIX.pack(MULTIPLY, *matrix.T.ravel().tolist())
