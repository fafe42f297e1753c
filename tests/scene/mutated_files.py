"""Model and scene files with something wrong in them: good small ones, mutated by token, line and byte."""

import base64
import json
from typing import Any

import numpy as np

from softshadow.scene import shapes

TOKENS = [
    b"", b"nan", b"inf", b"-1", b"0", b"1e400", b"99999999999999999999", b"9" * 5000, b"x", b"1_0", b"0x1", b"\x00",
    b"\xef\xbc\x91", b"[", b"]" * 9, b"[" * 3000, b'"', b"{", b"#", b"a" * 7000, b"\xff\xfe", b"\\", b"/", b"1//",
    b"-9", b"=", b"3 3 3 3", b"\n", b"true", b"[[object]]", b"1.5", b"v", b"f", b"end_header", b"vertex", b"facet",
]  # fmt: skip
SCENE = b"""title = "small"
[camera]
eye = [0, 1, 5]
target = [0, 0, 0]
[[light]]
position = [1, 4, 1]
shape = "disc"
parameters = { radius = 0.5, normal = [0, -1, 0] }
[materials.red]
color = [1, 0, 0]
[[object]]
shape = "torus"
parameters = { sides = 5, segments = 6 }
material = "red"
turn = [30, 0, 1, 0]
[[receiver]]
corner = [-2, 0, -2]
across = [0, 0, 4]
up = [4, 0, 0]
"""


def good_files() -> dict[str, bytes]:
    """Return the contents of a small file of each type, by its ending; binary ones twice as likely wrong in a byte."""
    box = shapes.box()
    corners, faces = np.asarray(box.positions, "<f4"), np.asarray(box.triangles, "<i4")
    rows = "".join("{} {} {}\n".format(*row) for row in corners.tolist())
    indices = "".join("3 {} {} {}\n".format(*row) for row in faces.tolist())
    header = (
        "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    cells = corners[faces]
    facets = "".join(
        "facet normal 0 0 1\nouter loop\n" + "".join("vertex {} {} {}\n".format(*c) for c in t) + "endloop\nendfacet\n"
        for t in cells.tolist()
    )
    binary = b"".join(b"\x03" + row.tobytes() for row in faces)
    stl = b"".join(np.append(np.zeros(3, "<f4"), t).astype("<f4").tobytes() + b"\0\0" for t in cells)
    return {
        "obj": (
            "".join("v {} {} {}\n".format(*row) for row in corners.tolist())
            + "vt 0 0\nvn 0 0 1\n"
            + "".join("f {}/1/1 {}/1/1 {}/1/1\n".format(*row) for row in (faces + 1).tolist())
        ).encode(),
        "ascii.ply": (header.format("ascii", len(corners), len(faces)) + rows + indices).encode(),
        "ply": header.format("binary_little_endian", len(corners), len(faces)).encode() + corners.tobytes() + binary,
        "ascii.stl": f"solid box\n{facets}endsolid box\n".encode(),
        "stl": bytes(80) + len(faces).to_bytes(4, "little") + stl,
        "off": f"OFF\n{len(corners)} {len(faces)} 0\n{rows}{indices}".encode(),
        "gltf": json.dumps(gltf(corners, faces)).encode(),
        "toml": SCENE,
    }


def gltf(corners: np.ndarray, faces: np.ndarray) -> dict[str, Any]:
    """Return a glTF tree with its buffer inside."""
    data = corners.tobytes() + faces.astype("<u4").tobytes()
    return {
        "asset": {"version": "2.0"},
        "buffers": [{"uri": "data:;base64," + base64.b64encode(data).decode(), "byteLength": len(data)}],
        "bufferViews": [
            {"buffer": 0, "byteLength": corners.nbytes},
            {"buffer": 0, "byteOffset": corners.nbytes, "byteLength": 4 * faces.size},
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(corners), "type": "VEC3"},
            {"bufferView": 1, "componentType": 5125, "count": faces.size, "type": "SCALAR"},
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "nodes": [{"mesh": 0, "children": [1]}, {"translation": [1, 0, 0]}],
        "scenes": [{"nodes": [0]}],
    }


def mutated(content: bytes, rng: np.random.Generator) -> bytes:
    """Return a content with one to three things changed."""
    for _ in range(int(rng.integers(1, 4))):
        content = _changed(content, rng)
    return content


def _changed(content: bytes, rng: np.random.Generator) -> bytes:
    way = int(rng.integers(7))
    at = int(rng.integers(len(content) + 1))
    token = TOKENS[int(rng.integers(len(TOKENS)))]
    if way == 0:
        return content[:at]
    if way == 1:
        flipped = bytearray(content)
        for place in rng.integers(0, max(len(content), 1), 4 if content else 0):
            flipped[place] ^= 1 << rng.integers(8)
        return bytes(flipped)
    if way == 2:
        return content[:at] + token + content[at:]
    lines = content.split(b"\n")
    number = int(rng.integers(len(lines)))
    if way == 3:
        lines[number : number + 1] = [lines[number]] * int(rng.choice([0, 2, 300]))
    elif way == 4:
        other = int(rng.integers(len(lines)))
        lines[number], lines[other] = lines[other], lines[number]
    else:
        words = lines[number].split(b" ")
        words[int(rng.integers(len(words)))] = token
        lines[number] = b" ".join(words)
    return b"\n".join(lines)
