"""The geometry of a scene's shadows: a collection of named pieces, which can be written to a file."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from softshadow.errors import nearest
from softshadow.inspection.files import write_whole
from softshadow.space.model_writing import EXTENSIONS, write_model
from softshadow.space.pieces import Edges, Surface, kind_of


@dataclass(frozen=True, eq=False, repr=False)
class ShadowGeometry:
    """What techniques build to find shadows, as named pieces; ``geometry["volume/lamp/torus/sides"]`` is one of them.

    Attributes
    ----------
    scene : str                  name
    pieces : tuple               of Surface and Edges
    distances : dict             by light: how far from it volumes and wedges are cut that reach to infinity
    """

    scene: str
    pieces: tuple[Surface | Edges, ...]
    distances: Mapping[str, float]

    @property
    def names(self) -> list[str]:
        """The names of the pieces."""
        return [piece.name for piece in self.pieces]

    def __iter__(self) -> Iterator[Surface | Edges]:
        return iter(self.pieces)

    def __len__(self) -> int:
        return len(self.pieces)

    def __getitem__(self, name: str) -> Surface | Edges:
        """Return the piece of a name.

        Raises
        ------
        KeyError                     there is none; the message has the nearest name
        """
        for piece in self.pieces:
            if piece.name == name:
                return piece
        raise KeyError(f"no piece has the name {name!r}: {nearest(name, self.names)}")

    def surfaces(self, kind: str) -> list[Surface]:
        """Return the surfaces of a kind, the first part of their names: "caster", "receiver", "volume", "wedges" ..."""
        return [piece for piece in self.pieces if isinstance(piece, Surface) and kind_of(piece) == kind]

    def with_pieces(self, more: Iterable[Surface | Edges]) -> ShadowGeometry:
        """Return this geometry and more pieces."""
        return ShadowGeometry(self.scene, (*self.pieces, *more), self.distances)

    def save(self, path: str | os.PathLike[str], force: bool = False) -> Path:
        """Write the geometry to a file, and return its path.

        ``.glb`` has a named node for every piece; ``.ply`` is one mesh of all surfaces with their colours.

        Raises
        ------
        ValueError                   another file name extension
        SoftShadowError              a file exists that this package did not write (`force` overwrites it), or the place
                                     cannot be written; no half-written file is left
        """
        if Path(path).suffix.lower() not in EXTENSIONS:
            raise ValueError(f"{path}: expected a name that ends in {' or '.join(EXTENSIONS)}")
        return write_whole(Path(path), lambda file: write_model(self.pieces, self.scene, file), force)

    def __repr__(self) -> str:
        triangles = sum(len(piece.triangles) for piece in self.pieces if isinstance(piece, Surface))
        edges = sum(len(piece.ends) for piece in self.pieces if isinstance(piece, Edges))
        return f"ShadowGeometry({self.scene!r}, {len(self)} pieces, {triangles} triangles, {edges} edges)"
