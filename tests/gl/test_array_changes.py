"""Every draw reads the arrays as they are at the call; equal contents are recorded once."""

import ctypes
from typing import Any

import numpy as np
import pytest

from softshadow import gl
from softshadow.context import Context
from softshadow.gl import array_draws, array_snapshots, index_snapshots
from softshadow.gl.vertex_arrays import DTYPES, rows_of
from softshadow.pipeline.commands import Vertices

POINTERS = {"position": gl.glVertexPointer, "color": gl.glColorPointer, "texcoord0": gl.glTexCoordPointer}
STATES = {
    "position": gl.GL_VERTEX_ARRAY, "color": gl.GL_COLOR_ARRAY, "normal": gl.GL_NORMAL_ARRAY,
    "texcoord0": gl.GL_TEXTURE_COORD_ARRAY,
}  # fmt: skip
REST = (0, 0, 0, 1)


@pytest.fixture(params=["mesa", "exact"])
def context(request, monkeypatch):
    with gl.create_context(4, 4, precision=request.param) as context:
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        drawn: list[Any] = []
        vars(context).update(drawn=drawn)

        def note(context: Context, mode: int, vertices: Vertices, indices: Any, slots: tuple[int, ...]) -> None:
            drawn.append((vertices, indices))

        monkeypatch.setattr(array_draws, "draw_maybe_later", note)
        yield context


def converted(rows: np.ndarray, key: str, real: type) -> np.ndarray:
    """The rows of an attribute as the textbook converts them."""
    width = 3 if key == "normal" else 4
    full = np.empty((len(rows), width), real)
    full[:] = REST[:width]
    if key in ("color", "normal") and rows.dtype.kind in "iu":
        top, bits = (8388607, rows >> 9) if rows.dtype == np.uint32 else (np.iinfo(rows.dtype).max, rows)
        rows = bits.astype(real) * real(1 / top)
    with np.errstate(over="ignore"):
        full[:, : rows.shape[1]] = rows
    return full


