"""The ledger counts what was drawn."""

from dataclasses import replace

import pytest

from draws import draw
from inspection.recorded_frames import ALL_BUFFERS, SIZE, covering, set_groups
from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.inspection import ledger_of
from softshadow.pipeline.commands import Clear
from softshadow.state import StencilFace

pytestmark = pytest.mark.interpreted
PIXELS = SIZE[0] * SIZE[1]


def test_every_fragment_is_counted_under_its_verdict():
    context = Context(*SIZE)
    context.execute(Clear(context.state, ALL_BUFFERS))
    set_groups(context, depth=replace(context.state.depth, enabled=True))
    draw(context, context.state, covering(0.0))
    context.end_step("surface")
    face = StencilFace(zfail=gl.GL_INCR)
    set_groups(context, stencil=replace(context.state.stencil, enabled=True, front=face, back=face))
    draw(context, context.state, covering(0.5))
    draw(context, context.state, covering(-0.5))
    context.end_step("count")
    ledger = ledger_of(context.frame)
    surface, count = ledger.steps
    assert (surface.draws, surface.triangles, surface.fragments["passed"], surface.stencil_updates) == (1, 1, PIXELS, 0)
    assert (count.draws, count.triangles, count.stencil_updates) == (2, 2, PIXELS)
    assert (count.fragments["passed"], count.fragments["depth failed"]) == (PIXELS, PIXELS)
    assert (ledger.total.all_fragments, ledger.total.title) == (3 * PIXELS, "total")
    assert str(ledger).splitlines()[-1].split()[:4] == ["total", "3", "3", str(3 * PIXELS)]
