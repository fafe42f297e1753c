"""One sentence about a pixel: lit, in shadow or background, and the fragment that decided it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from softshadow.context import Frame
from softshadow.inspection.causes import Cause, and_list, cause_of, surface_row
from softshadow.inspection.history import PixelHistory
from softshadow.inspection.history_row import CLEARED, CLIPPED, CULLED, HistoryRow
from softshadow.inspection.lookup_words import lookup_words
from softshadow.inspection.surface_point import SurfacePoint, surface_point
from softshadow.inspection.timeline import timeline_of
from softshadow.scene import Light, Scene
from softshadow.truth import casting_faces_between

LIT = 1 - 1e-6  # a mean over lights or taps is rounded


def explain(
    history: PixelHistory,
    visibility: float | None,
    valid: bool,
    lights: Mapping[str, float] | None = None,
    causes: Sequence[Cause] = (),
) -> str:
    """Return why a pixel is lit, partly lit or in shadow, with the step, the object and the test that decided it.

    Parameters
    ----------
    visibility : float or None   1 lit to 0 in shadow; None when the technique has no visibility map
    valid : bool                 whether the visibility is defined at the pixel
    lights : dict or None        the visibility of each light, by name
    causes : of the lights that are hidden, fully or in part
    """
    rows = history.rows
    if not any(row.verdict not in (CLEARED, CULLED, CLIPPED) for row in rows):
        return f"{history.heading} is background: no triangle covers it."
    surface = surface_row(rows) or next((row for row in reversed(rows) if row.verdict == "passed"), None)
    if surface is None:
        return f"{history.heading} shows no surface: no fragment passed its tests there."
    if visibility is None:
        return f"{history.heading} shows what was drawn {_described(_adding(rows, surface))}."
    if not valid:
        return f"{history.heading} has no defined visibility in this technique: {_described(surface)}."
    if visibility >= LIT:
        return f"{history.heading} is lit: {_described(_adding(rows, surface))}."
    word = "in shadow" if visibility <= 0 else f"partly lit ({visibility:.2g} of the light)"
    if lights and len(lights) > 1:
        word = _by_light(lights)
    if not causes:
        return f"{history.heading} is {word}: {_described(surface)}."
    words = {cause.light: _caused(cause, surface) for cause in causes}
    if len(set(words.values())) == 1:
        return f"{history.heading} is {word}: {words.popitem()[1]}."
    return f"{history.heading} is {word}: {'; '.join(f'{light}: {text}' for light, text in words.items())}."


def _by_light(lights: Mapping[str, float]) -> str:
    hidden = [name for name, share in lights.items() if share <= 0]
    partly = [f"partly lit by {name} ({share:.2g} of it)" for name, share in lights.items() if 0 < share < LIT]
    lit = [name for name, share in lights.items() if share >= LIT]
    parts = [f"in shadow of {and_list(hidden)}"] if hidden else []
    parts += partly + ([f"lit by {and_list(lit)}"] if lit else [])
    return and_list(parts)


def _adding(rows: Sequence[HistoryRow], surface: HistoryRow) -> HistoryRow:
    """Return the last fragment that coloured the pixel; where it was lit, that is the one that added light."""
    return next((row for row in reversed(rows) if row.color_written), surface)


def _described(row: HistoryRow) -> str:
    words = [row.reason, *(lookup_words(lookup) for lookup in row.lookups)]
    return f"in step {row.title!r} ({row.name}), {'; '.join(words)}"


def _caused(cause: Cause, surface: HistoryRow) -> str:
    """Return the words for one hidden light."""
    number = "" if surface.triangle is None else f" (triangle {surface.triangle})"
    on = f"{surface.object or 'the surface'}{number}"
    words = {
        "outside the cone": f"it is outside the cone of {cause.light}",
        "own shadow": f"own shadow, {on} is turned away from {cause.light}",
        "unseen": f"the map of {cause.light} does not decide about {on}",
    }.get(cause.kind, "")
    if not words:
        itself = surface.object in cause.casters
        words = f"cast by {and_list(cause.casters)} on {f'itself{number}' if itself else on}" if cause.casters else on
    return f"{words}: in step {cause.row.title!r}, {cause.evidence}" if cause.row and cause.evidence else words


def causes_of(frame: Frame, history: PixelHistory, scene: Scene, hidden: Mapping[str, float]) -> tuple[Cause, ...]:
    """Return why each hidden light does not reach what a pixel of the window shows, or only in part.

    Parameters
    ----------
    scene : Scene                what the frame shows, from its camera
    hidden : dict                the visibility of each light that is hidden, fully or in part, by name
    """
    surface = surface_row(history.rows)
    if surface is None:
        return ()
    point = surface_point(timeline_of(frame), surface, history.x, history.y, scene.camera)
    lights = {light.name: light for light in scene.lights}
    return tuple(_cause(history.rows, lights[name], surface, point, scene) for name in hidden if name in lights)


def _cause(
    rows: Sequence[HistoryRow], light: Light, surface: HistoryRow, point: SurfacePoint | None, scene: Scene
) -> Cause:
    cause = cause_of(rows, light.name, surface)
    if point is None:
        return cause
    if light.is_spot and not bool(light.shines_on(point.point[None])[0]):
        return replace(cause, kind="outside the cone", casters=(), evidence="", row=cause.row)
    thing = next((thing for thing in scene.casters if thing.name == surface.object), None)
    if thing is not None and point.is_turned_away(light) and light.shape is None:
        return replace(cause, kind="own shadow", casters=(thing.name,))
    if cause.kind in ("cast shadow", "unknown") and not cause.casters:
        return replace(cause, casters=casters_between(scene, light, surface, point))
    return cause


def casters_between(scene: Scene, light: Light, surface: HistoryRow, point: SurfacePoint) -> tuple[str, ...]:
    """Return which casters stand between a point and a light's centre, by ray casting; the surface's own face not."""
    names = []
    for caster in scene.casters:
        face = -1 if surface.triangle is None or caster.name != surface.object else surface.triangle
        face = face if face < len(caster.mesh.triangles) else -1
        own = np.array([min(face, 0)]), np.array([face])
        if casting_faces_between(point.point[None], light.position, [caster], exclude=own)[0] > 0:
            names.append(caster.name)
    return tuple(names)
