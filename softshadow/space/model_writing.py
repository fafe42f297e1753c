"""Surfaces and edges as GLB and PLY files, written by trimesh."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

import softshadow
from softshadow.inspection.files import MARK
from softshadow.space.pieces import Color, Edges, Surface

EXTENSIONS = (".glb", ".ply")


def write_model(pieces: Sequence[Surface | Edges], title: str, path: Path) -> None:
    """Write pieces as the file's extension says: each a node of a GLB, or all surfaces as one mesh of a PLY."""
    path.write_bytes(ply_of(pieces) if path.suffix.lower() == ".ply" else glb_of(pieces, title))


def glb_of(pieces: Sequence[Surface | Edges], title: str) -> bytes:
    """Return a GLB with a node for each piece."""
    data: bytes = trimesh_scene(pieces, title).export(file_type="glb")
    return data


def trimesh_scene(pieces: Sequence[Surface | Edges], title: str) -> Any:
    """Return pieces as a `trimesh.Scene`, each under its name; edges are a `Path3D` of one line for each."""
    import trimesh

    scene = trimesh.Scene(metadata={"softshadow": f"{MARK} {softshadow.__version__}", "title": title})
    for piece in pieces:
        geometry = _mesh(piece) if isinstance(piece, Surface) else _path(piece)
        if geometry is not None:
            scene.add_geometry(geometry, node_name=piece.name, geom_name=piece.name)
    return scene


def _mesh(piece: Surface) -> Any:
    """Return a surface as a mesh with a material; None if it has no triangles, which no viewer accepts."""
    from trimesh import Trimesh
    from trimesh.visual import TextureVisuals
    from trimesh.visual.material import PBRMaterial

    if not len(piece.triangles):
        return None
    material = PBRMaterial(
        name=piece.name,
        baseColorFactor=_bytes(piece.color),
        metallicFactor=0.0,
        roughnessFactor=1.0,
        alphaMode="BLEND" if piece.color[3] < 1 else "OPAQUE",
        doubleSided=True,
    )
    visual = TextureVisuals(material=material)
    return Trimesh(piece.positions, piece.triangles, process=False, visual=visual, metadata=dict(piece.notes))


def _path(piece: Edges) -> Any:
    from trimesh.path import Path3D
    from trimesh.path.entities import Line

    if not len(piece.ends):
        return None
    lines = [Line([2 * i, 2 * i + 1]) for i in range(len(piece.ends))]
    colors = np.tile(_bytes(piece.color), (len(lines), 1))
    return Path3D(lines, piece.ends.reshape(-1, 3), process=False, colors=colors, metadata=dict(piece.notes))


def ply_of(pieces: Sequence[Surface | Edges]) -> bytes:
    """Return a PLY of all surfaces, with the colour of each at its vertices and its number at its faces.

    The comments of the header name the surfaces. PLY mixes no edges with faces in a way that other programs read, so
    edges are left out.
    """
    from trimesh import Trimesh

    surfaces = [piece for piece in pieces if isinstance(piece, Surface)]
    starts = np.cumsum([0, *(len(piece.positions) for piece in surfaces)])
    colors = [np.tile(_bytes(piece.color), (len(piece.positions), 1)) for piece in surfaces]
    numbers = [np.full(len(piece.triangles), number, np.int32) for number, piece in enumerate(surfaces)]
    mesh = Trimesh(
        np.concatenate([piece.positions for piece in surfaces]),
        np.concatenate([piece.triangles + start for piece, start in zip(surfaces, starts, strict=False)]),
        process=False,
        vertex_colors=np.concatenate(colors),
        face_attributes={"piece": np.concatenate(numbers)},
    )
    data: Any = mesh.export(file_type="ply")
    first, rest = data.split(b"\n", 2)[:2], data.split(b"\n", 2)[2]
    comments = [f"{MARK} {softshadow.__version__}"]
    comments += [f"piece {number}: {' '.join(piece.name.split())}" for number, piece in enumerate(surfaces)]
    header = [*first, *(f"comment {text}".encode() for text in comments), rest]
    return b"\n".join(header)


def _bytes(color: Color) -> np.ndarray:
    scaled: np.ndarray = np.rint(np.array(color) * 255).astype(np.uint8)
    return scaled


def viewer_html(pieces: Sequence[Surface | Edges], title: str) -> str:
    """Return trimesh's page that shows pieces with three.js; everything it needs is in it."""
    from trimesh.viewer.notebook import scene_to_html

    page: str = scene_to_html(trimesh_scene(pieces, title))
    return page
