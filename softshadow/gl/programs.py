"""Programs and their uniforms. Programs come from the registry of `softshadow.programs`; there is no GLSL."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import programs
from softshadow import tokens as gl
from softshadow.context import Context, current
from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import fail, outside_begin
from softshadow.programs import Program
from softshadow.state import TEXTURE_UNITS

EXPECTED_PROGRAM = "expected a number returned by program(name)"
IGNORED = -1  # location of a uniform that the program does not use: setting it has no effect and is no error


def program(name: str) -> int:
    """Return the number of a registered program, for glUseProgram; the same in every call.

    Raises
    ------
    StateError
        No program of this name is registered; the message suggests a similar name.
    """
    context = current()
    for number, known in context.programs.items():
        if known.name == name:
            return number
    registered = programs.get(name)
    number = max(context.programs, default=0) + 1
    context.programs[number] = registered
    context.uniforms[number] = {key: _stored(value) for key, value in registered.uniforms.items()}
    context.uniforms[number].update({key: 0 for key in registered.samplers if key not in registered.uniforms})
    return number


def _stored(value: Any) -> Any:
    """Return a uniform's value as it is stored: numbers and tuples unchanged, matrices as read-only float32 copies."""
    if not isinstance(value, np.ndarray):
        return value
    copy = value.astype(np.float32)
    copy.setflags(write=False)
    return copy


@in_lists
def glUseProgram(program: int) -> None:
    """Use a program for the draws that follow; 0 is the fixed-function pipeline."""
    if (context := outside_begin("glUseProgram")) is None:
        return None
    if program and program not in context.programs:
        return fail(gl.GL_INVALID_VALUE, "glUseProgram", f"program={program}: {EXPECTED_PROGRAM}")
    context.change_field("", "program", int(program))
    return None


def glIsProgram(program: int) -> bool:
    """Return whether a program of this number exists."""
    context = outside_begin("glIsProgram")
    return context is not None and program in context.programs


def glGetUniformLocation(program: int, name: str | bytes) -> Any:
    """Return the location of a uniform; -1 if the program has none of this name."""
    if (context := outside_begin("glGetUniformLocation")) is None:
        return None
    if program not in context.programs:
        return fail(gl.GL_INVALID_VALUE, "glGetUniformLocation", f"program={program}: {EXPECTED_PROGRAM}")
    names = list(context.uniforms[program])
    spelled = name.decode() if isinstance(name, bytes) else name
    return names.index(spelled) if spelled in names else IGNORED


# -- setting -----------------------------------------------------------------------------------------------------------
@in_lists
def glUniform1f(location: int, v0: float) -> None:
    """Set a float uniform of the program in use."""
    _set("glUniform1f", location, [v0], "f")


@in_lists
def glUniform2f(location: int, v0: float, v1: float) -> None:
    """Set a vec2 uniform of the program in use."""
    _set("glUniform2f", location, [v0, v1], "f")


@in_lists
def glUniform3f(location: int, v0: float, v1: float, v2: float) -> None:
    """Set a vec3 uniform of the program in use."""
    _set("glUniform3f", location, [v0, v1, v2], "f")


@in_lists
def glUniform4f(location: int, v0: float, v1: float, v2: float, v3: float) -> None:
    """Set a vec4 uniform of the program in use."""
    _set("glUniform4f", location, [v0, v1, v2, v3], "f")


@in_lists
def glUniform1i(location: int, v0: int) -> None:
    """Set an int, bool or sampler uniform of the program in use; a sampler's value is a texture unit."""
    _set("glUniform1i", location, [v0], "i")


@in_lists
def glUniform2i(location: int, v0: int, v1: int) -> None:
    """Set an ivec2 uniform of the program in use."""
    _set("glUniform2i", location, [v0, v1], "i")


@in_lists
def glUniform3i(location: int, v0: int, v1: int, v2: int) -> None:
    """Set an ivec3 uniform of the program in use."""
    _set("glUniform3i", location, [v0, v1, v2], "i")


@in_lists
def glUniform4i(location: int, v0: int, v1: int, v2: int, v3: int) -> None:
    """Set an ivec4 uniform of the program in use."""
    _set("glUniform4i", location, [v0, v1, v2, v3], "i")


@in_lists
def glUniform1fv(location: int, count: int, value: Any) -> None:
    """Set a float uniform of the program in use from an array."""
    _set_array("glUniform1fv", location, count, value, 1, "f")


@in_lists
def glUniform2fv(location: int, count: int, value: Any) -> None:
    """Set a vec2 uniform of the program in use from an array."""
    _set_array("glUniform2fv", location, count, value, 2, "f")


@in_lists
def glUniform3fv(location: int, count: int, value: Any) -> None:
    """Set a vec3 uniform of the program in use from an array."""
    _set_array("glUniform3fv", location, count, value, 3, "f")


@in_lists
def glUniform4fv(location: int, count: int, value: Any) -> None:
    """Set a vec4 uniform of the program in use from an array."""
    _set_array("glUniform4fv", location, count, value, 4, "f")


@in_lists
def glUniform1iv(location: int, count: int, value: Any) -> None:
    """Set an int, bool or sampler uniform of the program in use from an array."""
    _set_array("glUniform1iv", location, count, value, 1, "i")


@in_lists
def glUniform2iv(location: int, count: int, value: Any) -> None:
    """Set an ivec2 uniform of the program in use from an array."""
    _set_array("glUniform2iv", location, count, value, 2, "i")


@in_lists
def glUniform3iv(location: int, count: int, value: Any) -> None:
    """Set an ivec3 uniform of the program in use from an array."""
    _set_array("glUniform3iv", location, count, value, 3, "i")


