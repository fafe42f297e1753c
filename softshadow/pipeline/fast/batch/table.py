"""The draws of a run as one table; equals `geometry.geometry.process_geometry`, see fast/test_batch.py."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from itertools import islice
from operator import attrgetter
from typing import NamedTuple

import numpy as np

from softshadow.framebuffer import Framebuffer
from softshadow.jit import read_only
from softshadow.kernel_cache import KernelGroup
from softshadow.pipeline.alike_draws import AlikeDraws, of_each, parts_of
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.batch import lighting
from softshadow.pipeline.fast.batch.attributes import NO_COORDINATES, NO_INDICES, NO_ROWS, REAL, Attributes, matrices_of
from softshadow.pipeline.fast.batch.planes import Planes
from softshadow.pipeline.fast.batch.run import Run
from softshadow.pipeline.fast.batch.vertices import (
    BY_COORDINATE,
    COLOR,
    END,
    FLOATS,
    IN_STAGES,
    INDEX_END,
    INDEX_START,
    JOINED_STRIPS,
    KIND,
    MODELVIEW,
    NORMAL,
    NUMBERS,
    PROJECTION,
    START,
    UNIT_COLUMNS,
    UNIT_CONSTANT,
    UNIT_IS_IDENTITY,
    UNIT_MATRIX,
    Layout,
)
from softshadow.pipeline.geometry.clip_planes import NO_PLANES
from softshadow.pipeline.geometry.vertex import scale_and_shift
from softshadow.pipeline.memory.scratch import scratch
from softshadow.pipeline.mesa.provoking_vertex import first_provokes
from softshadow.programs import reflectances
from softshadow.programs.fixed_function import NO_COORDINATE, is_replaced
from softshadow.state import Lighting, MaterialState, Viewport
from softshadow.tokens import GL_QUAD_STRIP, GL_QUADS

BATCH_KERNELS = KernelGroup("batch")
SIDES = ("front", "back")
LIGHT_MODEL = tuple(field.name for field in fields(Lighting) if field.name not in SIDES)
MATERIAL = tuple(field.name for field in fields(MaterialState))
MOST_KNOWN = 1024  # states of which the numbers are kept
VIEWPORT_OF, PROJECTION_OF = attrgetter("state.viewport"), attrgetter("projection")


class Table(NamedTuple):
    """The draws of a run as arrays, see the columns in `batch.vertices`.

    numbers (D, 12) int64; rows (D, 72), unit_rows (D, U, 21): matrices and constants; lights (L, N, 23), materials
    (L, 2, 20), flags (L, 9): each distinct `Lighting`; generated (U, 5), planes (U, 4, 4): generation of coordinates;
    user_planes (P, 4): of `Planes`; positions (V, 4), colors (V, 4), normals (V, 3),
    texcoords (U, V, 4): of all draws one after the other, no rows where they are constants; reflectances (V, 17 or 34):
    materials of vertices, front and with two-sided lighting back; secondaries (V, 4), fog_coordinates (V,): no rows
    where no column depends on them; indices (I,) int32; scales (W, 3), shifts (W, 3): of `Views`.
    """

    layout: Layout
    numbers: np.ndarray
    rows: np.ndarray
    unit_rows: np.ndarray
    lights: np.ndarray
    materials: np.ndarray
    flags: np.ndarray
    generated: np.ndarray
    planes: np.ndarray
    user_planes: np.ndarray
    positions: np.ndarray
    colors: np.ndarray
    normals: np.ndarray
    reflectances: np.ndarray
    secondaries: np.ndarray
    fog_coordinates: np.ndarray
    texcoords: np.ndarray
    indices: np.ndarray
    scales: np.ndarray
    shifts: np.ndarray


class Views(NamedTuple):
    """The viewport transforms of the draws of a run.

    of_draws: a row for each draw; scales (W, 3), shifts (W, 3) float32: see `geometry.vertex.scale_and_shift`.
    """

    of_draws: Sequence[int]
    scales: np.ndarray
    shifts: np.ndarray


def views_of(draws: Sequence[Draw], target: Framebuffer) -> Views:
    """Return the viewport transforms of draws."""
    viewports = of_each(draws, VIEWPORT_OF)
    if len(set(map(id, viewports))) == 1:
        return Views([0] * len(draws), *_transform(viewports[0], target))
    distinct = {id(viewport): viewport for viewport in viewports}
    rows = {name: row for row, name in enumerate(distinct)}
    of_draws = [rows[id(viewport)] for viewport in viewports]
    transforms = [_transform(viewport, target) for viewport in distinct.values()]
    return Views(of_draws, *map(read_only, map(np.concatenate, zip(*transforms, strict=True))))


_transforms: dict[int, tuple[Viewport, tuple[int, bool], tuple[np.ndarray, np.ndarray]]] = {}  # the latest, by id


def _transform(viewport: Viewport, target: Framebuffer) -> tuple[np.ndarray, np.ndarray]:
    """Return the scale (1, 3) and shift (1, 3) of a viewport."""
    place, known = (target.size[1], target.flipped), _transforms.get(id(viewport))
    if known is None or known[0] is not viewport or known[1] != place:
        if len(_transforms) >= MOST_KNOWN:
            _transforms.clear()
        scale, shift = scale_and_shift(viewport, *place, REAL)
        known = _transforms[id(viewport)] = viewport, place, (read_only(scale[None]), read_only(shift[None]))
    return known[2]


def table_of(run: Run, draws: Sequence[Draw], views: Views, planes: Planes, *, reads_indices: bool = True) -> Table:
    """Return the draws of a run as arrays; without their indices if nobody reads them."""
    arrays, layout, attributes = run.arrays, run.layout, Attributes(draws)
    rows = np.empty((len(draws), FLOATS), np.float32)
    rows[:, MODELVIEW:PROJECTION] = attributes.modelviews()
    rows[:, PROJECTION:COLOR] = matrices_of(of_each(draws, PROJECTION_OF))
    if not arrays.color:
        rows[:, COLOR:NORMAL] = attributes.constant("color")
    if not arrays.normal:
        rows[:, NORMAL : NORMAL + 3] = attributes.constant("normal")
    numbers, lightings = _numbers(draws, run, views, planes)
    return Table(
        layout,
        numbers,
        rows,
        _unit_rows(run, draws, attributes),
        *_lighting_arrays(lightings, arrays.materials),
        run.generated,
        run.planes,
        NO_PLANE_ROWS if planes.rows is NO_PLANES else read_only(planes.rows),
        attributes.positions(),
        attributes.colors(arrays.color),
        attributes.normals(arrays.normal and run.reads_normals),
        _reflectances(draws, arrays.materials, layout.two_side),
        attributes.secondaries() if run.reads_secondaries else NO_ROWS,
        attributes.fog_coordinates() if layout.fog == BY_COORDINATE else NO_COORDINATES,
        attributes.texcoords(run),
        attributes.indices() if reads_indices else NO_INDICES,
        views.scales,
        views.shifts,
    )


NO_PLANE_ROWS = read_only(NO_PLANES)
NO_REFLECTANCES = [read_only(np.empty((0, n_sides * lighting.REFLECTANCES), REAL)) for n_sides in (1, 2)]


def _reflectances(draws: Sequence[Draw], names: frozenset[str], two_side: int) -> np.ndarray:
    """Return the materials of the vertices of all draws, (V, 17 or 34); no rows if vertices have none."""
    if not names:
        return NO_REFLECTANCES[two_side]
    n_sides = 1 + two_side
    n_vertices, start = sum([len(draw.vertices.position) for draw in draws]), 0
    rows = scratch((n_vertices, n_sides, lighting.REFLECTANCES), REAL)
    for draw in draws:
        vertices, constants = draw.vertices, _rows(draw.state.lighting, names).materials
        end = start + len(vertices.position)
        for side, constant, own in zip(SIDES[:n_sides], constants, rows[start:end].swapaxes(0, 1), strict=False):
            for name, columns in lighting.REFLECTANCE_COLUMNS.items():
                own[:, columns] = vertices.materials.get(f"{side}.{name}", constant[columns])
        start = end
    return read_only(rows.reshape(n_vertices, n_sides * lighting.REFLECTANCES))


def _numbers(draws: Sequence[Draw], run: Run, views: Views, planes: Planes) -> tuple[np.ndarray, list[Lighting]]:
    """Return the numbers of each draw, and the states of lighting that kernels can tell apart."""
    lightings, tells_apart = [draws[0].state.lighting], run.reads_normals
    across = IN_STAGES if run.unfilled else int(run.across)
    across_by_mode = {GL_QUADS: 1} if first_provokes(run.state) else {}
    tables: list[np.ndarray] = []
    rest = zip(views.of_draws, planes.firsts, planes.ends, strict=True)
    start = index_start = 0
    for part in parts_of(draws):
        if type(part) is AlikeDraws:
            like, indexed, counts = part.like, part.indices is not None, part.vertices.counts
            row = _row_of(like.state.lighting, lightings, tells_apart)
            (view, first_plane, end_plane), *_ = islice(rest, len(part))
            mode, cut = _mode_of(like), across or indexed or across_by_mode.get(like.mode, 0)
            table = np.empty((len(part), NUMBERS), np.int64)
            table[:] = 0, 0, mode, index_start, index_start, indexed, 0, row, cut, view, first_plane, end_plane
            table[:, KIND] = part.kinds
            table[:, END] = np.cumsum(counts) + start
            table[:, START] = table[:, END] - counts
            if indexed:
                table[:, INDEX_END] += np.cumsum(part.counts)
                table[:, INDEX_START] = table[:, INDEX_END] - part.counts
            start, index_start = int(table[-1, END]), int(table[-1, INDEX_END])
            tables.append(table)
            continue
        numbers: list[int] = []  # in the order of the columns
        latest, row = lightings[0], 0
        for draw, (view, first_plane, end_plane) in zip(part, rest, strict=False):
            indices, lights = draw.indices, draw.state.lighting
            end, indexed = start + len(draw.vertices.position), indices is not None
            index_end = index_start if indices is None else index_start + len(indices)
            if lights is not latest:
                latest, row = lights, _row_of(lights, lightings, tells_apart)
            kind, cut = draw.modelview_kind, across or indexed or across_by_mode.get(draw.mode, 0)
            mode = _mode_of(draw)
            numbers += (start, end, mode, index_start, index_end, indexed, kind, row, cut, view, first_plane, end_plane)
            start, index_start = end, index_end
        tables.append(np.array(numbers, np.int64).reshape(-1, NUMBERS))
    return tables[0] if len(tables) == 1 else np.concatenate(tables), lightings


def _mode_of(draw: Draw) -> int:
    """Return the mode of a draw in a table."""
    return JOINED_STRIPS if draw.pairs_mode == GL_QUAD_STRIP else draw.mode


def _row_of(lights: Lighting, lightings: list[Lighting], tells_apart: bool) -> int:
    """Return the row of a state of lighting, if it does not equal the last one a new one."""
    last = lightings[-1]
    if tells_apart and lights is not last and not _same_rows(lights, last):
        lightings.append(lights)
    return len(lightings) - 1


def _same_rows(a: Lighting, b: Lighting) -> bool:
    """Return whether two states of lighting have the same rows: a colour that follows glColor does not matter."""
    one, other = a.__dict__, b.__dict__
    if any(one[name] is not other[name] and one[name] != other[name] for name in LIGHT_MODEL):
        return False
    for side in SIDES:
        followed = reflectances.followed(a, side)
        x, y = one[side].__dict__, other[side].__dict__
        if any(x[name] != y[name] for name in MATERIAL if name not in followed):
            return False
    return True


# of the latest states of lighting, by id and by the names of the materials that vertices have
_rows_of: dict[tuple[int, frozenset[str]], tuple[Lighting, lighting.LightingRows]] = {}


def _rows(lights: Lighting, names: frozenset[str]) -> lighting.LightingRows:
    place = id(lights), names
    known = _rows_of.get(place)
    if known is None or known[0] is not lights:
        if len(_rows_of) >= MOST_KNOWN:
            _rows_of.clear()
        known = _rows_of[place] = (lights, lighting.lighting_rows(lights, names))
    return known[1]


def _lighting_arrays(lightings: list[Lighting], names: frozenset[str]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return lights, materials and flags of all states of lighting; `names` as for `lighting_rows`."""
    rows = [_rows(each, names) for each in lightings]
    if len(rows) == 1:
        return rows[0].lights[np.newaxis], rows[0].materials[np.newaxis], rows[0].flags[np.newaxis]
    most = max(len(each.lights) for each in rows)
    lights = np.zeros((len(rows), most, lighting.LIGHT_COLUMNS), np.float32)
    for row, each in zip(lights, rows, strict=True):
        row[: len(each.lights)] = each.lights
    materials = np.array([each.materials for each in rows])
    flags = np.array([each.flags for each in rows])
    return lights, materials, flags


def _unit_rows(run: Run, draws: Sequence[Draw], attributes: Attributes) -> np.ndarray:
    rows = np.zeros((len(draws), len(run.units), UNIT_COLUMNS), np.float32)
    if not run.units:
        return rows
    matrices = of_each(draws, attrgetter("texture_matrices"))
    for n, unit in enumerate(run.units):
        if is_replaced(run.state, unit.index):
            rows[:, n, UNIT_CONSTANT:UNIT_IS_IDENTITY], rows[:, n, UNIT_IS_IDENTITY] = NO_COORDINATE, 1
            continue
        rows[:, n, UNIT_MATRIX:UNIT_CONSTANT] = matrices_of([each[unit.index] for each in matrices])
        rows[:, n, UNIT_IS_IDENTITY] = run.arrays.identities[n]
        if not run.arrays.texcoords[n]:
            rows[:, n, UNIT_CONSTANT:UNIT_IS_IDENTITY] = attributes.constant_texcoords(unit.index)
    return rows
