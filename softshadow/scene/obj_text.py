"""A Wavefront OBJ file reduced to vertices and triangles, with errors that name the line.

trimesh's parser accepts index 0 and indices that are too large, counts negative indices from the end of the file
instead of from the face's line, and opens whatever `mtllib` names. This module checks and resolves all of that first.
"""

import re

import numpy as np

from softshadow.errors import MeshError, PartlyReadFile
from softshadow.scene.polygon import quads_are_fans, triangulate

VERTEX_KEYS = ("v", "vt", "vn")
INDEX = "[1-9][0-9]{0,17}"
# the usual faces, whose indices count from the start and need no resolving: the keys of a corner's indices, the pattern
USUAL_FACES = tuple(
    (keys, re.compile(f"f(?: {corner}){{3,}}"))
    for keys, corner in (
        (("v",), INDEX),
        (("v", "vt", "vn"), f"{INDEX}/{INDEX}/{INDEX}"),
        (("v", "vn"), f"{INDEX}//{INDEX}"),
        (("v", "vt"), f"{INDEX}/{INDEX}"),
    )
)
# how many numbers a line has, and how a message says it: a vertex may have w, and a colour
COUNTS: dict[str, tuple[tuple[int, ...], str]] = {
    "v": ((3, 4, 6, 7, 8), "three numbers"),
    "vt": ((1, 2, 3), "one to three numbers"),
    "vn": ((3,), "three numbers"),
}
WHOLE = re.compile("-?[0-9]*", re.ASCII)
MOST_CORNERS = 1000  # of a polygon that is no quadrilateral: the time grows with their square
Groups = dict[tuple[tuple[str, ...], int], list[int]]  # the usual faces by keys and number of corners


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
    faces: list[str] = []
    face_lines: list[int] = []  # where they stand
    usual: Groups = {}
    others: dict[int, list[list[int]]] = {}  # the corners of all other faces
    keys, pattern = USUAL_FACES[0]
    short_faces: list[int] = []
    notes: list[PartlyReadFile] = []
    joined = text.replace("\\\r\n", " ").replace("\\\n", " ")
    for number, line in enumerate(joined.splitlines(), 1):
        key, *values = (line.split("#", 1)[0] if "#" in line else line).split() or [""]
        if key in VERTEX_KEYS:
            totals[key] += 1
            lines.append(f"{key} {' '.join(values)}")
            coordinates = _numbers(key, values, name, number)
            if key == "v":
                corners.append(coordinates[:3])
        elif key == "f" and len(values) < 3:
            short_faces.append(number)
        elif key == "f":
            face = f"f {' '.join(values)}"
            is_usual = pattern.fullmatch(face) is not None
            if not is_usual and (form := next((form for form in USUAL_FACES if form[1].fullmatch(face)), None)):
                (keys, pattern), is_usual = form, True
            if is_usual:
                usual.setdefault((keys, len(values)), []).append(len(faces))
            else:
                others[len(faces)] = [_absolute(value, totals, name, number) for value in values]
            faces.append(face)
            face_lines.append(number)
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
    _cut_usual_faces(faces, usual, others, totals, corners)
    for n, (face, number) in enumerate(zip(faces, face_lines, strict=True)):
        if n in others:
            lines += _triangles(others[n], totals, corners, name, number)
        else:
            lines.append(face)
    return "\n".join(lines), notes


def _cut_usual_faces(
    faces: list[str],
    usual: Groups,
    others: dict[int, list[list[int]]],
    totals: dict[str, int],
    corners: list[list[float]],
) -> None:
    """Cut the usual faces into triangles, many at a time; what is to be cut one by one becomes one of the others.

    These are polygons that are no fans, and where an index is too large all faces: the error names the first of them.
    """
    indices = {}
    for (keys, n_corners), members in usual.items():
        text = "".join([faces[n][1:] for n in members]).replace("/", " ")
        indices[keys, n_corners] = np.fromstring(text, np.int64, sep=" ").reshape(len(members), n_corners, len(keys))
    too_large = any(
        numbers[..., part].max() > totals[key]
        for (keys, _), numbers in indices.items()
        for part, key in enumerate(keys)
    )
    for (keys, n_corners), members in usual.items():
        if n_corners == 3 and not too_large:
            continue
        is_fan = [False] * len(members)
        if n_corners == 4 and not too_large:
            is_fan = quads_are_fans(np.array(corners)[indices[keys, n_corners][..., 0] - 1]).tolist()
        for n, fan in zip(members, is_fan, strict=True):
            if fan:
                _, a, b, c, d = faces[n].split(" ")
                faces[n] = f"f {a} {b} {c}\nf {a} {c} {d}"
            else:
                words = faces[n].split(" ")[1:]
                others[n] = [[int(index or "0") for index in word.split("/")] for word in words]


def _numbers(key: str, values: list[str], name: str, line: int) -> list[float]:
    counts, expected = COUNTS[key]
    try:
        numbers = list(map(float, values))
    except ValueError:
        numbers = []
    # Python's own spellings are none of the file's: 1_000, digits of other scripts
    if len(numbers) not in counts or any("_" in value or not value.isascii() for value in values):
        raise MeshError(f"{name}: line {line}: expected {key} with {expected}, got {' '.join(values)!r}")
    return numbers


def _absolute(corner: str, totals: dict[str, int], name: str, line: int) -> list[int]:
    """Return the indices v, vt, vn of a corner from 1 on, 0 for none; negative ones count back from this line."""
    result = []
    for part, key in zip(corner.split("/"), VERTEX_KEYS, strict=False):
        try:
            if not WHOLE.fullmatch(part):
                raise ValueError
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
    if len(face) > MOST_CORNERS:
        raise MeshError(f"{name}: line {line}: a face with {len(face)} corners; expected at most {MOST_CORNERS}")
    triangles = triangulate([corners[corner[0] - 1] for corner in face])
    return [f"f {words[a]} {words[b]} {words[c]}" for a, b, c in triangles]


def _leaves_folder(path: str) -> bool:
    parts = path.replace("\\", "/").split("/")
    return ".." in parts or parts[0] in ("", "~") or ":" in parts[0]
