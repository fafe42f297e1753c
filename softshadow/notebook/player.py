"""The widget of `play`: the browser's side is player.js, this side draws and explains.

The browser sends `values` and waits until `drawn` has gone up before it sends the next ones, so slow drawing leaves out
positions of a slider instead of falling behind.
"""

from __future__ import annotations

import time
import warnings
from base64 import b64encode
from pathlib import Path
from typing import Any

import anywidget
import imageio.v3 as imageio
import numpy as np
import traitlets

from softshadow.inspection.pictures import colors_of, depth_picture, map_pictures
from softshadow.notebook.controls import controls_of, moved_light, options_in
from softshadow.runs import Run, run
from softshadow.scene import Light, Scene
from softshadow.techniques import Technique

VIEWS = ("colour", "depth", "stencil")


class Player(anywidget.AnyWidget):
    """A technique on a scene with sliders.

    Attributes
    ----------
    run : Run                    the current one; None until the first drawing succeeds
    pixel : [x, y] or None       the one that was clicked
    values : dict                of the controls, by key: an option's name, or "light.x", "light.y", "light.z"
    view : str                   what is shown: "colour", "depth", "stencil" or the name of a map
    messages : list of str       warnings of the run, or the error that kept it from being drawn
    """

    _esm = Path(__file__).with_name("player.js")
    _css = Path(__file__).with_name("player.css")

    run = traitlets.Instance(Run, allow_none=True)
    heading = traitlets.Unicode().tag(sync=True)
    size = traitlets.List(traitlets.Int()).tag(sync=True)
    controls = traitlets.List(traitlets.Dict()).tag(sync=True)
    values = traitlets.Dict().tag(sync=True)
    view = traitlets.Unicode(VIEWS[0]).tag(sync=True)
    views = traitlets.List(traitlets.Unicode()).tag(sync=True)
    picture = traitlets.Bytes().tag(sync=True)  # PNG
    drawn = traitlets.Int().tag(sync=True)  # number of drawings, failed ones too
    milliseconds = traitlets.Float().tag(sync=True)
    failed = traitlets.Bool().tag(sync=True)
    messages = traitlets.List(traitlets.Unicode()).tag(sync=True)
    pixel = traitlets.List(traitlets.Int(), allow_none=True, default_value=None).tag(sync=True)
    explanation = traitlets.Unicode().tag(sync=True)
    history = traitlets.Unicode().tag(sync=True)  # HTML, in which all text is escaped

    def __init__(
        self, technique: Technique, scene: Scene, size: tuple[int, int], light: Light, options: dict[str, Any]
    ) -> None:
        self._technique, self._scene, self._light = technique, scene, light
        controls = controls_of(technique, technique.validate_options(options), scene, light)
        super().__init__(
            heading=f"{technique.title}, scene {scene.name}",
            size=list(size),
            controls=controls,
            values={control["key"]: control["value"] for control in controls},
        )
        self._draw()
        if self.run is None:
            raise ValueError(self.messages[0])
        self.observe(self._draw, "values")
        self.observe(self._show, "view")
        self.observe(self._explain, "pixel")

    def _draw(self, _: Any = None) -> None:
        """Draw the run that the values ask for; an error leaves the last one, and is shown."""
        start = time.perf_counter()
        try:
            scene = moved_light(self._scene, self._light, self.values)
            options = options_in(self.values, self._technique)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # they are in the run, and shown
                drawn = run(self._technique, scene, (self.size[0], self.size[1]), **options)
        except Exception as error:  # also what a technique of the user's own raises
            self.failed, self.messages = True, [f"{type(error).__name__}: {error}"]
        else:
            self.run = drawn
            self.failed, self.messages = False, [f"{type(note).__name__}: {note}" for note in drawn.warnings]
            self.views = [*VIEWS, *drawn.maps]
            self._show()
        self.milliseconds = 1000 * (time.perf_counter() - start)
        self.drawn += 1  # last, because the browser sends the next values now
        self._explain()

    def _show(self, _: Any = None) -> None:
        if self.run is not None:
            self.picture = _png(self._shown(self.run))

    def _shown(self, run: Run) -> np.ndarray:
        """Return the buffer or map that is viewed, as a picture."""
        if self.view in run.maps:
            return map_pictures(run.maps)[self.view]
        return {"depth": depth_picture(run.depth), "stencil": run.stencil}.get(self.view, run.image)

    def _explain(self, _: Any = None) -> None:
        if self.run is None or self.pixel is None:
            self.explanation, self.history = "", ""
            return
        try:
            history = self.run.pixel(*self.pixel)._repr_html_()
            self.explanation, self.history = self.run.explain(*self.pixel), history
        except (TypeError, ValueError) as error:  # a pixel outside the picture, set from Python
            self.explanation, self.history = str(error), ""

    def __repr__(self) -> str:
        return f"Player({self.run!r})"

    def _repr_mimebundle_(self, **kwargs: Any) -> tuple[dict[str, Any], dict[str, Any]]:
        """Return the widget, and a picture for places without a kernel or without widgets."""
        data, metadata = super()._repr_mimebundle_(**kwargs) or ({}, {})
        return data | {"text/plain": repr(self), "image/png": b64encode(self.picture).decode()}, metadata


def _png(picture: np.ndarray) -> bytes:
    """Return a PNG that takes little time to write."""
    return imageio.imwrite("<bytes>", colors_of(picture), extension=".png", plugin="pillow", compress_level=1)
