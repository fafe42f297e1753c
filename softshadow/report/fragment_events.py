"""What a replay records of a frame's window: draws, clears and other writes, and the fragments of each step."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from softshadow.pipeline.raster.fragment_ops import FragmentOps
from softshadow.pipeline.records import Region

LINE = 2  # in place of a facing: neither front nor back
# what the last fragment of a step was, in the map of fates; 0 is no fragment
FATES = ("no fragment", "drawn", "passed, no colour", "scissor", "alpha failed", "stencil failed", "depth failed",
         "culled")  # fmt: skip


@dataclass
class Triangles:
    """The triangles of a draw that cover pixels.

    corners (T, 6) and depth (T, 4) as in `pipeline.records.Setup`; sides (T, 2): which of the two stencil states
    applies (1 front), and the facing (1 front, 0 back, `LINE`); ids (T,): number of the primitive in the draw.
    """

    corners: np.ndarray
    depth: np.ndarray
    sides: np.ndarray
    ids: np.ndarray


@dataclass
class Origins:
    """What the triangles of a draw were made from: the number of a name for each, and that of its edge or face, or -1.

    names: by facing, texts in which {number} stands for the second.
    """

    names: dict[int, list[str]]
    owners: np.ndarray
    numbers: np.ndarray


@dataclass
class DrawEvent:
    """A draw: its state as numbers and words, its triangles, and its layers of alpha and colour."""

    step: int
    draw: int
    object: str
    region: Region
    culled: int
    depth_range: tuple[float, float]
    ops: tuple[FragmentOps, FragmentOps]  # back, front
    words: dict[int, dict[str, str]]  # by facing
    colored: bool
    triangles: Triangles
    alphas: list[np.ndarray] = field(default_factory=list)
    origins: Origins | None = None
    colors: list[tuple[np.ndarray, np.ndarray]] = field(default_factory=list)  # (H, W, 3), and where written (H, W)


@dataclass
class ClearEvent:
    """A clear: where, the values it writes, None for what it leaves alone, and the words."""

    step: int
    region: Region
    color: tuple[list[int], list[bool]] | None
    depth: float | None
    stencil: tuple[int, int] | None  # value and mask
    words: tuple[str, str]  # inside and outside the scissor box


@dataclass
class WriteEvent:
    """Any other command that changed the window: its buffers afterwards."""

    step: int
    name: str
    buffers: tuple[np.ndarray, np.ndarray, np.ndarray]  # colour (H, W, 3), depth in buffer units, stencil


@dataclass
class StepCounts:
    """The fragments of one step in the window: their number per pixel by fate, and the fate of the last one."""

    last: np.ndarray
    counts: dict[str, np.ndarray]


@dataclass
class FragmentRecord:
    """All events of a frame in order; `largest` is the depth 1 in buffer units, `single` whether depth is float32."""

    start: WriteEvent
    largest: int
    single: bool
    events: list[DrawEvent | ClearEvent | WriteEvent]
    steps: list[StepCounts]