class Arrays:
    """Arrays of one kind each, set and changed at random, beside what a draw must read."""

    def __init__(self, rng: np.random.Generator, real: type) -> None:
        self.rng, self.real = rng, real
        self.memory: dict[str, tuple] = {}  # key: (numbers, dtype, size, stride, place)
        self.enabled = {"position"}

    def set_pointer(self, key: str) -> None:
        rng = self.rng
        type = int(rng.choice([gl.GL_FLOAT, gl.GL_DOUBLE, gl.GL_SHORT, gl.GL_INT]))
        if key == "color" and rng.random() < 0.5:
            type = int(rng.choice([gl.GL_UNSIGNED_BYTE, gl.GL_UNSIGNED_INT, gl.GL_BYTE]))
        dtype = DTYPES[type]
        size = 3 if key in ("normal", "color") else int(rng.integers(2, 5))
        stride = int(rng.choice([0, 0, size * dtype.itemsize, dtype.itemsize, 40]))
        n = int(rng.choice([12, 2000]))
        numbers = self.numbers(dtype, n * size if not stride else n * stride // dtype.itemsize + size)
        way = rng.choice(["array", "view", "frozen", "reversed", "list", "bytes", "buffer", "kept"])
        if way == "kept" and key in self.memory:
            return
        bind = 0
        if way == "view":
            pointer = np.concatenate([numbers, numbers])[3 : 3 + len(numbers)]
        elif way == "frozen":
            numbers.setflags(write=False)
            pointer = numbers
        elif way == "reversed":
            pointer = numbers[::-1]
        elif way == "list":
            pointer = numbers.tolist()
        elif way == "bytes":
            pointer = numbers.tobytes()
        elif way == "buffer":
            bind = int(rng.integers(1, 4))
            gl.glBindBuffer(gl.GL_ARRAY_BUFFER, bind)
            gl.glBufferData(gl.GL_ARRAY_BUFFER, numbers, gl.GL_STATIC_DRAW)
            for other, (_, *rest) in list(self.memory.items()):
                if rest[-1] == bind:  # the arrays in this buffer change, too
                    self.memory[other] = (numbers.view(np.uint8), *rest)
            pointer = None
        else:
            pointer = numbers
        call = (size, type, stride, pointer)
        gl.glNormalPointer(*call[1:]) if key == "normal" else POINTERS[key](*call)
        gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 0)
        live = numbers.view(np.uint8) if bind else pointer
        if way in ("list", "bytes", "reversed"):  # read by the pointer call, or nobody can change them
            live = np.ascontiguousarray(numbers[::-1] if way == "reversed" else numbers).copy()
            live.setflags(write=False)
        self.memory[key] = (live, dtype, size, stride, bind)

    def numbers(self, dtype: np.dtype, n: int) -> np.ndarray:
        if dtype.kind == "f":
            return self.rng.choice([0.0, -0.0, np.nan, 1.5, -2.25, 1e30, np.inf, 0.1], n).astype(dtype)
        return self.rng.integers(np.iinfo(dtype).min, np.iinfo(dtype).max, n, dtype, endpoint=True)

    def change(self) -> None:
        key = str(self.rng.choice(list(self.memory)))
        live, dtype, _, _, bind = self.memory[key]
        place = int(self.rng.integers(len(live) // (dtype.itemsize if bind else 1)))
        new = self.numbers(dtype, 1)
        if bind:
            changed = live.copy()
            changed[place * dtype.itemsize : (place + 1) * dtype.itemsize] = new.view(np.uint8)
            gl.glBindBuffer(gl.GL_ARRAY_BUFFER, bind)
            gl.glBufferSubData(gl.GL_ARRAY_BUFFER, place * dtype.itemsize, new)
            gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 0)
            for other, (_, *rest) in list(self.memory.items()):
                if rest[-1] == bind:
                    self.memory[other] = (changed, *rest)
        elif live.flags.writeable:
            live[place] = new[0]

    def expected(self, key: str) -> np.ndarray:
        live, dtype, size, stride, _ = self.memory[key]
        content = live.tobytes()
        values = np.frombuffer(content[: len(content) // dtype.itemsize * dtype.itemsize], dtype)
        return converted(rows_of(values, dtype, size, stride), key, self.real)

    def switch(self) -> None:
        key = str(self.rng.choice(["color", "normal", "texcoord0"]))
        if key in self.memory:
            (gl.glDisableClientState if key in self.enabled else gl.glEnableClientState)(STATES[key])
            self.enabled ^= {key}

    def constants(self) -> dict[str, tuple]:
        current = gl.current().current
        return {"color": current.color, "normal": current.normal, "texcoord0": current.texcoords[0]}


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("small", [0, 64, 4096])
def test_draws_read_arrays_as_they_are(context, monkeypatch, seed, small):
    """Random arrays, strides, buffers and changes between draws: the vertices of each draw, bit for bit."""
    monkeypatch.setattr(array_snapshots, "SMALL", small)
    monkeypatch.setattr(index_snapshots, "SMALL", small)
    monkeypatch.setattr(array_snapshots, "CHUNK", 7)
    rng = np.random.default_rng(seed)
    arrays = Arrays(rng, context.real)
    arrays.set_pointer("position")
    indices = rng.integers(0, 10, 30).astype(np.uint16)
    for _ in range(120):
        what = rng.random()
        if what < 0.1:
            arrays.set_pointer(str(rng.choice(list(STATES))))
        elif what < 0.35:
            arrays.change()
        elif what < 0.45:
            arrays.switch()
        elif what < 0.55:
            gl.glColor4f(*rng.choice([0.0, -0.0, 0.5, 1.0], 4))
        elif what < 0.65:
            indices[rng.integers(30)] = rng.integers(0, 10)
        rows = {key: arrays.expected(key) for key in arrays.enabled}
        n = min(map(len, rows.values()))
        if rng.random() < 0.5 and n >= 10:
            count = int(rng.integers(1, 31))
            part = indices if rng.random() < 0.5 else indices[30 - count :] if rng.random() < 0.5 else indices[::-1]
            gl.glDrawElements(gl.GL_POINTS, count, gl.GL_UNSIGNED_SHORT, part)
            named = np.ravel(part)[:count].astype(np.int32)
            vertices, drawn = context.drawn[-1]
            lowest = named.min()  # vertices before it are not part of the draw
            assert drawn.tolist() == (named - lowest).tolist()
            assert len(vertices.position) == named.max() + 1 - lowest
            named, rows = named - lowest, {key: values[lowest:] for key, values in rows.items()}
        else:
            first, end = sorted(rng.integers(0, n + 1, 2).tolist())
            if first == end:
                continue
            gl.glDrawArrays(gl.GL_POINTS, first, end - first)
            named, (vertices, _) = np.arange(end - first), context.drawn[-1]
            rows = {key: values[first:end] for key, values in rows.items()}
            assert len(vertices.position) == end - first
        for key, constant in arrays.constants().items():
            shape = (len(vertices.position), len(constant))
            rows.setdefault(key, np.broadcast_to(np.array(constant, context.real), shape))
        for key, values in rows.items():
            array = vertices.texcoords[0] if key == "texcoord0" else getattr(vertices, key)
            assert not array.flags.writeable
            assert array.dtype == context.real
            assert array[named].tobytes() == values[named].tobytes(), key
    kept = [(vertices, vertices.position.tobytes()) for vertices, _ in context.drawn[-30:]]
    for _ in range(20):
        arrays.change()
    assert all(vertices.position.tobytes() == before for vertices, before in kept)


def test_equal_contents_are_recorded_once(context):
    corners, indices = np.random.default_rng(1).random((600, 3)).astype(np.float32), np.arange(600, dtype=np.uint32)
    for array in (corners, corners, corners.copy()):
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, array)
        gl.glDrawElements(gl.GL_TRIANGLES, 600, gl.GL_UNSIGNED_INT, indices)
    gl.glColor3f(1, 0, 0)
    gl.glDrawElements(gl.GL_TRIANGLES, 600, gl.GL_UNSIGNED_INT, indices.copy())
    vertices, drawn = zip(*context.drawn, strict=True)
    assert vertices[0] is vertices[1] is vertices[2]
    assert vertices[3] is not vertices[0]
    assert vertices[3].position is vertices[0].position
    assert all(each is drawn[0] for each in drawn)


def test_contents_that_come_back_are_recorded_once(context):
    corners = np.random.default_rng(1).random((600, 4))
    gl.glVertexPointer(4, gl.GL_DOUBLE, 0, corners)
    for x in (1, 2, 1, 2):
        corners[0, 0] = x
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, 600)
    first, second, third, fourth = (vertices for vertices, _ in context.drawn)
    assert first is third
    assert second is fourth
    assert first is not second


def test_zeros_of_either_sign_are_different_constants(context):
    corners = np.zeros((3, 3), np.float32)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, corners)
    for red in (0.0, -0.0, 0.0):
        gl.glColor3f(red, 0, 0)
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
    signs = [bool(np.signbit(vertices.color[2, 0])) for vertices, _ in context.drawn]
    assert signs == [False, True, False]
    assert context.drawn[0][0] is context.drawn[2][0]


