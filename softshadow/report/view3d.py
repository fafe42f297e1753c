"""The 3-D view of a run: a page in which the line of sight of a pixel pierces the volumes, and the faces are counted.

The page is trimesh's viewer, with three.js in it, and works without a network. A script adds the line of sight with
numbered crossings. For the first pixel they are those of the pixel's history. A reader who chooses another pixel gets
crossings that the page computes from the triangles it shows. At pixels whose centre lies on an edge they may differ
from the stencil buffer, which counts by the rules of rasterization.

A page that holds a 3-D view in an iframe chooses the pixel with a message, and may pass the pixel's stencil value to
have it compared: ``frame.contentWindow.postMessage({softshadow: "pixel", x: 177, y: 97, stencil: 1}, "*")``. The view
tells when it is ready: its parent gets the message ``{softshadow: "view3d"}``.
"""

from __future__ import annotations

import base64
import html
import os
import re
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from softshadow.inspection.files import write_whole
from softshadow.report.page import environment
from softshadow.scene import Light, Scene
from softshadow.space import (
    EXTENSIONS,
    Edges,
    FaceCrossing,
    LineOfSight,
    ShadowGeometry,
    Surface,
    geometry_of_run,
    line_of_sight,
)
from softshadow.space.markers import marker
from softshadow.space.model_writing import viewer_html
from softshadow.space.pieces import Color, surface
from softshadow.space.shadow_parts import DrawnRun, light_named, scene_of
from softshadow.space.sight_lines import COUNTING

HEIGHT = 520  # of a view in a notebook, CSS pixels
RAY: Color = (0.70, 0.15, 0.12, 1.0)
# Okabe & Ito: colour-blind people can tell the two apart
UP, DOWN, UNCOUNTED = (0.84, 0.37, 0.0, 1.0), (0.0, 0.45, 0.70, 1.0), (0.5, 0.5, 0.5, 1.0)
MARKER = 0.008  # radius, as a share of the scene's size


@dataclass(frozen=True, eq=False, repr=False)
class View3D:
    """The geometry of a run, and the line of sight of a pixel; a notebook displays it.

    Attributes
    ----------
    run : Run
    geometry : ShadowGeometry    of one light
    line : LineOfSight or None   of the chosen pixel
    """

    run: DrawnRun
    light: Light
    geometry: ShadowGeometry
    line: LineOfSight | None

    @property
    def crossings(self) -> tuple[FaceCrossing, ...]:
        """The counted crossings, in the order of the count."""
        return () if self.line is None else self.line.crossings

    def save(self, path: str | os.PathLike[str], force: bool = False) -> Path:
        """Write the view to a file, and return its path.

        ``.html`` is the page; ``.glb`` and ``.ply`` are the geometry with line of sight and crossings as pieces.

        Raises
        ------
        ValueError                   another file name extension
        SoftShadowError              a file exists that this package did not write (`force` overwrites it), or the place
                                     cannot be written; no half-written file is left
        """
        if Path(path).suffix.lower() in EXTENSIONS:
            return self.geometry.with_pieces(self.pieces()).save(path, force)
        if Path(path).suffix.lower() != ".html":
            raise ValueError(f"{path}: expected a name that ends in .html, {' or '.join(EXTENSIONS)}")
        page = packed_page(view3d_page(self), self.title)
        return write_whole(Path(path), lambda file: file.write_text(page, encoding="utf-8"), force)

    @property
    def title(self) -> str:
        """What the page shows, in words."""
        return f"{self.run.technique} on {scene_of(self.run).name}: 3-D view"

    def pieces(self) -> Iterator[Surface | Edges]:
        """Yield the line of sight as edges, and each crossing as a small ball."""
        if self.line is None:
            return
        size = _extent(scene_of(self.run))
        line, end = self.line, self.far_end
        point = end if self.line.point is None else self.line.point
        yield Edges("line of sight", np.array([[line.eye, point]], np.float32), RAY)
        if self.line.point is not None:
            yield Edges("line of sight/behind the surface", np.array([[point, end]], np.float32), RAY)
        for number, crossing in enumerate((*line.crossings, *line.others), 1):
            color = UNCOUNTED if not crossing.counted else UP if crossing.change > 0 else DOWN
            what = f"{crossing.change:+d} = {crossing.count}" if crossing.counted else "not counted"
            place = end if crossing.place is None else crossing.place
            yield surface(f"crossing/{number}/{what}", marker(place, MARKER * size), color)

    @property
    def far_end(self) -> np.ndarray:
        """(3,) float64: where the line of sight is drawn to."""
        assert self.line is not None
        direction = self.line.near_point - self.line.eye
        reach = 2 * max(_extent(scene_of(self.run)), *self.geometry.distances.values())
        return np.asarray(self.line.eye + reach * direction / np.linalg.norm(direction))

    def _repr_html_(self) -> str:
        page = html.escape(packed_page(view3d_page(self), self.title), quote=True)
        style = f"width:100%;height:{HEIGHT}px;border:0"
        return f'<iframe title="{html.escape(self.title)}" srcdoc="{page}" style="{style}"></iframe>'

    def __repr__(self) -> str:
        pixel = "" if self.line is None else f", pixel {self.line.x}, {self.line.y}: {len(self.crossings)} crossings"
        return f"View3D({self.run.technique!r} on {scene_of(self.run).name!r}{pixel})"


