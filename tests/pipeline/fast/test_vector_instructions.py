"""The fill kernels are vectorised: their machine code tests many pixels with one instruction.

With a branch in the wrong place, or an index that may be negative, the compiler falls back to one pixel at a time; with
a comparison of a float and an integer, it widens eight floats to float64, and with bytes that meet integers, eight
bytes to 64 bits. Only timings would show it. So the machine code is searched for instructions that every vectorised
loop over pixels has, and for those that widen.
"""

import platform
import re
from collections.abc import Callable
from typing import Any

import numba
import numpy as np
import pytest
from llvmlite import binding as llvm
from numba.core.caching import NullCache

from softshadow import gl
from softshadow.jit import kernel, parts, wide_kernel
from softshadow.pipeline import use_short_cuts
from softshadow.pipeline.fast import any_state, stencil_tiles
from softshadow.pipeline.fast.fragment_numbers import depth_test_of, numbers_of, update_of
from softshadow.pipeline.fast.narrow_rows import extent_of_rows, fill_narrow
from softshadow.pipeline.raster.fragment_ops import NO_ALPHA, FragmentOps, process_fragment
from softshadow.pipeline.records import DepthRange

# in AVX and AVX-512, with registers of 32 or 64 bytes; SSE has the same names without the v
PACKED_FLOATS_COMPARED = re.compile(r"\bv?cmp\w*ps\b[^\n]*%[xyz]mm|\bv?(?:min|max)ps\b[^\n]*%[xyz]mm")
PACKED_BYTES_COUNTED = re.compile(r"\bv?p(?:add|sub)b\b[^\n]*%[xyz]mm")
PACKED_INTEGERS_COMPARED = re.compile(r"\bv?pminsd\b[^\n]*%[xyz]mm")
FLOATS_WIDENED = re.compile(r"\bv?cvtps2pd\b")
BYTES_WIDENED = re.compile(r"\bv?pmov[sz]x[bw]q\b|\bvpmovqb\b")  # in one step or by way of words, and back
MASKED_STORE = re.compile(r"\bvp?maskmov\w+[^\n]*\)$", re.MULTILINE)  # of a load, the last operand is a register
NAMES = {"depths": (False, False), "ids": (False, True), "stencil": (True, False), "stencil and ids": (True, True)}
DEPTH_KERNELS, STENCIL_KERNELS = {"depths", "ids"}, {"stencil", "stencil and ids", "tiles"}

pytestmark = [
    pytest.mark.skipif(bool(vars(numba.config)["DISABLE_JIT"]), reason="looks at compiled code"),
    pytest.mark.skipif(
        platform.machine() not in ("x86_64", "AMD64"), reason="knows the names of x86's vector instructions only"
    ),
]


def machine_code(function: Any, *signatures: Any, decorator: Callable[..., Any] = kernel) -> str:
    """Return the assembly of a kernel; it is compiled again, since the cache has no text of it."""
    compiled = decorator(function)
    compiled._cache = NullCache()
    for signature in signatures:
        compiled.compile(signature)
    return "".join(compiled.inspect_asm().values())


def draw_quad() -> None:
    gl.glBegin(gl.GL_QUADS)
    for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        gl.glVertex3f(x, y, 0.3 * x)
    gl.glEnd()


def draw_with_all_kernels() -> None:
    """Draw depths, ids, stencil values, both, and stencil values whose order does not matter."""
    gl.glEnable(gl.GL_DEPTH_TEST)
    draw_quad()
    gl.glColorMask(False, False, False, False)
    draw_quad()
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_EQUAL, 0, 255)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_INCR, gl.GL_DECR)
    draw_quad()
    gl.glStencilFunc(gl.GL_ALWAYS, 0, 255)
    gl.glDepthMask(False)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR_WRAP)
    draw_quad()
    gl.glColorMask(True, True, True, True)
    draw_quad()
    gl.glFinish()


@pytest.fixture(scope="module")
def kernels() -> dict[str, str]:
    """Return the machine code of the fill kernels by name, compiled for float32."""
    with gl.create_context(64, 48), use_short_cuts("always"):
        draw_with_all_kernels()
    fills = {name: any_state.KERNELS[key] for name, key in NAMES.items()} | {"tiles": stencil_tiles.fill_in_tiles}
    texts = {}
    for name, fill in fills.items():
        in_float32 = [signature for signature in fill.signatures if "float64" not in str(signature)]
        assert in_float32
        texts[name] = machine_code(fill.py_func, *in_float32, decorator=wide_kernel if name == "tiles" else kernel)
    return texts


def old_loop(columns, left, right, depth, stencil, z, read, write):
    """Process a chunk in one loop, as it was: columns are floats, their limits integers."""
    ops = FragmentOps(
        0, gl.GL_ALWAYS, 1, gl.GL_ALWAYS, gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR_WRAP, 255, 1, gl.GL_LESS, 0, 0, 0, 0, read,
        write,
    )  # fmt: skip
    for k in range(32):
        i = np.uint64(k)
        inside = (columns[i] >= left) & (columns[i] < right)
        _, stencil[i], _ = process_fragment(ops, inside, NO_ALPHA, z, depth[i], stencil[i])


