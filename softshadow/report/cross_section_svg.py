"""The drawing of a cross-section as SVG: what the blackboard shows, with the counts along a line of sight."""

from __future__ import annotations

import os
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from softshadow.inspection.files import MARK, write_whole
from softshadow.report.cross_sections import CrossSection

WIDTH = 720  # of the drawing, in CSS pixels
MARGIN = 0.06  # round what is drawn, as a share of its size
LIGHT, CASTER, RECEIVER, VOLUME, RAY = "#b8860b", "#7a4a2b", "#888888", "#1f4e9c", "#b3261e"
STYLE = (
    "text{font:13px system-ui,sans-serif;fill:#222;paint-order:stroke;stroke:#fff;stroke-width:3px}"
    f".caster{{fill:{CASTER};fill-opacity:.25;stroke:{CASTER};stroke-width:1.5}}"
    f".receiver{{fill:none;stroke:{RECEIVER};stroke-width:1.5}}"
    f".volume{{stroke:{VOLUME};stroke-width:1.5}} .wedge{{stroke:{VOLUME};stroke-width:1;stroke-dasharray:5 4}}"
    f".wedge-area{{fill:{VOLUME};fill-opacity:.08}} .light{{stroke:{LIGHT};stroke-width:5;stroke-linecap:round}}"
    f".ray{{stroke:{RAY};stroke-width:1.5}} .mark{{fill:{RAY}}} .lamp{{fill:{LIGHT}}}"
)


def svg_and_words(section: CrossSection) -> tuple[str, dict[str, str]]:
    """Return what a notebook displays: the SVG, and what it shows in words as metadata."""
    return svg_of(section), {"alt": section.describe()}


def save_svg(section: CrossSection, path: str | os.PathLike[str], force: bool = False) -> Path:
    """Write the drawing of a section to a file, and return its path.

    Raises
    ------
    ValueError                   a name that does not end in .svg
    SoftShadowError              a file exists that this package did not write (`force` overwrites it), or the place
                                 cannot be written; no half-written file is left
    """
    target = Path(path)
    if target.suffix.lower() != ".svg":
        raise ValueError(f"{path}: expected a name that ends in .svg")
    return write_whole(target, lambda file: file.write_text(svg_of(section), encoding="utf-8"), force)


def svg_of(section: CrossSection) -> str:
    """Return the drawing of a section as SVG text."""
    return _Drawing(section).text()


