"""What a random program did, call by call: its state and its commands, to be compared with that of another one."""

from collections.abc import Container
from dataclasses import replace
from typing import Any

import numpy as np

from softshadow import gl
from softshadow.context import Primitive
from softshadow.pipeline.commands import Draw, Vertices
from softshadow.programs.reflectances import followed
from softshadow.state import BLACK, State

SIZE = (16, 12)
Call = tuple[str, tuple[Any, ...]]


def bits(value: Any) -> Any:
    """A value that is equal for equal bits."""
    if isinstance(value, np.ndarray):
        return value.dtype.str, value.shape, value.tobytes(), value.strides[:1] == (0,)
    if isinstance(value, Draw):  # a draw takes a colour that materials follow from its vertices
        value = value._replace(state=without_followed_colors(value.state))
        if value.indices is not None:  # vertices that a list has joined stand in the order of the calls
            value = value._replace(vertices=in_order(value.vertices, value.indices), indices=len(value.indices))
    if isinstance(value, tuple | list):  # as draws and vertices are
        return [bits(each) for each in value]
    if isinstance(value, dict):
        return {key: bits(each) for key, each in value.items()}
    return repr(value)


def in_order(vertices: Vertices, indices: np.ndarray) -> Vertices:
    """The vertices that indices name, one after the other."""

    def named(array: np.ndarray) -> np.ndarray:
        return np.broadcast_to(array[0], (len(indices), *array.shape[1:])) if not array.strides[0] else array[indices]

    return Vertices(
        named(vertices.position),
        named(vertices.color),
        named(vertices.normal),
        tuple(map(named, vertices.texcoords)),
        {name: named(array) for name, array in vertices.materials.items()},
        *(None if array is None else named(array) for array in vertices[5:]),  # edge flags and others
    )


def without_followed_colors(state: State) -> State:
    """The state with black material colours where they follow glColor."""
    lighting, sides = state.lighting, {}
    for side in ("front", "back"):
        black: Any = dict.fromkeys(followed(lighting, side), BLACK)
        sides[side] = replace(getattr(lighting, side), **black)
    return replace(state, lighting=replace(lighting, front=sides["front"], back=sides["back"]))


def not_counted(primitive: Primitive | None) -> int:
    """The number of vertices of an open primitive that the buffer has not counted yet: it does so when it must."""
    return 0 if primitive is None or primitive.from_list else len(primitive) - primitive.counted


def what_happened(calls: list[Call], precision: str, looks_after: Container[int] | None = None) -> list[Any]:
    """The commands of a program, and the state after each call, or only after those with certain numbers."""
    seen: list[Any] = []
    with gl.create_context(*SIZE, precision=precision) as context:
        for number, (name, arguments) in enumerate(calls):
            try:
                answer = getattr(gl, name)(*arguments)
                seen.append((name, None if answer is None else bits(np.asarray(answer))))
            except Exception as error:
                seen.append((name, type(error).__name__, str(error)))
            if looks_after is not None and number not in looks_after:
                continue
            buffer, pending = context.vertex_buffer, context.pending
            seen.append(
                bits(
                    [
                        context.current.color,
                        context.current.normal,
                        context.current.texcoords,
                        context.state,
                        context.touched,
                        sorted(pending.names),
                        pending.old_values,
                        pending.hidden,
                        pending.reset_due,
                        sorted(buffer.sizes.items()),
                        sorted(buffer.active_sizes.items()),
                        buffer.n_vertices + not_counted(context.primitive),
                        buffer.used_bytes,
                        buffer.pairs,
                        buffer.driver_draw,
                        buffer.joined_pairs is None,
                        context.error,
                        context.primitive is None,
                        len(context.stream.frame.commands) + len(context.stream.late.draws),
                    ]
                )
            )
        if context.primitive is not None:
            gl.glEnd()
        context.flush()
        seen += [(type(command).__name__, bits(command)) for command in context.stream.frame.commands]
        images = context.storage.window.attachments.values()
        return [*seen, *(image.image.view.tobytes() for image in images)]
