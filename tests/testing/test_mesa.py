"""Mesa's process: results, errors, and independence of successive programs."""

import functools
import importlib.util
import os
import sys
import threading
import time

import numpy as np
import pytest

from softshadow.testing import (
    EXPECTED_VERSION,
    MesaError,
    mesa,
    mesa_available,
    mesa_gl,
    mesa_reason,
    mesa_version,
    run_on_mesa,
)

SIZE = (6, 4)
GL_INVALID_ENUM = 0x0500


def clear_to_half_depth(gl):
    gl.glClearColor(0.2, 0.4, 0.6, 1.0)
    gl.glClearDepth(0.5)
    gl.glClearStencil(7)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    return "done"


def enable_nonsense(gl):
    gl.glEnable(77)


def scissored_clear(gl, rows):
    gl.glEnable(gl.GL_SCISSOR_TEST)
    gl.glScissor(0, 0, 6, rows)
    clear_to_half_depth(gl)


@pytest.mark.mesa
def test_buffers_come_back_in_buffer_units():
    result = run_on_mesa(clear_to_half_depth, SIZE)
    assert result.returned == "done"
    assert result.errors == ()
    np.testing.assert_array_equal(result.color, np.broadcast_to(np.array([51, 102, 153, 255], np.uint8), (4, 6, 4)))
    np.testing.assert_array_equal(result.depth, np.full((4, 6), 8388608, np.uint32))  # 0.5 (2^24 - 1) rounds to even
    np.testing.assert_array_equal(result.stencil, np.full((4, 6), 7, np.uint8))
    assert (result.color.dtype, result.depth.dtype, result.stencil.dtype) == (np.uint8, np.uint32, np.uint8)


@pytest.mark.mesa
def test_the_first_row_is_the_bottom_row():
    result = run_on_mesa(functools.partial(scissored_clear, rows=1), SIZE)
    assert (result.stencil[0] == 7).all()
    assert (result.stencil[1:] == 0).all()


@pytest.mark.mesa
def test_every_program_starts_in_the_initial_state():
    def state(gl):
        return (
            int(gl.glGetIntegerv(gl.GL_SCISSOR_BOX)[3]),
            bool(gl.glIsEnabled(gl.GL_SCISSOR_TEST)),
            gl.glGenTextures(1),
        )

    run_on_mesa(functools.partial(scissored_clear, rows=1), SIZE)
    result = run_on_mesa(state, SIZE)
    assert result.returned == (4, False, 1)
    assert not result.color.any()
    assert not result.stencil.any()
    assert (result.depth == 2**24 - 1).all()


@pytest.mark.mesa
def test_what_a_program_prints_does_not_disturb_the_answer():
    def talkative(gl):
        print("a line")
        os.write(1, b"another one")
        return sys.stdin.read()

    assert run_on_mesa(talkative, SIZE).returned == ""


@pytest.mark.mesa
def test_a_gl_error_is_raised_with_its_code():
    with pytest.raises(MesaError, match="glEnable: GL_INVALID_ENUM") as caught:
        run_on_mesa(enable_nonsense, SIZE)
    assert caught.value.err == GL_INVALID_ENUM


@pytest.mark.mesa
def test_a_gl_error_can_be_caught_in_the_program_and_asked_for():
    def careful(gl):
        try:
            gl.glEnable(77)
        except gl.GLError as error:
            return error.err, gl.glGetError(), gl.glGetError()

    assert run_on_mesa(careful, SIZE).returned == (GL_INVALID_ENUM, GL_INVALID_ENUM, 0)


@pytest.mark.mesa
def test_gl_errors_are_only_recorded_on_demand():
    result = run_on_mesa(enable_nonsense, SIZE, raise_errors=False)
    assert result.errors == (("glEnable", GL_INVALID_ENUM),)


@pytest.mark.mesa
def test_a_programs_own_exception_comes_back_with_its_traceback():
    def broken(gl):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine") as caught:
        run_on_mesa(broken, SIZE)
    assert "in broken" in str(caught.value.__cause__)


@pytest.mark.mesa
def test_a_program_that_leaves_a_primitive_open_does_not_disturb_the_next():
    def unfinished(gl):
        gl.glBegin(gl.GL_TRIANGLES)
        raise KeyError("mine")

    with pytest.raises(KeyError):
        run_on_mesa(unfinished, SIZE)
    with pytest.raises(MesaError, match="GL_INVALID_ENUM"):  # errors are checked again
        run_on_mesa(enable_nonsense, SIZE)


