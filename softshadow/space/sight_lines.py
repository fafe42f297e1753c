"""The line of sight of a pixel, and the faces of shadow volumes that a technique counts along it.

The crossings are the fragments that the pixel's history has: what is counted is therefore what the stencil buffer
counted, bit for bit, with its rules for edges and equal depths. They are put in the order of the line: from the eye to
the surface where passing fragments are counted, from infinity to the surface where failing ones are.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from softshadow import tokens as gl
from softshadow.inspection import HistoryRow, pixel_history
from softshadow.pipeline.commands import Draw
from softshadow.scene import Light, Scene
from softshadow.space.shadow_parts import DrawnRun, light_named, scene_of

# stencil operations that count, and what they change; GL_INVERT turns a parity round
COUNTERS = {gl.GL_INCR: 1, gl.GL_DECR: -1, gl.GL_INCR_WRAP: 1, gl.GL_DECR_WRAP: -1, gl.GL_INVERT: 1}
REACHED = ("passed", "depth failed")  # verdicts of fragments that the depth test has decided
# techniques whose stencil counts the volumes of each light once; what others draw is not counted, or for many points
COUNTING = ("volume-zpass", "volume-zpass-plus", "volume-zfail", "volume-parity")


@dataclass(frozen=True, eq=False)
class FaceCrossing:
    """Where the line of sight crosses a face of a volume.

    Attributes
    ----------
    place : (3,) float64 or None     world space; None: at infinity
    change : int                 what the stencil value changes by: +1, -1, or 0 where the face is not counted
    count : int or None          the stencil value after this crossing; None where it is not counted
    caster : str                 name
    part : str                   of the volume: "side", "light cap" or "dark cap"
    number : int                 of the side, or of the triangle of the cap, in the draw
    front_facing : bool          whether the line enters the volume here
    z : float                    window z
    step : str                   title of the step that draws it
    """

    place: np.ndarray | None
    change: int
    count: int | None
    caster: str
    part: str
    number: int
    front_facing: bool
    z: float
    step: str

    @property
    def counted(self) -> bool:
        """Whether the technique counts this face."""
        return self.count is not None


@dataclass(frozen=True, eq=False)
class LineOfSight:
    """The line of sight of a pixel, with the crossings in the order in which they are counted along it.

    Attributes
    ----------
    x, y : int                   of the pixel, y from the top
    light : str                  name
    eye : (3,) float64
    near_point : (3,) float64    where the line crosses the near plane
    point : (3,) float64 or None the surface that the pixel shows
    start : int                  stencil value before the first crossing is counted
    crossings : tuple            the counted ones
    others : tuple               faces that are crossed, but not counted: those beyond the surface, or before it
    end : int or None            stencil value of the pixel; None if the technique does not count
    inverts : bool               the stencil value is a parity
    """

    x: int
    y: int
    light: str
    eye: np.ndarray
    near_point: np.ndarray
    point: np.ndarray | None
    start: int
    crossings: tuple[FaceCrossing, ...]
    others: tuple[FaceCrossing, ...]
    end: int | None
    inverts: bool

    def __str__(self) -> str:
        """One line for each crossing, in order."""
        if self.end is None:
            return f"pixel {self.x}, {self.y}: the technique counts no faces of volumes"
        rows = [f"pixel {self.x}, {self.y}, light {self.light}: the count starts from {self.start}"]
        rows += [
            f"{'inverted' if self.inverts else format(each.change, '+d')} = {each.count}  {each.part} {each.number} of "
            f"the volume of {each.caster}"
            for each in self.crossings
        ]
        return "\n".join(rows)


def line_of_sight(run: DrawnRun, x: int, y: int, light: str | None = None) -> LineOfSight:
    """Return the line of sight of a pixel with the crossings that a run's technique counts for a light.

    Parameters
    ----------
    x, y : int                   x from the left, y from the top
    light : str                  name; the first one by default

    Raises
    ------
    ValueError                   the pixel is outside the picture, or there is no such light
    """
    scene, frame = scene_of(run), run.steps[0].frame
    source = scene.lights[0] if light is None else light_named(scene, light)
    rows = list(pixel_history(frame, x, y))  # checks x and y
    eye, size = scene.camera.eye, frame.size
    near_point = scene.camera.near_points(np.array([[x + 0.5, y + 0.5]]), size)[0]
    sight = Sight(scene, near_point, str(run.options.get("far", "finite")))
    point = sight.place(float(run.steps[-1].depth[y, x]))
    if run.technique not in COUNTING:
        return LineOfSight(x, y, source.name, eye, near_point, point, 0, (), (), None, False)
    draws = [command for command in frame.commands if isinstance(command, Draw)]
    own = _steps_of(run, source)
    found: list[tuple[HistoryRow, FaceCrossing]] = []
    for row in rows:
        reached = row.draw is not None and row.verdict in REACHED  # neither culled nor clipped
        if reached and row.step in own and _counter(_draw_of(row, draws), row) is not None:
            found.append((row, _crossing(row, draws, scene, sight)))
    counted = [(row, crossing) for row, crossing in found if _operation(row, draws) in COUNTERS]
    last = max(own)
    end = int(run.steps[last].stencil[y, x])
    # the highest bit may be a mark, which the counters leave alone
    largest = _draw_of(counted[0][0], draws).state.stencil.front.write_mask if counted else 0xFF
    largest &= 2**frame.stencil_bits - 1
    start = counted[0][0].stencil_before & largest if counted else end
    inverts = run.technique == "volume-parity"
    # passing fragments from the eye on, then failing ones from infinity on
    passed = sorted((pair for pair in counted if pair[0].verdict == "passed"), key=lambda pair: pair[1].z)
    failed = sorted((pair for pair in counted if pair[0].verdict != "passed"), key=lambda pair: -pair[1].z)
    crossings, count = [], start
    for _, crossing in passed + failed:
        count = (count ^ 1) if inverts else (count + crossing.change) % (largest + 1)
        crossings.append(replace(crossing, count=count))
    others = [replace(crossing, change=0) for row, crossing in found if _operation(row, draws) not in COUNTERS]
    return LineOfSight(
        x, y, source.name, eye, near_point, point, start, tuple(crossings),
        tuple(sorted(others, key=lambda each: each.z)), end, inverts,
    )  # fmt: skip


@dataclass(frozen=True)
class Sight:
    """A line of sight, on which window z names points."""

    scene: Scene
    near_point: np.ndarray
    far: str  # option of the technique

    def place(self, z: float) -> np.ndarray | None:
        """Return the world point of a window z; None at infinity, or at the far plane."""
        camera = self.scene.camera
        nearness = 1 - z * (1 if self.far == "infinite" else 1 - camera.near / camera.far)
        if z >= 1 or nearness <= 0:
            return None
        return np.asarray(camera.eye + (self.near_point - camera.eye) / nearness)


def _steps_of(run: DrawnRun, light: Light) -> set[int]:
    """Return the indices of the steps for a light: all, or those with its name in the title."""
    steps = [step.index for step in run.steps]
    if len(scene_of(run).lights) == 1:
        return set(steps)
    return {index for index in steps if run.steps[index].title.endswith(f": {light.name}")}


def _draw_of(row: HistoryRow, draws: list[Draw]) -> Draw:
    assert row.draw is not None
    return draws[row.draw]


def _counter(draw: Draw, row: HistoryRow) -> tuple[int, int] | None:
    """Return the stencil operations of a face where the depth test fails and passes; None if it does not count.

    Draws that count whether the depth test passes or not set the value to start from.
    """
    state = draw.state
    if not state.stencil.enabled or not state.depth.enabled or any(state.color.mask):
        return None
    face = state.stencil.front if row.front_facing else state.stencil.back
    ops = (face.zfail, face.zpass)
    return ops if (ops[0] in COUNTERS) != (ops[1] in COUNTERS) else None


def _operation(row: HistoryRow, draws: list[Draw]) -> int:
    """Return the stencil operation that a fragment has caused."""
    ops = _counter(_draw_of(row, draws), row)
    assert ops is not None
    return ops[row.verdict == "passed"]


def _crossing(row: HistoryRow, draws: list[Draw], scene: Scene, sight: Sight) -> FaceCrossing:
    draw = _draw_of(row, draws)
    caster = next(thing for thing in scene.casters if thing.name == row.object)
    assert row.triangle is not None
    assert row.z is not None
    positions = draw.vertices.position
    if draw.indices is None:
        part = "side"
    elif (positions[draw.indices[0], :3] == caster.mesh.positions).all(axis=1).any():
        part = "light cap"
    else:
        part = "dark cap"
    quads = draw.mode == gl.GL_QUADS
    # a counter that has stopped at its largest value, or at 0, changes nothing
    change = COUNTERS.get(_operation(row, draws), 0) if row.stencil_after != row.stencil_before else 0
    return FaceCrossing(
        sight.place(row.z), change, None, row.object, part, row.triangle // 2 if quads else row.triangle,
        bool(row.front_facing), row.z, row.title,
    )  # fmt: skip