class _Drawing:
    """One drawing: world units of the section to CSS pixels, y downwards."""

    def __init__(self, section: CrossSection) -> None:
        self.section = section
        points = [line for lines in section.outlines.values() for line in lines]
        if section.light.position[3]:
            points.append(section.ends)
        points += [place[None] for place in (section.eye, section.point) if place is not None]
        every = np.concatenate(points)
        size = float(np.ptp(every, axis=0).max())
        self.low = every.min(axis=0) - MARGIN * size
        self.high = every.max(axis=0) + MARGIN * size
        self.scale = WIDTH / float(self.high[0] - self.low[0])
        self.height = self.scale * float(self.high[1] - self.low[1])
        self.root = ElementTree.Element(
            "svg",
            {
                "xmlns": "http://www.w3.org/2000/svg",
                "viewBox": f"0 0 {WIDTH} {self.height:.1f}",
                "width": str(WIDTH),
                "role": "img",
                "style": "max-width:100%;height:auto",
            },
        )

    def text(self) -> str:
        """Return the drawing."""
        section = self.section
        self._add("title", text=f"Cross-section of scene {section.scene.name} through {section.light.name}")
        self._add("desc", text=f"{self._description()} ({MARK})")
        self._add("style", text=STYLE)
        self._add("rect", width="100%", height="100%", fill="#fff")
        if (section.ends[0] != section.ends[1]).any():
            for edge, a, b in section.wedges:
                self._path([edge, a, b, edge], "wedge-area")
                self._line(edge, a, "wedge")
                self._line(edge, b, "wedge")
        for near, far in section.sides:
            self._line(near, far, "volume")
        for thing in section.scene.objects:
            flat = thing.receives
            for line in section.outlines[thing.name]:
                self._path(line, "receiver" if flat else "caster")
            if flat:
                self._shade(thing.name)
        self._light()
        if section.eye is not None and section.point is not None:
            self._sight(section.eye, section.point)
        return ElementTree.tostring(self.root, encoding="unicode")

    def _description(self) -> str:
        section = self.section
        casters = ", ".join(thing.name for thing in section.scene.casters if section.outlines[thing.name])
        words = f"The light {section.light.name}, the objects cut by the plane ({casters}) and their shadow volumes."
        if section.point is not None:
            counts = ", ".join(f"{crossing.step:+d} at {crossing.caster}" for crossing in section.crossings)
            words += f" Along the line of sight: {counts or 'no volume is crossed'}."
        return words

    def _shade(self, name: str) -> None:
        """Draw the receiver's outline as a band, the darker the less of the light it sees."""
        for (a, b), share in self.section.strips(name):
            shade = round(40 + 200 * share)
            x0, y0, x1, y1 = *self._at(a), *self._at(b)
            self._add(
                "line", x1=f"{x0:.1f}", y1=f"{y0 + 4:.1f}", x2=f"{x1:.1f}", y2=f"{y1 + 4:.1f}",
                stroke=f"rgb({shade},{shade},{shade})", **{"stroke-width": "7"},
            )  # fmt: skip

    def _light(self) -> None:
        section = self.section
        if not section.light.position[3]:
            direction = section.center / np.linalg.norm(section.center)
            start = (self.low + self.high) / 2 + direction * 0.45 * float(self.high[1] - self.low[1])
            self._line(start, start - direction * 0.2 * float(self.high[1] - self.low[1]), "light")
            self._label(start, section.light.name)
            return
        self._line(section.ends[0], section.ends[1], "light")
        x, y = self._at(section.center)
        self._add("circle", cx=f"{x:.1f}", cy=f"{y:.1f}", r="5", **{"class": "lamp"})
        self._label(section.center, section.light.name)

    def _sight(self, eye: np.ndarray, point: np.ndarray) -> None:
        """Draw the line of sight with the counts behind each crossing."""
        self._line(eye, point, "ray")
        for place, words in ((eye, "eye"), (point, "P")):
            x, y = self._at(place)
            self._add("circle", cx=f"{x:.1f}", cy=f"{y:.1f}", r="4", **{"class": "mark"})
            self._label(place, words)
        for crossing in self.section.crossings:
            x, y = self._at(crossing.place)
            self._add("circle", cx=f"{x:.1f}", cy=f"{y:.1f}", r="3", **{"class": "mark"})
            self._label(crossing.place, f"{crossing.step:+d}".replace("-", "−") + f" = {crossing.count}")

    def _at(self, place: np.ndarray) -> tuple[float, float]:
        return float(self.scale * (place[0] - self.low[0])), float(self.scale * (self.high[1] - place[1]))

    def _line(self, a: np.ndarray, b: np.ndarray, kind: str) -> None:
        (x1, y1), (x2, y2) = self._at(a), self._at(b)
        self._add("line", x1=f"{x1:.1f}", y1=f"{y1:.1f}", x2=f"{x2:.1f}", y2=f"{y2:.1f}", **{"class": kind})

    def _path(self, places: list[np.ndarray] | np.ndarray, kind: str) -> None:
        corners = " L".join(f"{x:.1f} {y:.1f}" for x, y in map(self._at, places))
        self._add("path", d=f"M{corners}", **{"class": kind})

    def _label(self, place: np.ndarray, words: str) -> None:
        x, y = self._at(place)
        self._add("text", x=f"{min(x + 8, WIDTH - 60):.1f}", y=f"{max(y - 8, 14):.1f}", text=words)

    def _add(self, tag: str, text: str = "", **attributes: str) -> None:
        ElementTree.SubElement(self.root, tag, attributes).text = text
