"""Queued matrix operations have the bits of the functions of `softshadow.matrices`, carried out one by one."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from softshadow import gl, matrices
from softshadow.context import MatrixStack, matrix_products, matrix_stacks
from softshadow.context.matrix_kinds import derived_kind
from softshadow.jit import read_only
from softshadow.programs.inverse import known_kind

LIMIT = 6
# numbers that overflow, vanish or have no value
WILD = (0.0, -0.0, 1.0, 90.0, -180.0, 1e-5, 1e-30, 1e-46, 3e38, 1e300, -1e300, np.inf, -np.inf, np.nan)
COUNTS = {
    "translate": 3, "scale": 3, "rotate": 4, "look_at": 9, "perspective": 4, "frustum": 6, "ortho": 6, "load": 16,
    "multiply": 16, "load_identity": 0,
}  # fmt: skip


def numbers(rng: np.random.Generator, count: int) -> list[float]:
    """Ordinary numbers, now and then integers, coordinate axes, equal numbers or wild ones."""
    values = rng.uniform(-3, 3, count)
    if rng.random() < 0.3:
        values = np.round(values)
    if rng.random() < 0.1:
        values[:] = values[:1]
    if rng.random() < 0.2:
        values[1:] *= rng.integers(0, 2, len(values[1:]))
    if rng.random() < 0.1:
        values[rng.random(count) < 0.3] = rng.choice(WILD)
    return values.tolist()


def expected_product(base: np.ndarray, name: str, values: list[float]) -> np.ndarray:
    """The matrix after an operation, by the textbook."""
    real: Any = base.dtype.type
    if name in ("translate", "scale"):
        return getattr(matrices, name)(base, *values)
    if name == "look_at":
        return matrices.look_at(base, values[:3], values[3:6], values[6:])
    if name in ("load", "multiply"):
        matrix = np.array(values, real).reshape(4, 4).T
        return matrix if name == "load" else matrices.multiply(base, matrix)
    if name == "load_identity":
        return np.eye(4, dtype=real)
    makers = {"rotate": matrices.rotation, "perspective": matrices.perspective}
    maker: Any = makers.get(name) or getattr(matrices, name)
    return matrices.multiply(base, maker(*values, real=real))


def is_same(a: np.ndarray, b: np.ndarray) -> bool:
    """Whether all elements have the same bits; one NaN is as good as another."""
    return bool((np.array_equal(a, b, equal_nan=True)) and (np.signbit(a) == np.signbit(b))[~np.isnan(a)].all())


@pytest.mark.parametrize("real", [np.float32, np.float64])
@pytest.mark.parametrize("seed", range(6))
@np.errstate(all="ignore")
def test_queued_operations_are_those_of_the_textbook(seed, real, monkeypatch):
    for few in ("FEW_TO_LOAD", "FEW_TO_COMPILE"):  # compiled from the second computation on
        monkeypatch.setattr(f"softshadow.context.matrix_stacks.{few}", 0)
    rng = np.random.default_rng(seed)
    stack, expected = MatrixStack(LIMIT, real), [np.eye(4, dtype=real)]
    for _ in range(400):
        name = rng.choice(["push", "pop", "read", *COUNTS])
        if name == "push" and len(stack) < LIMIT:
            expected.append(expected[-1])
            stack.push()
        elif name == "pop" and len(stack) > 1:
            expected.pop()
            stack.pop()
        elif name == "read":
            index = int(rng.integers(-len(stack), 0))
            assert is_same(stack[index], expected[index])
        elif name in COUNTS:
            values = numbers(rng, COUNTS[name])
            try:
                expected[-1] = expected_product(expected[-1], name, values)
            except (ZeroDivisionError, ValueError, OverflowError):  # which the calls refuse
                continue
            values_or_matrix: Any = values
            if name in ("load", "multiply"):
                values_or_matrix = [np.array(values, real).reshape(4, 4).T]
            getattr(stack, name)(*values_or_matrix)
    for index in range(-len(stack), 0):
        assert is_same(stack[index], expected[index])


def test_compiled_products_are_those_of_the_textbook_on_a_long_queue():
    rng = np.random.default_rng(1)
    queue: list[float] = []
    for code in rng.integers(2, len(matrix_products.SIZES), 60).tolist():
        queue += [code, *rng.uniform(-1, 1, matrix_products.SIZES[code] - 1).tolist()]
    levels = [np.tile(np.eye(4, dtype=np.float32), (2, 1, 1)) for _ in range(2)]
    for carry_out, matrix in zip(
        (matrix_products.carry_out, matrix_products.carry_out_by_textbook), levels, strict=True
    ):
        assert carry_out(np.array(queue), len(queue), matrix, 0) == 0
    assert levels[0].tobytes() == levels[1].tobytes()


def test_a_full_queue_loses_nothing():
    stack = MatrixStack(LIMIT, np.float32)
    for _ in range(1000):
        stack.translate(1, 0, 0)
        stack.push()
        stack.translate(0, 1, 0)
        stack.pop()
    assert stack.current[:, 3].tolist() == [1000, 0, 0, 1]


def test_a_matrix_stays_the_same_object_until_it_changes():
    stack = MatrixStack(LIMIT, np.float32)
    stack.translate(1, 2, 3)
    matrix = stack.current
    assert stack.current is matrix
    assert not matrix.flags.writeable
    stack.push()
    assert stack.current is matrix
    stack.scale(2, 2, 2)
    assert stack.current is not matrix
    stack.pop()
    assert stack.current is matrix


def test_kinds_are_those_of_the_calls_and_unknown_ones_are_derived():
    stack = MatrixStack(LIMIT, np.float32)
    stack.look_at(3, 2, 4, 0, 0, 0, 0, 1, 0)
    stack.push()
    assert stack.kind == known_kind(stack.current)
    stack.scale(1, 2, 3)
    stack.pop()
    assert stack.kind == known_kind(stack.current)


@given(st.integers(0, 2**32 - 1))
def test_the_compiled_kind_of_a_matrix_is_that_of_the_textbook(seed):
    rng = np.random.default_rng(seed)
    for _ in range(20):
        matrix = np.eye(4, dtype=np.float32)
        with np.errstate(all="ignore"):
            for call in rng.choice(["translate", "scale", "rotate", "look_at", "load", "multiply"], rng.integers(4)):
                matrix = expected_product(matrix, call, numbers(rng, COUNTS[call]))
        matrix = np.array(matrix, np.float32)
        if rng.random() < 0.3:  # near the limits at which a matrix no longer counts as a rotation
            matrix[:3, :3] += rng.normal(0, 1e-6, (3, 3)) * rng.integers(0, 2, (3, 3))
        if rng.random() < 0.3:
            matrix[rng.integers(2, 4)] = np.eye(4)[rng.integers(2, 4)]
        assert derived_kind(read_only(matrix)) == known_kind(matrix)


@pytest.mark.parametrize("call", [gl.glTranslatef, gl.glScalef, gl.glRotatef])
def test_what_is_not_a_number_is_refused_at_once(call):
    with gl.create_context(4, 4):
        with pytest.raises((TypeError, ValueError)):
            call(*["one"] * (4 if call is gl.glRotatef else 3))
        assert np.array_equal(gl.glGetFloatv(gl.GL_MODELVIEW_MATRIX), np.eye(4))


@pytest.mark.parametrize(("is_on_disk", "few"), [(True, "FEW_TO_LOAD"), (False, "FEW_TO_COMPILE")])
@pytest.mark.skipif(not hasattr(matrix_products.carry_out, "py_func"), reason="kernels are interpreted")
def test_compiled_code_multiplies_as_soon_as_it_pays(is_on_disk, few, monkeypatch):
    stack = MatrixStack(LIMIT, np.float32)
    monkeypatch.setattr(
        matrix_stacks, "MATRIX_KERNELS", SimpleNamespace(are_compiled=lambda: is_on_disk, note_compiled=list)
    )
    bytes_of_translation = 4 * matrix_stacks.NUMBER
    for n in range(1, getattr(matrix_stacks, few) // bytes_of_translation + 2):
        stack.translate(1.0, 0.0, 0.0)
        assert stack.current[0, 3] == n
        is_enough = n * bytes_of_translation >= getattr(matrix_stacks, few)
        assert (stack._carry_out is matrix_products.carry_out) == is_enough