@pytest.mark.mesa
def test_a_program_that_takes_too_long_is_ended():
    with pytest.raises(MesaError, match=r"no answer within 0\.2 s"):
        run_on_mesa(lambda gl: time.sleep(30), SIZE, timeout=0.2)
    assert run_on_mesa(clear_to_half_depth, SIZE).returned == "done"


@pytest.mark.mesa
def test_a_crash_is_reported_with_its_exit_code():
    with pytest.raises(MesaError, match="exit code 3"):
        run_on_mesa(lambda gl: os._exit(3), SIZE)
    assert run_on_mesa(clear_to_half_depth, SIZE).returned == "done"


@pytest.mark.mesa
def test_sys_exit_in_a_program_is_an_error_of_the_program():
    with pytest.raises(MesaError, match="SystemExit: 5"):
        run_on_mesa(lambda gl: sys.exit(5), SIZE)


@pytest.mark.mesa
def test_what_cannot_be_sent_is_refused():
    lock = threading.Lock()
    with pytest.raises(MesaError, match="cannot be sent"):
        run_on_mesa(lambda gl: lock, SIZE)


@pytest.mark.slow  # hundreds of programs
@pytest.mark.mesa
def test_the_worker_is_replaced_after_its_share_of_programs(monkeypatch):
    monkeypatch.setattr(mesa, "PROGRAMS_PER_WORKER", 2)
    processes = [run_on_mesa(lambda gl: os.getpid(), SIZE).returned for _ in range(5)]
    assert len(set(processes)) >= 3
    assert os.getpid() not in processes


@pytest.mark.mesa
def test_softpipe_is_another_process():
    renderers = [
        run_on_mesa(lambda gl: gl.glGetString(gl.GL_RENDERER), SIZE, driver).returned
        for driver in ("llvmpipe", "softpipe")
    ]
    assert renderers[0].startswith(b"llvmpipe")
    assert renderers[1] == b"softpipe"


@pytest.mark.mesa
def test_mesas_version_is_the_expected_one_or_is_reported(record_property):
    version = mesa_version()
    record_property("mesa_version", version)
    if version != EXPECTED_VERSION:
        pytest.skip(f"Mesa {version}: comparisons report, softshadow follows {EXPECTED_VERSION}")


def test_unknown_driver_names_the_nearest():
    with pytest.raises(ValueError, match="did you mean 'llvmpipe'"):
        run_on_mesa(clear_to_half_depth, SIZE, "llvmpip")


@pytest.mark.parametrize("size", [(0, 4), (4, -1), (20000, 4)])
def test_impossible_sizes_are_refused(size):
    with pytest.raises(ValueError, match="between 1 and 16384"):
        run_on_mesa(clear_to_half_depth, size)


def test_mesa_gl_outside_a_program_is_refused():
    with pytest.raises(RuntimeError, match="run_on_mesa"):
        mesa_gl()


def test_a_missing_library_is_named_with_how_to_install_it(monkeypatch):
    monkeypatch.setattr(mesa.ctypes.util, "find_library", lambda name: None)
    mesa_reason.cache_clear()
    try:
        assert not mesa_available()
        assert "libOSMesa" in mesa_reason()
        assert "apt install libosmesa6" in mesa_reason()
        assert "pip install 'softshadow[mesa]'" in mesa_reason()
        with pytest.raises(MesaError, match="libOSMesa"):
            run_on_mesa(clear_to_half_depth, SIZE)
    finally:
        mesa_reason.cache_clear()


def test_a_missing_package_is_named(monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    mesa_reason.cache_clear()
    try:
        assert "PyOpenGL" in mesa_reason()
    finally:
        mesa_reason.cache_clear()


@pytest.mark.mesa
def test_program_that_calls_softshadow_itself_is_told_to_call_its_namespace():
    from softshadow.gl import GL_COLOR_BUFFER_BIT, glClear

    with pytest.raises(MesaError, match="must call the namespace that it gets"):
        run_on_mesa(lambda gl: glClear(GL_COLOR_BUFFER_BIT), (8, 8))


@pytest.mark.mesa
def test_returned_value_that_cannot_travel_is_told():
    with pytest.raises(TypeError, match="return value cannot be sent back"):
        run_on_mesa(lambda gl: (number for number in range(3)), (8, 8))


def test_what_is_missing_for_mesa_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    mesa.mesa_reason.cache_clear()
    try:
        with pytest.raises(MesaError, match="Mesa is not available, missing: Python package PyOpenGL, "):
            run_on_mesa(lambda gl: None, (4, 4))
    finally:
        monkeypatch.undo()
        mesa.mesa_reason.cache_clear()
