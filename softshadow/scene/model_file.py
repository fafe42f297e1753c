"""Model files read into plain arrays by trimesh's parsers; the only module that imports trimesh.

Only the parsers are used: trimesh's mesh class merges and reorders vertices, and its resolvers open further files. A
parser gets bytes and has no access to other files. Whatever fails becomes a MeshError of one sentence.
"""

import io
import json
import logging
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from softshadow.errors import MeshError, PartlyReadFile, nearest
from softshadow.scene.gltf_tree import read_tree, self_contained
from softshadow.scene.obj_text import drawable_lines
from softshadow.scene.placement import transform_points
from softshadow.scene.validate import shortened


@dataclass
class ModelPart:
    """One piece of a model, in the coordinate system of the file.

    Attributes
    ----------
    positions : (V, 3) float64
    triangles : (T, 3) int64
    normals, texcoords, colors : (V, 3), (V, 2), (V, 4) float64, or None if the file has none; colours 0 to 1
    """

    positions: np.ndarray
    triangles: np.ndarray
    normals: np.ndarray | None = None
    texcoords: np.ndarray | None = None
    colors: np.ndarray | None = None


def read_parts(path: Path) -> tuple[list[ModelPart], list[PartlyReadFile]]:
    """Return the parts of a model file that have triangles, and warnings about what was left out.

    Raises
    ------
    MeshError      missing, not a regular file, unreadable, of an unknown type, malformed, or without triangles
    """
    kind = path.suffix.lower().lstrip(".")
    if kind not in _READERS:
        raise MeshError(f"{path}: cannot read files of type {path.suffix!r}; {nearest(kind, sorted(_READERS))}")
    data = read_bytes(path)
    try:
        with _quiet():
            geometry, notes = _READERS[kind](data, path)
            parts = [part for kwargs, matrix in geometry if (part := _model_part(kwargs, matrix, path, notes))]
    except MeshError as error:
        raise MeshError(shortened(str(error))) from None
    except Exception as error:  # parsers raise anything; the cause is the file
        reason = shortened(f"{type(error).__name__}: {error}".split("\n")[0])
        raise MeshError(f"{path}: not a well-formed {kind.upper()} file ({reason})") from None
    if not parts:
        raise MeshError(f"{path}: {_content(kind, data, geometry)}; expected a mesh with at least one triangle")
    return parts, notes


def read_bytes(path: Path) -> bytes:
    """Return the content of a regular file, or raise a MeshError that says why not."""
    try:
        exists = path.exists()
    except OSError as error:  # as a name that is too long
        raise MeshError(f"{path}: cannot be read ({error.strerror}); expected an existing file") from None
    if not exists:
        folder = path.parent
        known = [item.name for item in folder.iterdir()] if folder.is_dir() else []
        close = nearest(path.name, known).split("?")[0] + "?" if known else ""
        hint = close if close.startswith("did you mean") else "expected an existing file"
        raise MeshError(f"{path}: there is no such file; {hint}")
    if not path.is_file():
        raise MeshError(f"{path}: is {'a folder' if path.is_dir() else 'not a regular file'}; expected a model file")
    try:
        return path.read_bytes()
    except OSError as error:
        raise MeshError(f"{path}: cannot be read ({error.strerror}); expected a readable file") from None


Geometry = list[tuple[dict[str, Any], np.ndarray]]


def _read_obj(data: bytes, path: Path) -> tuple[Geometry, list[PartlyReadFile]]:
    from trimesh.exchange.obj import load_obj

    text, notes = drawable_lines(data.decode("utf-8-sig", errors="replace"), str(path))
    # maintain_order=True would keep one normal per position, which smooths every crease
    loaded = load_obj(io.StringIO(text), skip_materials=True, group_material=False, maintain_order=False)
    return _placed(loaded), notes


def _read_ply(data: bytes, path: Path) -> tuple[Geometry, list[PartlyReadFile]]:
    from trimesh.exchange.ply import load_ply

    loaded = load_ply(io.BytesIO(data), skip_materials=True)
    for name, element in loaded["metadata"]["_ply_raw"].items():
        columns = element.get("data")
        lengths = {len(values) for values in columns.values()} if isinstance(columns, dict) else {element["length"]}
        if lengths != {element["length"]}:
            raise MeshError(f"{path}: the header declares {element['length']} of element {name}, got {min(lengths)}")
    return _placed(loaded), []


