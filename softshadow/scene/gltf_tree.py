"""The JSON tree of a glTF 2 file, with its buffers read, and without references to any other file.

References
----------
Khronos Group, "glTF 2.0 specification", sections 3.6 (buffers), 3.7 (meshes), 4.4 (GLB container).
"""

import json
import struct
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from softshadow.errors import MeshError, PartlyReadFile

TRIANGLES, TRIANGLE_STRIP = 4, 5
GLB_MAGIC, JSON_CHUNK, BINARY_CHUNK = b"glTF", 0x4E4F534A, 0x004E4942
# required extensions that affect appearance only; any other may change the geometry
HARMLESS_EXTENSIONS = ("KHR_materials_", "KHR_texture_", "KHR_lights_", "EXT_texture_", "KHR_animation_")


def read_tree(data: bytes, name: str) -> tuple[dict[str, Any], bytes | None]:
    """Return the JSON tree of a .gltf or .glb file, and the binary chunk if it is a .glb.

    Raises
    ------
    MeshError      neither JSON nor a GLB container, truncated, or not version 2
    """
    binary = None
    text = data
    if data[:4] == GLB_MAGIC:
        chunks = _chunks(data, name)
        text = chunks.get(JSON_CHUNK, b"")
        binary = chunks.get(BINARY_CHUNK)
    try:
        tree = json.loads(text.decode("utf-8-sig"))
    except (UnicodeDecodeError, json.JSONDecodeError, RecursionError) as error:
        raise MeshError(f"{name}: expected a glTF 2 file (JSON, or GLB with a JSON chunk): {error}") from None
    version = tree.get("asset", {}).get("version") if isinstance(tree, dict) else None
    if str(version).split(".")[0] != "2":
        raise MeshError(f"{name}: asset.version: expected glTF 2.x, got {version!r}")
    return tree, binary


def _chunks(data: bytes, name: str) -> dict[int, bytes]:
    version = int.from_bytes(data[4:8], "little")
    if version != 2:
        raise MeshError(f"{name}: expected a GLB container of version 2, got version {version}")
    chunks: dict[int, bytes] = {}
    offset = 12
    while offset + 8 <= len(data):
        length, kind = struct.unpack_from("<II", data, offset)
        chunk = data[offset + 8 : offset + 8 + length]
        if len(chunk) < length:
            raise MeshError(f"{name}: a GLB chunk declares {length} bytes, but the file has only {len(chunk)} more")
        chunks.setdefault(kind, chunk)
        offset += 8 + length
    return chunks


def self_contained(
    tree: dict[str, Any], binary: bytes | None, path: Path
) -> tuple[dict[str, Any], dict[str, bytes], list[PartlyReadFile]]:
    """Return the tree without cameras, textures, skins and animations, and the content of its buffers.

    Texture coordinates and vertex colours are renamed to `_TEXCOORD_0` and `_COLOR_0`, which trimesh passes through
    unchanged.

    Parameters
    ----------
    path : Path          the model file; buffers are read only from its folder and below

    Returns
    -------
    tree, buffers, notes : `buffers` is keyed by the uri that the tree now uses; `notes` says what was left out

    Raises
    ------
    MeshError            a buffer is missing, too short or outside the folder; geometry in an unsupported form
    """
    for extension in tree.get("extensionsRequired", []):
        if not extension.startswith(HARMLESS_EXTENSIONS):
            raise MeshError(f"{path}: extensionsRequired: {extension} is not supported; expected plain glTF 2 geometry")
    notes = [
        PartlyReadFile(f"{path}: images[{index}].uri {image['uri']!r}: outside the folder, not read")
        for index, image in enumerate(tree.get("images", []))
        if "uri" in image and not image["uri"].startswith("data:") and not _inside(path.parent, image["uri"])
    ]
    buffers = {}
    for index, buffer in enumerate(tree.get("buffers", [])):
        uri = buffer.get("uri")
        if uri is None or not uri.startswith("data:"):
            buffers[f"buffer {index}"] = _buffer(buffer, index, binary, path)
            buffer["uri"] = f"buffer {index}"
    for index, accessor in enumerate(tree.get("accessors", [])):
        if "bufferView" not in accessor:
            raise MeshError(f"{path}: accessors[{index}]: sparse or without a bufferView; expected values in a buffer")

    for key in ("images", "textures", "samplers", "cameras", "skins", "animations"):
        tree.pop(key, None)
    for node in tree.get("nodes", []):
        node.pop("camera", None)  # trimesh drops the node of a camera and its children
    tree["materials"] = [_base_color(material) for material in tree.get("materials", [])]
    notes += _prepare_primitives(tree, path)
    if "scenes" not in tree:
        children = {child for node in tree.get("nodes", []) for child in node.get("children", [])}
        tree["scenes"] = [{"nodes": [index for index in range(len(tree.get("nodes", []))) if index not in children]}]
    return tree, buffers, notes


def _inside(folder: Path, uri: str) -> Path | None:
    """Return the file at a relative uri, or None if it lies outside the folder."""
    name = unquote(uri)
    if "://" in name or "\\" in name:
        return None
    file = (folder / name).resolve()
    return file if file.is_relative_to(folder.resolve()) else None


def _buffer(buffer: dict[str, Any], index: int, binary: bytes | None, path: Path) -> bytes:
    uri = buffer.get("uri")
    where = f"{path}: buffers[{index}]"
    if uri is None:
        if index or binary is None:
            raise MeshError(f"{where}: has no uri; expected a uri, or a GLB file with a binary chunk as buffer 0")
        data = binary
    else:
        file = _inside(path.parent, uri)
        if file is None:
            raise MeshError(f"{where}.uri {uri!r}: outside the folder, refused; expected a file beside the model")
        if not file.is_file():
            raise MeshError(f"{where}.uri {uri!r}: the file is missing; expected it beside the model")
        data = file.read_bytes()
    if len(data) < buffer["byteLength"]:
        raise MeshError(f"{where}: expected {buffer['byteLength']} bytes, got {len(data)}")
    return data


def _base_color(material: dict[str, Any]) -> dict[str, Any]:
    color = material.get("pbrMetallicRoughness", {}).get("baseColorFactor", [1, 1, 1, 1])
    return {"pbrMetallicRoughness": {"baseColorFactor": color}}


def _prepare_primitives(tree: dict[str, Any], path: Path) -> list[PartlyReadFile]:
    n_skipped = 0
    for mesh in tree.get("meshes", []):
        triangles = [item for item in mesh["primitives"] if item.get("mode", TRIANGLES) in (TRIANGLES, TRIANGLE_STRIP)]
        n_skipped += len(mesh["primitives"]) - len(triangles)
        mesh["primitives"] = triangles
        for primitive in triangles:
            primitive.pop("extensions", None)
            attributes = primitive["attributes"]
            for key in ("TEXCOORD_0", "COLOR_0"):
                if key in attributes:
                    attributes["_" + key] = attributes.pop(key)
    return [PartlyReadFile(f"{path}: {n_skipped} primitives of points, lines or fans left out")] if n_skipped else []