def view3d_of(run: DrawnRun, pixel: tuple[int, int] | None = None, light: str | None = None) -> View3D:
    """Return the 3-D view of a run, with the line of sight of a pixel if one is given.

    Parameters
    ----------
    pixel : (x, y)               x from the left, y from the top
    light : str                  name; the first one by default

    Raises
    ------
    ValueError                   the pixel is outside the picture, or there is no such light
    """
    source = scene_of(run).lights[0] if light is None else light_named(scene_of(run), light)
    line = None if pixel is None else line_of_sight(run, *pixel, source.name)
    return View3D(run, source, geometry_of_run(run, source.name), line)


def view3d_document(run: DrawnRun, pixel: tuple[int, int] | None = None, light: str | None = None) -> str:
    """Return the 3-D view of a run as one HTML page of about 250 kB, to be saved or to be an iframe's `srcdoc`."""
    view = view3d_of(run, pixel, light)
    return packed_page(view3d_page(view), view.title)


def view3d_page(view: View3D) -> str:
    """Return the page of a view: trimesh's viewer, with a panel and the script that draws the line of sight."""
    page = viewer_html(view.geometry.pieces, view.geometry.scene)
    templates = environment()
    head = templates.get_template("view3d_head.html").render(title=view.title)
    body = templates.get_template("view3d.html").render(view=view, line=view.line, data=_data(view))
    # a page that forbids zooming is hard to read for some; the page's own title says what it shows
    page = re.sub(r"<title>.*?</title>|<meta name=\"viewport\".*?>", "", page, flags=re.DOTALL)
    page = page.replace("<head>", f"<head>{head}", 1)
    end = page.rindex("</body>")
    return page[:end] + body + page[end:]


def packed_page(page: str, title: str) -> str:
    """Return a page that unpacks another one in its place; three.js alone is 700 kB of text."""
    packed = base64.b64encode(zlib.compress(page.encode(), 9)).decode()
    return environment().get_template("packed.html").render(packed=packed, title=title)


def _data(view: View3D) -> dict[str, Any]:
    """Return what the page's script needs to know about the run."""
    run, scene = view.run, scene_of(view.run)
    camera, size = scene.camera, run.steps[0].frame.size
    corners = camera.near_points(np.array([[0.0, 0.0], [size[0], 0.0], [0.0, size[1]]]), size)
    finite = run.options.get("far", "finite") == "finite"
    return {
        "size": size,
        "eye": camera.eye.tolist(),
        "corner": corners[0].tolist(),
        "right": ((corners[1] - corners[0]) / size[0]).tolist(),
        "down": ((corners[2] - corners[0]) / size[1]).tolist(),
        "up": camera.up.tolist(),
        "farthest": camera.far / camera.near if finite else None,
        **_casters_place(scene),
        "extent": _extent(scene),
        "reach": 2 * max(_extent(scene), *view.geometry.distances.values()),
        "light": view.light.position.tolist(),
        "counting": counting_of(run),
        "start": "near" if run.technique == "volume-zpass-plus" else run.options.get("start", "none"),
        "finite": run.options.get("cap") == "finite",
        "marker": MARKER,
        "line": None if view.line is None else _line_data(view.line),
    }


def _line_data(line: LineOfSight) -> dict[str, Any]:
    return {
        "x": line.x,
        "y": line.y,
        "point": None if line.point is None else line.point.tolist(),
        "start": line.start,
        "end": line.end,
        "crossings": [
            {
                "place": None if each.place is None else each.place.tolist(),
                "change": each.change,
                "count": each.count,
                "face": f"{each.part} of {each.caster}",
            }
            for each in (*line.crossings, *line.others)
        ],
    }


def counting_of(run: DrawnRun) -> str | None:
    """Return which faces a technique counts: "passing", "failing" or "all" (by parity); None if it counts none."""
    if run.technique not in COUNTING:
        return None
    if run.technique == "volume-parity":
        return "parity"
    chosen = run.options.get("choose", "zpass" if run.technique == "volume-zpass-plus" else None)
    return "passing" if chosen == "zpass" else "failing"


def _casters_place(scene: Scene) -> dict[str, Any]:
    """Return the middle of the casters and their radius round it: what the view looks at."""
    things = [thing for thing in scene.casters if not thing.receives] or scene.objects
    vertices = np.concatenate([thing.world_positions for thing in things])
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    return {"middle": middle.tolist(), "radius": float(np.linalg.norm(vertices - middle, axis=1).max())}


def _extent(scene: Scene) -> float:
    vertices = np.concatenate([thing.world_positions for thing in scene.objects])
    return float(np.ptp(vertices, axis=0).max())