def _read_stl(data: bytes, path: Path) -> tuple[Geometry, list[PartlyReadFile]]:
    from trimesh.exchange.stl import load_stl

    is_binary = _binary_stl_length(data) == len(data)
    # text has to be UTF-8: trimesh decodes other encodings with a package that is not installed
    return _placed(load_stl(io.BytesIO(data if is_binary else _as_utf8(data)))), []


def _read_off(data: bytes, path: Path) -> tuple[Geometry, list[PartlyReadFile]]:
    from trimesh.exchange.off import load_off

    return _placed(load_off(io.BytesIO(_as_utf8(data)))), []


def _read_gltf(data: bytes, path: Path) -> tuple[Geometry, list[PartlyReadFile]]:
    from trimesh.exchange.gltf import load_gltf

    tree, binary = read_tree(data, str(path))
    tree, buffers, notes = self_contained(tree, binary, path)
    return _placed(load_gltf(io.BytesIO(json.dumps(tree).encode()), resolver=buffers)), notes


_READERS: dict[str, Callable[[bytes, Path], tuple[Geometry, list[PartlyReadFile]]]] = {
    "obj": _read_obj,
    "ply": _read_ply,
    "stl": _read_stl,
    "off": _read_off,
    "glb": _read_gltf,
    "gltf": _read_gltf,
}


def _placed(loaded: dict[str, Any]) -> Geometry:
    """Return each geometry once per node that shows it, with the matrix from its own to the file's coordinates."""
    if "geometry" not in loaded:
        return [(loaded, np.eye(4))]
    geometry = loaded["geometry"]
    if "graph" not in loaded:
        return [(kwargs, np.eye(4)) for kwargs in geometry.values()]
    world: dict[str, np.ndarray] = {}
    placed = []
    for edge in loaded["graph"]:  # parents come before their children
        matrix = world.get(edge.get("frame_from", ""), np.eye(4)) @ np.asarray(edge.get("matrix", np.eye(4)))
        world[edge["frame_to"]] = matrix
        if "geometry" in edge:
            placed.append((geometry[edge["geometry"]], matrix))
    return placed


def _model_part(
    kwargs: dict[str, Any], matrix: np.ndarray, path: Path, notes: list[PartlyReadFile]
) -> ModelPart | None:
    """Return a part from what a parser returned, None without triangles; appends to `notes`."""
    positions = np.asarray(kwargs.get("vertices", np.zeros((0, 3))))
    faces = kwargs.get("faces")
    if faces is None or not len(faces) or not len(positions):
        return None
    faces = np.asarray(faces).astype(np.int64)
    outside = (faces < 0) | (faces >= len(positions))
    if outside.any():
        raise MeshError(f"{path}: a face uses vertex {faces[outside][0]}; expected 0 to {len(positions) - 1}")
    fan = [corner for last in range(2, faces.shape[1]) for corner in (0, last - 1, last)]
    triangles = faces[:, fan].reshape(-1, 3)
    attributes = kwargs.get("vertex_attributes", {})
    normals = _per_vertex(kwargs.get("vertex_normals"), positions, 3)
    part = ModelPart(positions.astype(np.float64), triangles, normals, _texcoords(kwargs, attributes, positions))
    facets = kwargs.get("face_normals")
    if facets is not None and not np.any(facets, axis=1).all():
        notes.append(PartlyReadFile(f"{path}: facet normals of length 0 replaced by computed ones"))
    part.colors = _colors(kwargs, attributes, part)
    if part.colors is not None and not np.isfinite(part.colors).all():
        part.colors = None
        notes.append(PartlyReadFile(f"{path}: vertex colours that are not finite numbers left out"))
    return _transformed(part, matrix)


def _per_vertex(values: Any, positions: np.ndarray, width: int) -> np.ndarray | None:
    if values is None or np.shape(values) != (len(positions), width):
        return None
    return np.asarray(values, dtype=np.float64)