@pytest.mark.parametrize("n", [3, 3000])
def test_index_that_leaves_the_array_is_found_after_any_number_of_equal_draws(context, n):
    corners, indices = np.zeros((n, 3), np.float32), np.arange(n, dtype=np.uint32)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, corners)
    for _ in range(3):
        gl.glDrawElements(gl.GL_TRIANGLES, n, gl.GL_UNSIGNED_INT, indices)
    for wrong, message in ((n, f"vertex {n} is outside"), (2**31, "is negative")):
        indices[n // 2] = wrong
        with pytest.raises(ValueError, match=message):
            gl.glDrawElements(gl.GL_TRIANGLES, n, gl.GL_UNSIGNED_INT, indices)
    indices[n // 2] = 0
    gl.glDrawElements(gl.GL_TRIANGLES, n, gl.GL_UNSIGNED_INT, indices)
    assert int(context.drawn[-1][1].max()) == n - 1


def test_array_that_takes_the_place_of_another_is_read(context):
    """Arrays are freed, and others are allocated at the same addresses."""
    for value in range(200):
        corners = np.full((12, 3), value, np.float32)
        corners[:, 1] = np.arange(12)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, corners)
        gl.glDrawElements(gl.GL_TRIANGLES, 3, gl.GL_UNSIGNED_INT, np.full(3, value % 12, np.uint32))
        vertices, indices = context.drawn[-1]
        assert vertices.position[:, :3].tolist() == [[value, value % 12, value]]
        assert (indices == 0).all()


def test_shorter_array_at_the_same_place_is_checked(context):
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, np.zeros((12, 3), np.float32))
    gl.glDrawArrays(gl.GL_TRIANGLES, 0, 12)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, np.zeros((11, 3), np.float32))
    with pytest.raises(ValueError, match="vertex 11 is outside"):
        gl.glDrawArrays(gl.GL_TRIANGLES, 0, 12)


def test_buffer_that_is_replaced_is_read_again(context):
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 1)
    gl.glBindBuffer(gl.GL_ELEMENT_ARRAY_BUFFER, 2)
    for value in (1, 2):
        gl.glBufferData(gl.GL_ARRAY_BUFFER, np.full(12, value, np.float32), gl.GL_DYNAMIC_DRAW)
        gl.glBufferData(gl.GL_ELEMENT_ARRAY_BUFFER, np.full(4, value, np.uint8), gl.GL_DYNAMIC_DRAW)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, ctypes.c_void_p(0))
        for new in (value, value + 5):
            gl.glBufferSubData(gl.GL_ARRAY_BUFFER, 12 * value, np.float32([new]))
            gl.glBufferSubData(gl.GL_ELEMENT_ARRAY_BUFFER, 1, np.uint8([new % 4]))
            gl.glDrawElements(gl.GL_POINTS, 4, gl.GL_UNSIGNED_BYTE, None)
            vertices, indices = context.drawn[-1]
            assert vertices.position[indices[0], 0] == new
            assert (indices - indices[0]).tolist() == [0, new % 4 - value, 0, 0]
    gl.glBufferData(gl.GL_ARRAY_BUFFER, np.zeros(3, np.float32), gl.GL_DYNAMIC_DRAW)
    with pytest.raises(ValueError, match="outside the array"):
        gl.glDrawElements(gl.GL_POINTS, 4, gl.GL_UNSIGNED_BYTE, None)


