"""A Wavefront OBJ file reduced to what is drawn: vertices and triangles with absolute numbers.

The reader behind it takes a 0 or a number that is too large without a word, counts negative numbers from the end of the
file instead of from the face's line, and follows `mtllib` to wherever it points. Here each is answered with its line.
"""

from softshadow.errors import MeshError, PartlyReadFile
from softshadow.scene.polygon import cut_into_triangles

KEPT = ("v", "vt", "vn")


def drawable_lines(text: str, name: str) -> tuple[str, list[PartlyReadFile]]:
    """Return the v, vt, vn and f lines of an OBJ file, every face a triangle, and what was left out.

    Parameters
    ----------
    name : str      the file, for messages

    Raises
    ------
    MeshError       a face with a number that is none, is 0, or has no vertex; names the line
    """
    lines: list[str] = []
    counts = dict.fromkeys(KEPT, 0)
    corners: list[list[float]] = []
    faces: list[tuple[int, list[list[int]]]] = []
    short: list[int] = []
    notes: list[PartlyReadFile] = []
    joined = text.replace("\\\r\n", " ").replace("\\\n", " ")
    for number, line in enumerate(joined.splitlines(), 1):
        key, *values = line.split("#", 1)[0].split() or [""]
        if key in KEPT:
            counts[key] += 1
            lines.append(f"{key} {' '.join(values)}")
            if key == "v":
                corners.append(_numbers(values[:3], name, number))
        elif key == "f" and len(values) < 3:
            short.append(number)
        elif key == "f":
            faces.append((number, [_absolute(value, counts, name, number) for value in values]))
        elif key == "mtllib" and _leaves_folder(" ".join(values)):
            notes.append(
                PartlyReadFile(f"{name}: line {number}: {' '.join(line.split())}: outside the folder, not read")
            )
    if short:
        many = "1 face" if len(short) == 1 else f"{len(short)} faces"
        notes.append(PartlyReadFile(f"{name}: line {short[0]}: {many} with fewer than 3 corners left out from here on"))
    for number, face in faces:
        lines += _triangles(face, counts, corners, name, number)
    return "\n".join(lines), notes


def _numbers(values: list[str], name: str, line: int) -> list[float]:
    try:
        x, y, z = map(float, values)
    except ValueError:
        raise MeshError(f"{name}: line {line}: expected v with three numbers, got {' '.join(values)!r}") from None
    return [x, y, z]


def _absolute(corner: str, counts: dict[str, int], name: str, line: int) -> list[int]:
    """Return the numbers of v/vt/vn counted from 1; 0 where there is none; negative ones count back from this line."""
    result = []
    for part, key in zip(corner.split("/"), KEPT, strict=False):
        try:
            index = int(part or "0")
        except ValueError:
            raise MeshError(f"{name}: line {line}: expected whole numbers in a face, got {corner!r}") from None
        if part and index == 0:
            raise MeshError(f"{name}: line {line}: face {corner!r} uses number 0; OBJ counts from 1")
        result.append(index + counts[key] + 1 if index < 0 else index)
        if result[-1] < 0 or (index < 0 and result[-1] == 0):
            raise MeshError(f"{name}: line {line}: {key} {index} does not exist, only {counts[key]} stand before it")
    return result


def _triangles(
    face: list[list[int]], counts: dict[str, int], corners: list[list[float]], name: str, line: int
) -> list[str]:
    for corner in face:
        for index, key in zip(corner, KEPT, strict=False):
            if index > counts[key]:
                raise MeshError(f"{name}: line {line}: {key} {index} does not exist; expected 1 to {counts[key]}")
    words = ["/".join(str(index or "") for index in corner).rstrip("/") for corner in face]
    if len(face) == 3:
        return [f"f {words[0]} {words[1]} {words[2]}"]
    cut = cut_into_triangles([corners[corner[0] - 1] for corner in face])
    return [f"f {words[a]} {words[b]} {words[c]}" for a, b, c in cut]


def _leaves_folder(path: str) -> bool:
    parts = path.replace("\\", "/").split("/")
    return ".." in parts or parts[0] in ("", "~") or ":" in parts[0]
