"""A `Run`: the buffers, maps, warnings and recorded commands of a technique's drawing, and questions about them."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from softshadow import errors
from softshadow.context import Frame
from softshadow.inspection import (
    Comparison,
    Difference,
    Ledger,
    Maps,
    PixelHistory,
    SoftTruth,
    Step,
    Steps,
    WedgeContributions,
    buffer_files,
    difference,
    ledger_of,
    pixel_history,
    texel_history,
)
from softshadow.inspection.causes import Cause
from softshadow.inspection.fragment_maps import FragmentMaps, fragment_maps
from softshadow.inspection.pictures import Shown
from softshadow.inspection.shadow_kinds import shadow_kinds
from softshadow.runs.archive import RunRecord, read_npz
from softshadow.runs.comparing import compared, compared_with_truth
from softshadow.runs.described import described
from softshadow.runs.display import mimebundle
from softshadow.runs.lights import RunLight, lights_of, map_of
from softshadow.runs.map_texels import image_of_map
from softshadow.runs.saving import save
from softshadow.runs.wedges import contributions
from softshadow.runs.why import causes_at, explained
from softshadow.scene import Scene
from softshadow.space import LineOfSight, ShadowGeometry, geometry_of_run, line_of_sight
from softshadow.space.shadow_parts import scene_of

if TYPE_CHECKING:
    from softshadow.report import CrossSection, View3D


@dataclass(frozen=True, eq=False, repr=False)
class Run:
    """A technique's drawing of a scene, step by step. Arrays are read-only, row 0 on top, indexed [y, x].

    Attributes
    ----------
    technique : str              "replay" or "recording" for a program that draws no scene of this package
    scene : Scene or None        None for such a program; questions about light and shadow are errors then
    size : (width, height)
    options : dict               every option of the technique, with its default where none was passed
    warnings : tuple             those of the scene and the technique
    steps : Steps                by index or title, like ``run[2]`` and ``run["count back faces"]``
    frame : Frame                the recording
    """

    technique: str
    scene: Scene | None
    size: tuple[int, int]
    options: Mapping[str, Any]
    warnings: tuple[errors.Warning, ...]
    steps: Steps
    frame: Frame

    # -- buffers -------------------------------------------------------------------------------------------------------
    @property
    def image(self) -> np.ndarray:
        """(H, W, 3) uint8: the picture."""
        return self.steps[-1].image

    @property
    def depth(self) -> np.ndarray:
        """(H, W) float32: window z, 1 where nothing was drawn."""
        return self.steps[-1].depth

    @property
    def stencil(self) -> np.ndarray:
        """(H, W) uint8."""
        return self.steps[-1].stencil

    # -- maps ----------------------------------------------------------------------------------------------------------
    @cached_property
    def maps(self) -> Maps:
        """The named maps of all steps; if several steps have one of the same name, the last."""
        return self.steps.maps

    @property
    def visibility(self) -> np.ndarray:
        """(H, W) float32: 1 lit to 0 in shadow, the mean over the lights; 1 where it is not defined."""
        return map_of(self, "visibility")

    @property
    def valid(self) -> np.ndarray:
        """(H, W) bool: where the visibility is defined."""
        return map_of(self, "valid")

    @cached_property
    def shadow_mask(self) -> np.ndarray:
        """(H, W) bool: where at least one light is hidden, fully or in part."""
        mask = self.valid & (self.visibility < 1)
        mask.setflags(write=False)
        return mask

    @property
    def lights(self) -> tuple[RunLight, ...]:
        """The visibility of each light, in the order of the scene."""
        return lights_of(self)

    @property
    def _light_names(self) -> list[str]:
        return [light.name for light in self.scene.lights] if self.scene is not None else []

    # -- steps ---------------------------------------------------------------------------------------------------------
    def __getitem__(self, key: int | str) -> Step:
        """Return a step by its index or title."""
        return self.steps[key]

    def __len__(self) -> int:
        return len(self.steps)

    def __iter__(self) -> Iterator[Step]:
        return iter(self.steps)

    def _ipython_key_completions_(self) -> list[str]:
        """Return what completes `run["`."""
        return self.steps.titles

    def diff(self, a: int | str, b: int | str) -> Difference:
        """Return which pixels differ between the ends of two steps, each by index or title."""
        return difference(self.steps[a].buffers, self.steps[b].buffers)

    # -- questions -----------------------------------------------------------------------------------------------------
    def pixel(self, x: int, y: int, framebuffer: int = 0) -> PixelHistory:
        """Return every fragment generated at a pixel: x from the left, y from the top.

        Parameters
        ----------
        framebuffer : int            name of a framebuffer object; the window by default

        Raises
        ------
        ValueError                   the pixel is outside the framebuffer, or nothing was drawn to it
        """
        return pixel_history(self.frame, x, y, framebuffer, self._light_names)

    def map_pixel(self, name: str, x: int, y: int) -> PixelHistory:
        """Return every fragment generated at a texel of a map, like ``run.map_pixel("ZS", 211, 340)``.

        The last row that passed has the object and the triangle that the texel stores.

        Parameters
        ----------
        name : str                   of a map that was drawn as a texture; a cube map has one for each face, "ZS +x"
        x, y : int                   of the texel ``run.maps[name][y, x]``

        Raises
        ------
        StateError                   there is no such map, or it was not read from a texture
        ValueError                   outside the map
        """
        image, commands = image_of_map(self.steps, name)
        return texel_history(self.frame, image, x, y, commands, name, self._light_names)

    def explain(self, x: int, y: int) -> str:
        """Return one sentence that says why a pixel is lit or in shadow, and a second one with numbers if it is soft.

        It names the step, the test or lookup that decided it, and the object that casts the shadow.
        """
        text = explained(self.frame, self.pixel(x, y), self.scene, self.maps, self.options)
        if self.technique != "volume-wedges" or not self.valid[y, x] or not 0 < self.visibility[y, x] < 1:
            return text
        numbers = [number for number, light in enumerate(scene_of(self).lights) if light.shape is not None]
        return " ".join([text, *(str(self.contributions(x, y, number)) for number in numbers)])

    def causes(self, x: int, y: int) -> tuple[Cause, ...]:
        """Return why each hidden light does not reach what a pixel shows, or only in part; empty where it is lit."""
        return causes_at(self.frame, self.pixel(x, y), scene_of(self), self.maps)

    def fragments(self, step: int | str, framebuffer: int = 0) -> FragmentMaps:
        """Return how many fragments a step has drawn at each pixel, by verdict, and the last fragment of each pixel.

        Parameters
        ----------
        step : int or str            index or title
        framebuffer : int            name of a framebuffer object; the window by default
        """
        return fragment_maps(self.steps[step], framebuffer)

    def shadow_kinds(self, light: int = 0) -> np.ndarray:
        """Return (H, W) uint8: 0 where a light is fully visible, 1 in own shadow, 2 in cast shadow.

        A surface in its own shadow is turned away from the light. Where shadow is, the technique has decided; of which
        kind it is, ray casting.

        Parameters
        ----------
        light : int                  index in the scene
        """
        hidden = self.valid & (self.lights[light].visibility < 1)
        return shadow_kinds(scene_of(self), scene_of(self).lights[light], hidden)

    def contributions(self, x: int, y: int, light: int = 0) -> WedgeContributions:
        """Return what each penumbra wedge of a light contributes at a pixel of a run of "volume-wedges".

        The sum is computed in double precision, for the point and the hard count that the run has stored; it is the map
        "coverage" but for rounding.

        Parameters
        ----------
        light : int                  index in the scene

        Raises
        ------
        StateError                   another technique, or no surface at the pixel
        ValueError                   the pixel is outside the picture, or there is no such light
        """
        return contributions(self, x, y, light)

    def cross_section(self, x: int, y: int, light: str | None = None) -> CrossSection:
        """Return the plane through the eye, a light and the point that a pixel shows, with the counts on the way there.

        Parameters
        ----------
        light : str                  name; the first one by default

        Raises
        ------
        ValueError                   the pixel is outside the picture or shows no surface, or there is no such light
        """
        from softshadow.report import cross_section  # pages take as long to load as all the rest

        return cross_section(scene_of(self), (x, y), self.size, light)

    def geometry(self, light: str | None = None, distance: float | None = None) -> ShadowGeometry:
        """Return what the technique builds in space: silhouettes, volumes, light frusta, wedges, and the objects.

        Parameters
        ----------
        light : str                  name; all lights by default
        distance : float             as in `shadow_geometry`
        """
        return geometry_of_run(self, light, distance)

    def line_of_sight(self, x: int, y: int, light: str | None = None) -> LineOfSight:
        """Return the line from the eye through a pixel, with the faces of volumes that the technique counts along it.

        Parameters
        ----------
        light : str                  name; the first one by default

        Raises
        ------
        ValueError                   the pixel is outside the picture, or there is no such light
        """
        return line_of_sight(self, x, y, light)

    def view3d(self, x: int | None = None, y: int | None = None, light: str | None = None) -> View3D:
        """Return a view in three dimensions of the geometry, and of the line of sight of a pixel with its crossings.

        A notebook displays it, and its method `save` writes it as a page.

        Parameters
        ----------
        x, y : int                   of the pixel; without them the page begins without one
        light : str                  name; the first one by default

        Raises
        ------
        ValueError                   the pixel is outside the picture, or there is no such light
        """
        if (x is None) != (y is None):
            raise ValueError(f"view3d(x={x}, y={y}): expected both x and y, or neither")
        from softshadow.report import view3d_of

        return view3d_of(self, None if x is None or y is None else (x, y), light)

    @cached_property
    def ledger(self) -> Ledger:
        """Draws, triangles, fragments by verdict and stencil updates of every step; the frame is replayed for it."""
        return ledger_of(self.frame)

    def compare(self, other: Run | None = None, *, truth: str | SoftTruth | None = None) -> Comparison:
        """Return how the visibility differs from that of another run, or from ray casting.

        Parameters
        ----------
        other : Run                  of the same size
        truth : "hard", "soft" or SoftTruth      in double precision: a ray from each visible point to the centre of
                                     each light; the share of each light that it sees; or the second as `soft_truth`
                                     has returned it for the run's scene and size, with options and for several runs

        Raises
        ------
        TypeError                    neither a run nor a truth was passed, or both
        ValueError                   the sizes differ, or the truth is unknown
        """
        if (other is None) == (truth is None) or not isinstance(other, Run | None):
            raise TypeError('compare(): expected another run, or truth="hard" or "soft"')
        return compared_with_truth(self, truth) if other is None else compared(self, other)

    # -- files and display ---------------------------------------------------------------------------------------------
    @property
    def record(self) -> RunRecord:
        """Everything that files are written from."""
        return RunRecord(self.technique, self.scene, self.options, self.warnings, self.steps, self.frame)

    def save(self, path: str | os.PathLike[str], force: bool = False, *, beside: Run | None = None) -> Path:
        """Write the run to a file or folder, and return the path.

        ``.png`` is the picture, ``.npz`` everything (`load_run` reads it), ``.html`` the report; ``.glb`` and ``.ply``
        are the `geometry`; a folder gets pictures of every step, the GL state of each, and the npz.

        Parameters
        ----------
        beside : Run                 of the same size; the report shows both, and their difference

        Raises
        ------
        ValueError                   another file name extension; a run `beside` of another size, or for another file
        SoftShadowError              a file exists that this package did not write (`force` overwrites it), or the place
                                     cannot be written; no half-written file is left
        """
        return save(self.record, path, force, None if beside is None else beside.record)

    def export(
        self, buffer: str, path: str | os.PathLike[str], step: int | str | None = None, force: bool = False
    ) -> Path:
        """Write one buffer or map to a file, and return the path.

        ``.npz`` holds the array under its name. ``.exr`` holds floats (depth in channel Z) and whole numbers (stencil)
        exactly, and colours divided by 255. ``.png`` is the picture that reports show: colours and stencil values are
        exact, depths are stretched to greys.

        Parameters
        ----------
        buffer : str                 "color", "depth", "stencil", or the name of a map
        step : int or str            number or title; by default the last one that has the buffer

        Raises
        ------
        ValueError                   another file name extension, no such buffer, or not in this step
        SoftShadowError              EXR without the package for it, or the file cannot be written; see `save`
        """
        return buffer_files.export(self.steps, buffer, path, step, force)

    def __repr__(self) -> str:
        width, height = self.size
        about = f"scene {self.scene.name!r}" if self.scene is not None else str(self.options.get("program", ""))
        parts = [repr(self.technique), about, f"{width} x {height}", f"{len(self.steps)} steps"]
        return f"Run({', '.join(part for part in parts if part)})"

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> Shown:
        """Return what a notebook displays: the report, unless it is too large; the steps as a picture; a text."""
        return mimebundle(self.record, f"{self!r}\n{self.steps!r}", self.describe())

    def describe(self) -> str:
        """Return what the pictures of the run show, in words: of each step the counts, ranges and changes.

        Of a run with many steps the first ones and the last are described.

        Examples
        --------
        >>> import softshadow as ss
        >>> print(ss.run("volume-zfail", "torus", (64, 48)).describe())
        volume-zfail on torus, 64 x 48 pixels, steps 0 to 3.
        Step 0, ...
        """
        return described(self.steps, self.technique, self.size)


def load_run(path: str | os.PathLike[str]) -> Run:
    """Return the run that `Run.save` wrote to an npz, with its recording: it answers all questions as before.

    Raises
    ------
    SoftShadowError              the file does not exist, or is not a run of this package
    """
    record = read_npz(path)
    return Run(
        record.technique, record.scene, record.frame.size, record.options, record.warnings, record.steps, record.frame
    )