def draws_of_buffers() -> Any:
    """Draw, each time after another change, with pointers and buffers that mostly stay; yield what must be drawn.

    Two buffer objects hold positions, one holds indices; with each draw come the positions in its order.
    """
    places, others = np.arange(24, dtype=np.float32).reshape(8, 3), np.arange(24, 48, dtype=np.float32).reshape(8, 3)
    numbers = np.uint8([0, 3, 1, 2, 5, 4])
    for name, content in ((1, places), (3, others)):
        gl.glBindBuffer(gl.GL_ARRAY_BUFFER, name)
        gl.glBufferData(gl.GL_ARRAY_BUFFER, content, gl.GL_DYNAMIC_DRAW)
    gl.glBindBuffer(gl.GL_ELEMENT_ARRAY_BUFFER, 2)
    gl.glBufferData(gl.GL_ELEMENT_ARRAY_BUFFER, numbers, gl.GL_DYNAMIC_DRAW)
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 1)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, None)

    def draw(count: int = 4, offset: int | None = None) -> None:
        gl.glDrawElements(gl.GL_POINTS, count, gl.GL_UNSIGNED_BYTE, offset)

    draw()
    yield places[numbers[:4]]
    draw(3, ctypes.c_void_p(2))
    yield places[numbers[2:5]]
    draw()
    yield places[numbers[:4]]
    gl.glBufferSubData(gl.GL_ELEMENT_ARRAY_BUFFER, 1, np.uint8([2]))
    numbers[1] = 2
    draw()
    yield places[numbers[:4]]
    gl.glBufferSubData(gl.GL_ARRAY_BUFFER, 0, np.float32([7]))
    places[0, 0] = 7
    draw()
    yield places[numbers[:4]]
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, 12)
    draw()
    yield places[1:][numbers[:4]]
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 3)
    draw()  # the pointer still says where
    yield places[1:][numbers[:4]]
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, 12)
    draw()
    yield others[1:][numbers[:4]]
    gl.glBindBuffer(gl.GL_ARRAY_BUFFER, 0)
    own = -others
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, own)
    draw()
    yield own[numbers[:4]]
    own[0, 0] = 9
    draw()
    yield own[numbers[:4]]
    gl.glDeleteBuffers(1, [2])
    gl.glBindBuffer(gl.GL_ELEMENT_ARRAY_BUFFER, 2)
    gl.glBufferData(gl.GL_ELEMENT_ARRAY_BUFFER, numbers[::-1].copy(), gl.GL_DYNAMIC_DRAW)
    draw()
    yield own[numbers[::-1][:4]]


def test_repeated_draws_of_buffers_see_each_change(context):
    for expected in draws_of_buffers():
        vertices, indices = context.drawn[-1]
        assert (vertices.position[indices, :3] == expected).all()


def test_repeated_draws_of_buffers_have_the_enabled_arrays(context):
    draws = draws_of_buffers()
    next(draws)
    gl.glColorPointer(3, gl.GL_FLOAT, 0, None)
    gl.glEnableClientState(gl.GL_COLOR_ARRAY)
    gl.glDrawElements(gl.GL_POINTS, 4, gl.GL_UNSIGNED_BYTE, None)
    assert context.drawn[-1][0].color.strides[0]
    gl.glDisableClientState(gl.GL_COLOR_ARRAY)
    gl.glDrawElements(gl.GL_POINTS, 4, gl.GL_UNSIGNED_BYTE, None)
    assert context.drawn[-1][0].color.tolist() == [[1, 1, 1, 1]] * 4
    assert context.drawn[-1][0] is context.drawn[0][0]


def test_many_parts_of_one_array_are_copied_a_few_times(context):
    """Strips of a large array: bytes copied in proportion to the array, not to its square."""
    corners = np.random.default_rng(2).random((64 * 500, 3)).astype(np.float32)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, corners)
    for first in range(0, len(corners), 500):
        gl.glDrawArrays(gl.GL_TRIANGLE_STRIP, first, 500)
    owners = {id(vertices.position.base) for vertices, _ in context.drawn}
    assert len(owners) <= 8
    assert context.arrays.snapshots.bytes < 4 * (12 + 16) * len(corners)


def test_interleaved_array_is_read_at_the_draw(context):
    rows = np.zeros((3, 6), np.float32)
    gl.glInterleavedArrays(gl.GL_C3F_V3F, 0, rows)
    rows[:, 0], rows[:, 3] = 0.5, 0.25
    gl.glDrawArrays(gl.GL_TRIANGLES, 0, 3)
    vertices = context.drawn[-1][0]
    assert (vertices.color[:, 0] == 0.5).all()
    assert (vertices.position[:, 0] == 0.25).all()
