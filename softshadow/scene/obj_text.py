"""A Wavefront OBJ file reduced to vertices and triangles, with errors that name the line.

trimesh's parser accepts index 0 and indices that are too large, counts negative indices from the end of the file
instead of from the face's line, and opens whatever `mtllib` names. This module checks and resolves all of that first.
"""

from softshadow.errors import MeshError, PartlyReadFile
from softshadow.scene.polygon import triangulate

VERTEX_KEYS = ("v", "vt", "vn")


def drawable_lines(text: str, name: str) -> tuple[str, list[PartlyReadFile]]:
    """Return the v, vt, vn and f lines of an OBJ file, with every face as triangles, and what was left out.

    Parameters
    ----------
    name : str      the file, for messages

    Raises
    ------
    MeshError       a face has an index that is no number, is 0, or has no vertex; names the line
    """
    lines: list[str] = []
    totals = dict.fromkeys(VERTEX_KEYS, 0)
    corners: list[list[float]] = []
    faces: list[tuple[int, list[list[int]]]] = []
    short_faces: list[int] = []
    notes: list[PartlyReadFile] = []
    joined = text.replace("\\\r\n", " ").replace("\\\n", " ")
    for number, line in enumerate(joined.splitlines(), 1):
        key, *values = line.split("#", 1)[0].split() or [""]
        if key in VERTEX_KEYS:
            totals[key] += 1
            lines.append(f"{key} {' '.join(values)}")
            if key == "v":
                corners.append(_numbers(values[:3], name, number))
        elif key == "f" and len(values) < 3:
            short_faces.append(number)
        elif key == "f":
            faces.append((number, [_absolute(value, totals, name, number) for value in values]))
        elif key == "mtllib" and _leaves_folder(" ".join(values)):
            notes.append(
                PartlyReadFile(f"{name}: line {number}: {' '.join(line.split())}: outside the folder, not read")
            )
    if short_faces:
        faces_text = "1 face" if len(short_faces) == 1 else f"{len(short_faces)} faces"
        notes.append(
            PartlyReadFile(
                f"{name}: {faces_text} with fewer than 3 corners left out, the first in line {short_faces[0]}"
            )
        )
    for number, face in faces:
        lines += _triangles(face, totals, corners, name, number)
    return "\n".join(lines), notes


def _numbers(values: list[str], name: str, line: int) -> list[float]:
    try:
        x, y, z = map(float, values)
    except ValueError:
        raise MeshError(f"{name}: line {line}: expected v with three numbers, got {' '.join(values)!r}") from None
    return [x, y, z]


def _absolute(corner: str, totals: dict[str, int], name: str, line: int) -> list[int]:
    """Return the indices v, vt, vn of a corner from 1 on, 0 for none; negative ones count back from this line."""
    result = []
    for part, key in zip(corner.split("/"), VERTEX_KEYS, strict=False):
        try:
            index = int(part or "0")
        except ValueError:
            raise MeshError(f"{name}: line {line}: expected whole numbers in a face, got {corner!r}") from None
        if part and index == 0:
            raise MeshError(f"{name}: line {line}: face {corner!r} uses index 0; expected indices from 1 on")
        result.append(index + totals[key] + 1 if index < 0 else index)
        if result[-1] < 0 or (index < 0 and result[-1] == 0):
            raise MeshError(
                f"{name}: line {line}: {key} {index} does not exist; there are {totals[key]} before this line"
            )
    return result


def _triangles(
    face: list[list[int]], totals: dict[str, int], corners: list[list[float]], name: str, line: int
) -> list[str]:
    for corner in face:
        for index, key in zip(corner, VERTEX_KEYS, strict=False):
            if index > totals[key]:
                raise MeshError(f"{name}: line {line}: {key} {index} does not exist; expected 1 to {totals[key]}")
    words = ["/".join(str(index or "") for index in corner).rstrip("/") for corner in face]
    if len(face) == 3:
        return [f"f {words[0]} {words[1]} {words[2]}"]
    triangles = triangulate([corners[corner[0] - 1] for corner in face])
    return [f"f {words[a]} {words[b]} {words[c]}" for a, b, c in triangles]


def _leaves_folder(path: str) -> bool:
    parts = path.replace("\\", "/").split("/")
    return ".." in parts or parts[0] in ("", "~") or ":" in parts[0]
