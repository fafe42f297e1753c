"""Why a fragment passed or failed, in words: the tests in GL's terms, with the numbers they compared."""

from __future__ import annotations

from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer
from softshadow.pipeline.buffers.clear import clear_depth
from softshadow.pipeline.commands import Clear
from softshadow.pipeline.raster.fragment_ops import FragmentOps
from softshadow.pipeline.records import ALPHA_FAILED, DEPTH_FAILED, SCISSORED, STENCIL_FAILED
from softshadow.state import STENCIL_OPS, Scissor, State
from softshadow.tokens import token_name

SIGNS = {
    gl.GL_LESS: "<",
    gl.GL_EQUAL: "==",
    gl.GL_LEQUAL: "<=",
    gl.GL_GREATER: ">",
    gl.GL_NOTEQUAL: "!=",
    gl.GL_GEQUAL: ">=",
}


def fragment_reason(
    state: State,
    ops: FragmentOps,
    verdict: int,
    z: tuple[float, float],
    stencil: tuple[int, int],
    alpha: int,
    colored: bool,
) -> str:
    """Return which tests led to a fragment's verdict, and what it wrote to the pixel.

    Parameters
    ----------
    z : (float, float)           window z of the fragment, and the stored one
    stencil : (int, int)         stored value before and after
    alpha : int                  0-255
    colored : bool               whether the draw writes colours
    """
    if verdict == SCISSORED:
        return outside(state.scissor)
    if verdict == ALPHA_FAILED:
        return _test("alpha test", ops.alpha_func, alpha / 255, ops.alpha_ref / 255, False) + ": discarded"
    tests = []
    if ops.stencil_test and ops.stencil_func != gl.GL_ALWAYS:
        tests.append(_stencil_test(ops, stencil[0], verdict != STENCIL_FAILED))
    if ops.depth_test and verdict != STENCIL_FAILED:
        tests.append(_test("depth test", ops.depth_func, *z, verdict != DEPTH_FAILED))
    reason = "; ".join(tests)
    if ops.stencil_test:
        event, op = {STENCIL_FAILED: ("sfail", ops.sfail), DEPTH_FAILED: ("zfail", ops.zfail)}.get(
            verdict, ("zpass", ops.zpass)
        )
        reason += f"{', so ' if reason else ''}{event} {_short(op, STENCIL_OPS)}: {_stencil_change(ops, *stencil)}"
    if verdict in (STENCIL_FAILED, DEPTH_FAILED):
        return reason if ops.stencil_test else f"{reason}: discarded"
    written = _written(state, colored, bool(ops.depth_write))
    return f"{reason}{'; ' if ops.stencil_test else ': '}{written}" if reason else f"no test: {written}"


def _written(state: State, colored: bool, depth: bool) -> str:
    """Return what a fragment that passed writes to colour and depth."""
    if colored and (state.blend.enabled or state.blend.logic_enabled):
        how = "combined bitwise" if state.blend.logic_enabled else "blended"
        return f"colour {how}, depth written" if depth else f"colour {how}"
    names = [name for name, on in (("colour", colored), ("depth", depth)) if on]
    return f"{' and '.join(names)} written" if names else "neither colour nor depth written"


def culled_reason(front: bool, state: State) -> str:
    """Return why a triangle is culled."""
    facing = "front" if front else "back"
    return f"{facing}-facing triangle, and GL_CULL_FACE is on with {token_name(state.cull.face)}: no fragment"


def cut_reason(plane: str) -> str:
    """Return why a triangle has no fragment at a pixel that it would cover."""
    where = {"near plane": "in front of the near plane", "far plane": "beyond the far plane"}
    return f"cut away by clipping: here it lies {where.get(plane, f'on the outer side of {plane}')}"


def clear_reason(command: Clear, window: Framebuffer) -> str:
    """Return what a clear writes to a pixel inside its scissor box."""
    state, written = command.state, []
    if command.mask & gl.GL_COLOR_BUFFER_BIT and any(state.color.mask):
        written.append("colour ({:g}, {:g}, {:g}, {:g})".format(*state.color.clear))
    if command.mask & gl.GL_DEPTH_BUFFER_BIT and state.depth.write and window.depth is not None:
        units = clear_depth(state.depth.clear, window.depth)
        written.append(f"depth {units / (window.depth.format.largest or 1):g}")
    if command.mask & gl.GL_STENCIL_BUFFER_BIT and window.stencil is not None:
        largest = window.stencil.format.largest
        masked = state.stencil.front.write_mask & largest
        written.append(
            f"stencil {state.stencil.clear & largest}" + (f" under mask 0x{masked:02X}" if masked != largest else "")
        )
    return "glClear: " + (", ".join(written) or "nothing, because of the masks")


def outside(box: Scissor) -> str:
    """Return that a pixel lies outside the scissor box."""
    return f"outside the scissor box x {box.x} to {box.x + box.width}, GL y {box.y} to {box.y + box.height}"


def _short(token: int, among: tuple[str, ...] = ()) -> str:
    return token_name(token, among).removeprefix("GL_")


def _test(name: str, func: int, a: float, b: float, passed: bool) -> str:
    if func not in SIGNS:
        return f"{name} {_short(func)} {'passes' if passed else 'fails'}"
    left, right = unlike(a, b)
    return f"{name} {_short(func)}: {left} {SIGNS[func]} {right} is {'true' if passed else 'false'}"


def _stencil_test(ops: FragmentOps, stored: int, passed: bool) -> str:
    if ops.stencil_func not in SIGNS:
        return _test("stencil test", ops.stencil_func, 0, 0, passed)
    masked = f" & 0x{ops.read_mask:02X}" if ops.read_mask != ops.stencil_largest else ""
    left, right = (f"({ops.ref}{masked})", f"({stored}{masked})") if masked else (str(ops.ref), str(stored))
    outcome = "true" if passed else "false"
    return f"stencil test {_short(ops.stencil_func)}: {left} {SIGNS[ops.stencil_func]} {right} is {outcome}"


def _stencil_change(ops: FragmentOps, before: int, after: int) -> str:
    mask = f" under mask 0x{ops.write_mask:02X}" if ops.write_mask != ops.stencil_largest else ""
    return f"stencil {before} -> {after}{mask}" if before != after else f"stencil stays {before}{mask}"


def unlike(a: float, b: float) -> tuple[str, str]:
    """Return two numbers with enough digits to tell them apart, at least six.

    Examples
    --------
    >>> unlike(0.5, 0.25)
    ('0.5', '0.25')
    >>> unlike(0.50000006, 0.5)
    ('0.5000001', '0.5')
    """
    for digits in range(6, 18):
        left, right = f"{a:.{digits}g}", f"{b:.{digits}g}"
        if a == b or left != right:
            break
    return left, right
