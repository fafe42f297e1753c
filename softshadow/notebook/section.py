"""A section through light, casters and receivers, as on the blackboard."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from softshadow.notebook.cells import new_axes
from softshadow.notebook.descriptions import describe_axes
from softshadow.notebook.extra import needed
from softshadow.report import CrossSection, cross_section
from softshadow.report.cross_section_svg import CASTER, LIGHT, MARGIN, RAY, RECEIVER, VOLUME
from softshadow.runs import Run
from softshadow.scene import Scene
from softshadow.space.shadow_parts import scene_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ARROW = 0.35  # length of the arrow of a light at infinity, as a share of the picture's height


def show_section(
    source: Run | Scene | CrossSection | str,
    pixel: tuple[int, int] | None = None,
    *,
    light: str | None = None,
    size: tuple[int, int] | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Show a section through a light and the middle of the casters, or through a light, the eye and a pixel.

    Outlines of casters are filled, receivers are the darker the less of the light they see, sides of shadow volumes are
    blue. The line of sight to the pixel has the count behind each crossing. The unit is that of the scene, and the
    light is at the origin.

    Parameters
    ----------
    source : Run, Scene, CrossSection or str     the name of a scene
    pixel : (x, y)               of the run's picture, or of a picture of the scene of this `size`
    light : str                  name; the first one by default
    size : (width, height)       of the picture that the pixel is in; that of the run, or 640 x 480
    ax : Axes                    matplotlib axes to draw in; new ones by default

    Returns
    -------
    Axes

    Raises
    ------
    ValueError                   the pixel is outside the picture or shows no surface, or there is no such light
    ImportError                  matplotlib is not installed
    """
    if isinstance(source, CrossSection):
        section = source
    elif isinstance(source, Run):
        section = cross_section(scene_of(source), pixel, size or source.size, light)
    else:
        section = cross_section(source, pixel, size or (640, 480), light)
    low, high = _bounds(section)
    width, height = high - low
    ax = new_axes(ax, "show_section", min(1.2, max(0.4, height / width)))
    lines = needed("matplotlib.collections", "show_section").LineCollection
    _draw_volumes(ax, section, lines)
    for thing in section.scene.objects:
        _draw_object(ax, section, thing.name, thing.receives, lines)
    _draw_light(ax, section, low, high)
    if section.eye is not None and section.point is not None:
        _draw_sight(ax, section)
    through = f"the eye and pixel {tuple(pixel)}" if pixel is not None else "the middle of the casters"
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    ax.set_title(f"Section of {section.scene.name} through {section.light.name} and {through}", fontsize="medium")
    describe_axes(ax, section.describe())
    return ax


def _bounds(section: CrossSection) -> tuple[np.ndarray, np.ndarray]:
    """Return the corners of what is drawn, with a margin; volumes go beyond them."""
    points = [line for lines in section.outlines.values() for line in lines]
    if section.light.position[3]:
        points.append(section.ends)
    points += [place[None] for place in (section.eye, section.point) if place is not None]
    every = np.concatenate(points)
    margin = MARGIN * float(np.ptp(every, axis=0).max())
    return every.min(axis=0) - margin, every.max(axis=0) + margin


def _draw_volumes(ax: Axes, section: CrossSection, lines: Any) -> None:
    if (section.ends[0] != section.ends[1]).any():
        for edge, a, b in section.wedges:
            ax.fill(*np.stack([edge, a, b]).T, color=VOLUME, alpha=0.08, linewidth=0)
    ax.add_collection(lines(section.sides, colors=VOLUME, linewidths=1.2, label="sides of volumes"))


def _draw_object(ax: Axes, section: CrossSection, name: str, receives: bool, lines: Any) -> None:
    for line in section.outlines[name]:
        if not receives and len(line) > 2:
            ax.fill(*line.T, facecolor=CASTER, alpha=0.25)
        ax.plot(*line.T, color=RECEIVER if receives else CASTER, linewidth=1.5)
    if receives and (strips := section.strips(name)):
        shades = [(share, share, share) for share in (0.15 + 0.8 * share for _, share in strips)]
        ax.add_collection(lines([piece for piece, _ in strips], colors=shades, linewidths=5, zorder=1.5))


def _draw_light(ax: Axes, section: CrossSection, low: np.ndarray, high: np.ndarray) -> None:
    if section.light.position[3]:
        ax.plot(*section.ends.T, color=LIGHT, linewidth=4, solid_capstyle="round")
        ax.plot(*section.center, "o", color=LIGHT)
        place = section.center
    else:
        direction = section.center / np.linalg.norm(section.center)
        reach = float((high - low).min())
        place = (low + high) / 2 + direction * 0.45 * reach
        head = place - ARROW * reach * direction
        ax.annotate("", xy=tuple(head), xytext=tuple(place), arrowprops={"color": LIGHT, "arrowstyle": "->"})
    label(ax, place, section.light.name, LIGHT)


def _draw_sight(ax: Axes, section: CrossSection) -> None:
    """Draw the line of sight with the counts behind each crossing."""
    assert section.eye is not None
    assert section.point is not None
    ax.plot(*np.stack([section.eye, section.point]).T, color=RAY, linewidth=1.2)
    for place, words in ((section.eye, "eye"), (section.point, "P")):
        ax.plot(*place, "o", color=RAY, markersize=5)
        label(ax, place, words, RAY)
    for number, crossing in enumerate(section.crossings):
        ax.plot(*crossing.place, "o", color=RAY, markersize=4)
        words = f"{crossing.step:+d} = {crossing.count}".replace("-", "−")
        label(ax, crossing.place, words, RAY, below=number % 2 == 0)  # neighbours on different sides


def label(ax: Axes, place: np.ndarray, words: str, color: str, below: bool = False) -> None:
    """Write words to the right of a place, above or below it."""
    by = (5, -13 if below else 5)
    ax.annotate(words, tuple(place), xytext=by, textcoords="offset points", color=color, clip_on=True)
