"""What programs of random primitives begin with, and what is looked at behind them: see the tests of joined draws."""

from typing import Any

import numpy as np

from softshadow import gl
from softshadow.pipeline.commands import Draw


def set_where_order_matters() -> None:
    """Set state under which a fragment left out, drawn twice or drawn in another order shows in a buffer."""
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_INVERT, gl.GL_INCR)
    gl.glPolygonOffset(1.0, 4.0)
    gl.glLineStipple(2, 0xA3C5)
    gl.glPolygonStipple(np.arange(128, dtype=np.uint8).tobytes())
    gl.glClipPlane(gl.GL_CLIP_PLANE0, (1.0, 0.5, 0.25, 0.5))
    gl.glBlendFunc(gl.GL_ONE, gl.GL_ONE)


def buffers_and_draws(context: Any) -> tuple[list[bytes], list[Draw]]:
    """Return the colours, depths and stencil values of a context, and the draws recorded."""
    gl.glFinish()
    window = context.storage.window
    buffers = [image.view.tobytes() for image in (window.color, window.depth, window.stencil) if image is not None]
    return buffers, [command for command in context.frame.commands if isinstance(command, Draw)]