def test_the_search_finds_what_the_old_loop_widened():
    floats, byte = numba.types.float32[::1], numba.types.uint8[::1]
    int64 = numba.types.int64
    types = (floats, int64, int64, floats, byte, numba.types.float32, int64, int64)
    code = machine_code(old_loop, types)
    assert FLOATS_WIDENED.search(code)
    assert BYTES_WIDENED.search(code)


def test_a_loop_that_ends_early_has_no_packed_instructions():
    def first_nearer(depth, stencil, z):
        for i in range(depth.shape[0]):
            if z < depth[i]:
                stencil[i] += 1
                return i
        return -1

    code = machine_code(first_nearer, (numba.types.float32[::1], numba.types.uint8[::1], numba.types.float32))
    assert "first_nearer" in code
    assert not PACKED_FLOATS_COMPARED.search(code)
    assert not PACKED_BYTES_COUNTED.search(code)


@pytest.mark.parametrize("name", sorted(DEPTH_KERNELS | STENCIL_KERNELS))
def test_depths_are_compared_many_at_a_time(kernels, name):
    assert PACKED_FLOATS_COMPARED.search(kernels[name])


@pytest.mark.parametrize("name", sorted(STENCIL_KERNELS))
def test_stencil_values_are_counted_many_at_a_time(kernels, name):
    assert PACKED_BYTES_COUNTED.search(kernels[name])


@pytest.mark.parametrize("name", sorted(DEPTH_KERNELS | STENCIL_KERNELS))
def test_neither_floats_nor_bytes_are_widened_to_64_bits(kernels, name):
    assert not FLOATS_WIDENED.search(kernels[name])
    assert not BYTES_WIDENED.search(kernels[name])


def test_the_extent_of_a_triangle_in_a_tile_is_found_many_rows_at_a_time():
    """Other loops in the kernel of tiles hide it there."""
    columns = numba.types.int32[::1]
    code = machine_code(extent_of_rows.py_func, (*[numba.types.int64] * 4, columns, columns), decorator=wide_kernel)
    assert PACKED_INTEGERS_COMPARED.search(code)


def test_narrow_rows_are_tested_and_counted_many_columns_at_a_time():
    keep, up, always = gl.GL_KEEP, gl.GL_INCR_WRAP, gl.GL_ALWAYS
    ops = FragmentOps(0, always, 1, always, keep, up, keep, 255, 1, gl.GL_LESS, 0, 2**24 - 1, 0, 0, 255, 255)
    columns, byte, real = np.zeros(64, np.int32), np.uint8(255), np.float32(0)
    update, test = update_of(up, 1, 0, 255), depth_test_of(numbers_of(ops, ops)[0], 0)
    buffers = np.zeros((64, 64), np.float32), np.zeros((64, 64), np.uint8)
    arguments = (
        up, 0, 16, 0, 64, 64, columns, columns, update, update, byte, test, real, real, real, real,
        DepthRange(real, real), 2**24 - 1, *buffers,
    )  # fmt: skip
    code = machine_code(fill_narrow.py_func, tuple(map(numba.typeof, arguments)), decorator=wide_kernel)
    assert PACKED_FLOATS_COMPARED.search(code)
    assert PACKED_BYTES_COUNTED.search(code)


def test_the_search_for_masked_stores_finds_stores_only():
    assert MASKED_STORE.search("\tvpmaskmovd\t%ymm6, %ymm2, 32(%rcx)\n")
    assert not MASKED_STORE.search("\tvmaskmovps\t(%r8,%r9,4), %ymm3, %ymm3\n")


@pytest.mark.parametrize("name", sorted(DEPTH_KERNELS | STENCIL_KERNELS))
def test_no_store_is_masked(kernels, name):
    """AMD processors take a dozen cycles for one."""
    assert not MASKED_STORE.search(kernels[name])


def add(a, b):
    """Add an array to another one."""
    for n in range(len(a)):
        a[n] += b[n]


FLOATS = numba.types.float32[::1]


@pytest.mark.skipif(
    not llvm.get_host_cpu_features().get("avx512vl") or llvm.get_host_cpu_name() in parts.SLOWED_DOWN,
    reason="the processor has no vectors of 64 bytes, or is slower with them",
)
def test_wide_kernels_use_vectors_of_64_bytes():
    assert "%zmm" in machine_code(add, (FLOATS, FLOATS), decorator=wide_kernel)


def test_wide_kernels_compute_the_same():
    a, b = np.arange(100, dtype=np.float32), np.linspace(0, 1, 100, dtype=np.float32)
    expected = a + b
    wide_kernel(add)(a, b)
    assert (a == expected).all()


def test_processors_that_run_slower_with_wide_vectors_get_short_ones(monkeypatch):
    module = llvm.parse_assembly(
        "define i32 @one(i32 %x) {\n  ret i32 1\n}\ndeclare i32 @two(i32)\n"
        "define i32 @three() unnamed_addr noinline {\n  ret i32 3\n}\n"
    )
    monkeypatch.setattr(parts, "SLOWED_DOWN", {llvm.get_host_cpu_name()})
    assert parts.with_wide_vectors(module) is module
    monkeypatch.setattr(parts, "SLOWED_DOWN", set())
    text = str(parts.with_wide_vectors(module))
    assert text.count("attributes #") == text.count('"prefer-vector-width"="512"') == 2  # of one and of three
    assert re.search(r"define i32 @one\(i32 %x\) #\d", text)
    assert re.search(r"define i32 @three\(\) unnamed_addr #\d", text)