def _texcoords(kwargs: dict[str, Any], attributes: dict[str, Any], positions: np.ndarray) -> np.ndarray | None:
    uv = getattr(kwargs.get("visual"), "uv", None)
    if "_TEXCOORD_0" in attributes:
        uv = _unit_range(np.asarray(attributes["_TEXCOORD_0"]))
        uv[:, 1] = 1 - uv[:, 1]  # glTF has (0, 0) at the top left
    texcoords = _per_vertex(uv, positions, 2)
    return texcoords if texcoords is not None and np.isfinite(texcoords).all() else None


def _colors(kwargs: dict[str, Any], attributes: dict[str, Any], part: ModelPart) -> np.ndarray | None:
    """Return (V, 4) colours of the vertices, else of the faces, else of the material, else None.

    With face colours, the part is changed so that faces share no vertices.
    """
    values = attributes.get("_COLOR_0", kwargs.get("vertex_colors"))
    if values is None and kwargs.get("face_colors") is not None and len(kwargs["face_colors"]) == len(part.triangles):
        for key in ("positions", "normals", "texcoords"):
            array = getattr(part, key)
            setattr(part, key, None if array is None else array[part.triangles.ravel()])
        part.triangles = np.arange(3 * len(part.triangles)).reshape(-1, 3)
        values = np.repeat(kwargs["face_colors"], 3, axis=0)
    if values is None:
        factor = getattr(getattr(kwargs.get("visual"), "material", None), "baseColorFactor", None)
        values = None if factor is None else np.tile(np.asarray(factor, dtype=np.uint8), (len(part.positions), 1))
    if values is None or np.shape(values) not in [(len(part.positions), width) for width in (3, 4)]:
        return None
    colors = np.ones((len(values), 4))
    colors[:, : np.shape(values)[1]] = _unit_range(np.asarray(values))
    return colors


def _unit_range(values: np.ndarray) -> np.ndarray:
    """Return integers divided by the largest of their type; floats unchanged, or / 255 if a colour exceeds 1."""
    if values.dtype.kind in "ui":
        return values / np.iinfo(values.dtype).max
    scaled = values.astype(np.float64)
    return scaled / 255 if values.shape[1] > 2 and np.nanmax(scaled, initial=0) > 1 else scaled


def _transformed(part: ModelPart, matrix: np.ndarray) -> ModelPart:
    """Return the part transformed by a matrix; a reflection also reverses the winding of its triangles."""
    if np.array_equal(matrix, np.eye(4)):
        return part
    linear = matrix[:3, :3]
    part.positions = transform_points(part.positions, linear) + matrix[:3, 3]
    reflects = np.linalg.det(linear) < 0
    if reflects:
        part.triangles = part.triangles[:, [0, 2, 1]]
    if part.normals is not None:
        # the cofactor matrix, det times the inverse transpose, exists for singular matrices too
        cofactors = np.stack([np.cross(linear[(i + 1) % 3], linear[(i + 2) % 3]) for i in range(3)])
        part.normals = transform_points(part.normals, -cofactors if reflects else cofactors)
    return part


def _content(kind: str, data: bytes, geometry: Geometry) -> str:
    """Return what a file without triangles contains, for a message."""
    points = sum(len(kwargs.get("vertices", ())) for kwargs, _ in geometry)
    if points:
        return f"{points} points and no triangle"
    declared = _binary_stl_length(data)
    if kind == "stl" and declared > len(data) and b"solid" not in data[:80]:
        return f"as a binary STL it declares {declared} bytes but has {len(data)}, as text it has no solid"
    return "the file has no mesh" if data.strip() else "the file is empty"


def _binary_stl_length(data: bytes) -> int:
    return 84 + 50 * int.from_bytes(data[80:84], "little")


def _as_utf8(data: bytes) -> bytes:
    return data.decode("utf-8-sig", errors="replace").encode()


@contextmanager
def _quiet() -> Iterator[None]:
    """Silence the parsers' warnings and log; NumPy's warning about text after the last number becomes an error."""
    log = logging.getLogger("trimesh")
    was_disabled = log.disabled
    log.disabled = True
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            warnings.filterwarnings("error", message=".*unmatched data.*")
            yield
    finally:
        log.disabled = was_disabled
