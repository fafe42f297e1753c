"""A model file made into a mesh, and into a scene: on a floor, framed by the camera, lit from above."""

from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from softshadow.errors import PartlyReadFile, SceneError, nearest
from softshadow.scene import shapes
from softshadow.scene.camera import Camera
from softshadow.scene.lights import Light
from softshadow.scene.mesh import Mesh, vertex_normals
from softshadow.scene.model_file import Part, read_parts
from softshadow.scene.placement import placement
from softshadow.scene.scene import Material, Scene, SceneObject

MODEL_SIZE = 2.0  # largest extent of a model in the scene: lights and cameras then mean the same for every file
UPRIGHT = {"y": (0.0, 1.0, 0.0, 0.0), "z": (-90.0, 1.0, 0.0, 0.0)}


def load_mesh(path: str | PathLike[str]) -> tuple[Mesh, list[PartlyReadFile]]:
    """Return the mesh of an OBJ, PLY, STL, OFF, GLB or glTF file, and what of the file was left out.

    All bodies become one mesh in the file's own coordinates, scene graph transforms applied. Vertices are neither
    merged nor reordered. Normals, texture coordinates and colours (of vertices, faces, glTF base colours) are kept;
    textures and MTL materials are not read. No file outside the model's folder is opened.

    Raises
    ------
    MeshError      names the file, what is wrong in it and what was expected
    """
    file = Path(path)
    parts, notes = read_parts(file)
    starts = np.cumsum([0, *(len(part.positions) for part in parts[:-1])])
    positions = np.concatenate([part.positions for part in parts])
    triangles = np.concatenate([part.triangles + start for part, start in zip(parts, starts, strict=True)])
    mesh = Mesh(
        positions,
        triangles,
        _normals(parts, positions, triangles),
        _joined([part.texcoords for part in parts], parts, 0.0, 2),
        _joined([part.colors for part in parts], parts, 1.0, 4),
        name=str(file),
    )
    object.__setattr__(mesh, "name", file.name)
    return mesh, notes


def scene_from_mesh(
    path: str | PathLike[str], light: ArrayLike | Light = (2, 5, 3), *, up: str = "y", name: str = ""
) -> Scene:
    """Return a scene with a model file on a floor.

    The model is turned upright, scaled to a largest extent of 2, centred over the origin and put down on y = 0.

    Parameters
    ----------
    light : three or four numbers, or Light     a point, or with a fourth number 0 the direction towards the light
    up : "y" or "z"                             the file's axis that points up

    Raises
    ------
    MeshError                                   see `load_mesh`
    SceneError                                  unknown axis, malformed light
    """
    if up not in UPRIGHT:
        raise SceneError(f"up: unknown axis {up!r}; {nearest(up, UPRIGHT)}")
    mesh, notes = load_mesh(path)
    lamp = light if isinstance(light, Light) else Light(light)
    object_to_world = _put_down(mesh, UPRIGHT[up])
    model = SceneObject(mesh, object_to_world, Material((0.8, 0.65, 0.4) if mesh.colors is None else (1, 1, 1)))
    found = model.world_positions[np.unique(mesh.triangles)]
    floor = SceneObject(shapes.floor(8 * MODEL_SIZE), material=Material((0.85, 0.8, 0.7)), casts=False, receives=True)
    if model.name == floor.name:
        model = SceneObject(mesh, object_to_world, model.material, name="model")
    return Scene(
        name or Path(path).stem,
        _framing_camera(found),
        (lamp,),
        (floor, model),
        title=f"{mesh.name} on a floor",
        notes=notes,
    )


def _normals(parts: list[Part], positions: np.ndarray, triangles: np.ndarray) -> np.ndarray | None:
    """Return the file's normals at length 1, computed ones where it has none (or none of a usable length)."""
    given = _joined([part.normals for part in parts], parts, 0.0, 3)
    if given is None:
        return None
    length = np.linalg.norm(given, axis=1, keepdims=True)
    usable = np.isfinite(length) & (length > 0)
    computed = vertex_normals(positions, triangles)
    return np.where(usable, given / np.where(usable, length, 1), computed)


def _joined(arrays: list[np.ndarray | None], parts: list[Part], filler: float, width: int) -> np.ndarray | None:
    if all(array is None for array in arrays):
        return None
    return np.concatenate(
        [
            np.full((len(part.positions), width), filler) if array is None else array
            for array, part in zip(arrays, parts, strict=True)
        ]
    )


def _put_down(mesh: Mesh, turn: tuple[float, float, float, float]) -> np.ndarray:
    upright = placement(turn=turn)
    corners = np.array(np.meshgrid(*mesh.bounds.T)).reshape(3, 8)
    low = (upright[:3, :3] @ corners).min(axis=1)
    high = (upright[:3, :3] @ corners).max(axis=1)
    scale = MODEL_SIZE / (high - low).max()
    middle = (low + high) / 2
    foot = np.array([middle[0], low[1], middle[2]])
    return placement(move=-scale * foot, turn=turn, scale=scale)


def _framing_camera(points: np.ndarray) -> Camera:
    """Return a camera that looks down on the points, with room for the shadow around them.

    It stands at the front left: the default light comes from the front right, and shadows are seen from the side.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    target = (low + high) / 2
    radius = float(np.linalg.norm(points - target, axis=1).max())
    distance = 4.2 * radius  # the model then takes two thirds of the height at 40 degrees
    direction = np.array([-0.55, 0.5, 0.85])
    eye = target + distance * direction / np.linalg.norm(direction)
    # the lowest ray of the picture meets the floor further away than a fifth of the distance
    return Camera(eye, target, fov_y=40, near=0.2 * distance, far=distance + 16 * MODEL_SIZE)
