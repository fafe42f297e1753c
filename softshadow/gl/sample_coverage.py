"""glSampleCoverage: stored and returned by queries; with one sample per pixel it has no effect."""

from __future__ import annotations

from softshadow.gl.calls import in_lists, spelled_like_gl
from softshadow.gl.errors import outside_begin
from softshadow.gl.fragment_state import rounded_number


@in_lists
def glSampleCoverage(value: float, invert: bool) -> None:
    """Set which share of the samples of a pixel a fragment covers while GL_SAMPLE_COVERAGE is on."""
    if (context := outside_begin("glSampleCoverage")) is not None:
        clamped = min(max(0.0, rounded_number(context, value)), 1.0)
        context.change("color", coverage_value=clamped, coverage_inverted=bool(invert))


__all__ = spelled_like_gl(globals())