@in_lists
def glUniform4iv(location: int, count: int, value: Any) -> None:
    """Set an ivec4 uniform of the program in use from an array."""
    _set_array("glUniform4iv", location, count, value, 4, "i")


@in_lists
def glUniformMatrix4fv(location: int, count: int, transpose: bool, value: Any) -> None:
    """Set a mat4 uniform of the program in use from 16 floats in column order; with `transpose`, in row order."""
    operation = "glUniformMatrix4fv"
    numbers = np.asarray(value, np.float32).reshape(-1)
    if count == 1 and len(numbers) != 16:
        raise ValueError(f"{operation}: value has {len(numbers)} numbers, expected 16")
    uniform = _uniform(operation, location, count)
    if uniform is None:
        return None
    context, name, current_value = uniform
    if np.shape(current_value) != (4, 4):
        return fail(gl.GL_INVALID_OPERATION, operation, f"uniform {name!r} is {described(current_value)}, not a mat4")
    matrix = numbers.reshape(4, 4)
    context.uniforms[context.state.program][name] = _stored(matrix if transpose else matrix.T.copy())
    return None


def _set_array(operation: str, location: int, count: int, value: Any, size: int, kind: str) -> None:
    numbers = np.ravel(value)
    if count == 1 and len(numbers) < size:
        raise ValueError(f"{operation}: value has {len(numbers)} numbers, count=1 needs {size}")
    _set(operation, location, list(numbers[:size]), kind, count)


def _set(operation: str, location: int, numbers: list[Any], kind: str, count: int = 1) -> None:
    uniform = _uniform(operation, location, count)
    if uniform is None:
        return None
    context, name, current_value = uniform
    used = context.programs[context.state.program]
    if problem := _type_problem(used, name, current_value, len(numbers), kind):
        return fail(gl.GL_INVALID_OPERATION, operation, problem)
    if name in used.samplers and not 0 <= numbers[0] < TEXTURE_UNITS:
        return fail(
            gl.GL_INVALID_VALUE, operation, f"{name}={numbers[0]}: a sampler takes a unit, 0 to {TEXTURE_UNITS - 1}"
        )
    if isinstance(current_value, bool):
        value: Any = bool(numbers[0])
    else:
        converted = [float(np.float32(n)) if kind == "f" else int(n) for n in numbers]
        value = tuple(converted) if isinstance(current_value, tuple) else converted[0]
    context.uniforms[context.state.program][name] = value
    return None


def _uniform(operation: str, location: int, count: int) -> tuple[Context, str, Any] | None:
    """Return (context, name of the uniform, its current value); None after an error or for the ignored location."""
    if (context := outside_begin(operation)) is None:
        return None
    used = context.state.program
    if used == 0:
        return fail(gl.GL_INVALID_OPERATION, operation, "no program is in use")
    if count < 0:
        return fail(gl.GL_INVALID_VALUE, operation, f"count={count}: expected 0 or more")
    if location == IGNORED:
        return None
    names = list(context.uniforms[used])
    if not 0 <= location < len(names):
        return fail(gl.GL_INVALID_OPERATION, operation, f"location={location}: expected 0 to {len(names) - 1}")
    if count > 1:
        return fail(
            gl.GL_INVALID_OPERATION, operation, f"count={count}: expected 1 for {names[location]!r}, not an array"
        )
    context.flush()
    return (context, names[location], context.uniforms[used][names[location]]) if count else None


def _type_problem(used: Program, name: str, current_value: Any, size: int, kind: str) -> str | None:
    shape = np.shape(current_value)
    first = np.asarray(current_value).dtype.kind
    allowed = {"b": "fi", "f": "f", "i": "i"}[first]
    if shape == ((size,) if size > 1 else ()) and kind in allowed:
        return None
    got = f"{size} {'float' if kind == 'f' else 'int'}{'s' if size > 1 else ''}"
    return f"uniform {name!r} is {'a sampler' if name in used.samplers else described(current_value)}, got {got}"


def described(value: Any) -> str:
    """Return the GLSL type of a uniform's value, with an article."""
    shape, kind = np.shape(value), np.asarray(value).dtype.kind
    if len(shape) == 2:
        return f"a mat{shape[0]}"
    scalar, prefix = {"b": ("a bool", "b"), "i": ("an int", "i"), "f": ("a float", "")}[kind]
    return f"a {prefix}vec{shape[0]}" if shape else scalar


# -- queries -----------------------------------------------------------------------------------------------------------
def glGetUniformfv(program: int, location: int, params: Any = None) -> Any:
    """Return a uniform's value: a float, an array (n,), or a matrix (4, 4) in column order."""
    return _get("glGetUniformfv", program, location, params, np.float32)


def glGetUniformiv(program: int, location: int, params: Any = None) -> Any:
    """Return a uniform's value: an int or an array (n,)."""
    return _get("glGetUniformiv", program, location, params, np.int32)


def _get(operation: str, program: int, location: int, params: Any, dtype: type[np.generic]) -> Any:
    if (context := outside_begin(operation)) is None:
        return None
    if program not in context.programs:
        return fail(gl.GL_INVALID_VALUE, operation, f"program={program}: {EXPECTED_PROGRAM}")
    values = list(context.uniforms[program].values())
    if not 0 <= location < len(values):
        return fail(gl.GL_INVALID_OPERATION, operation, f"location={location}: expected 0 to {len(values) - 1}")
    value = np.asarray(values[location])
    answer = (np.rint(value) if dtype == np.int32 else value).astype(dtype).T.copy()
    if params is not None:
        np.asarray(params).reshape(-1)[: answer.size] = answer.reshape(-1)
    return answer if answer.ndim else answer.item()


__all__ = [*spelled_like_gl(globals()), "program"]
