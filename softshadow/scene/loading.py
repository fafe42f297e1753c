"""A model file as a mesh, or as a scene: on a floor, framed by the camera, lit from above."""

import warnings
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from softshadow.errors import PartlyReadFile, SceneError, nearest
from softshadow.scene import shapes
from softshadow.scene.camera import Camera
from softshadow.scene.lights import Light
from softshadow.scene.mesh import Mesh, vertex_normals
from softshadow.scene.placement import placement
from softshadow.scene.scene import Material, Scene, SceneObject

if TYPE_CHECKING:
    from softshadow.scene.model_file import ModelPart

MODEL_SIZE = 2.0  # largest extent of a model in the scene, so that one light position suits every file
TURN_UPRIGHT = {"y": (0.0, 1.0, 0.0, 0.0), "z": (-90.0, 1.0, 0.0, 0.0)}


def load_mesh(path: str | PathLike[str]) -> tuple[Mesh, list[PartlyReadFile]]:
    """Return the mesh of an OBJ, PLY, STL, OFF, GLB or glTF file, and warnings about what was left out.

    All bodies become one mesh in the coordinate system of the file, with the transforms of its scene graph applied.
    Vertices are neither merged nor reordered. Normals, texture coordinates and colours (of vertices, faces or glTF
    materials) are read; textures and MTL materials are not. No file outside the model's folder is opened.

    Raises
    ------
    MeshError      names the file, what is wrong in it and what was expected
    """
    from softshadow.scene.model_file import read_parts  # most programs load no model file

    file = Path(path)
    parts, notes = read_parts(file)
    starts = np.cumsum([0, *(len(part.positions) for part in parts[:-1])])
    positions = np.concatenate([part.positions for part in parts])
    triangles = np.concatenate([part.triangles + start for part, start in zip(parts, starts, strict=True)])
    mesh = Mesh(
        positions,
        triangles,
        _normals(parts, positions, triangles),
        _concatenated([part.texcoords for part in parts], parts, 0.0, 2),
        _concatenated([part.colors for part in parts], parts, 1.0, 4),
        name=str(file),  # for the messages of its checks
    )
    object.__setattr__(mesh, "name", file.name)
    return mesh, notes


def mesh_from_file(path: str | PathLike[str]) -> Mesh:
    """Return the mesh of an OBJ, PLY, STL, OFF, GLB or glTF file, in the coordinate system of the file.

    All bodies become one mesh. Normals, texture coordinates and colours are read; textures and MTL materials are not,
    and `PartlyReadFile` warns of anything else that is left out. No file outside the model's folder is opened.

    Raises
    ------
    MeshError      names the file, what is wrong in it and what was expected
    """
    mesh, notes = load_mesh(path)
    for note in notes:
        warnings.warn(note, stacklevel=2)
    return mesh


def scene_from_mesh(
    path: str | PathLike[str], light: ArrayLike | Light = (2, 5, 3), *, up: str = "y", name: str = ""
) -> Scene:
    """Return a scene that shows a model file on a floor, with a camera that frames it.

    The model is turned upright, scaled to a largest extent of 2, centred over the origin and placed on y = 0.

    Parameters
    ----------
    light : three or four numbers, or Light     a point; or, with 0 as fourth number, the direction towards the light
    up : "y" or "z"                             the file's axis that points up

    Raises
    ------
    MeshError                                   see `load_mesh`
    SceneError                                  unknown axis, malformed light
    """
    if up not in TURN_UPRIGHT:
        raise SceneError(f"up: unknown axis {up!r}; {nearest(up, TURN_UPRIGHT)}")
    mesh, notes = load_mesh(path)
    source = light if isinstance(light, Light) else Light(light)
    object_to_world = _stand_on_floor(mesh, TURN_UPRIGHT[up])
    model = SceneObject(mesh, object_to_world, Material((0.8, 0.65, 0.4) if mesh.colors is None else (1, 1, 1)))
    floor = SceneObject(shapes.floor(8 * MODEL_SIZE), material=Material((0.85, 0.8, 0.7)), casts=False, receives=True)
    if model.name == floor.name:
        model = SceneObject(mesh, object_to_world, model.material, name="model")
    return Scene(
        name or Path(path).stem,
        _framing_camera(model.world_positions[np.unique(mesh.triangles)]),
        (source,),
        (floor, model),
        title=f"{mesh.name} on a floor",
        notes=notes,
    )


def _normals(parts: "list[ModelPart]", positions: np.ndarray, triangles: np.ndarray) -> np.ndarray | None:
    """Return the file's normals scaled to length 1, and computed ones where they are missing or have no length."""
    normals = _concatenated([part.normals for part in parts], parts, 0.0, 3)
    if normals is None:
        return None
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    usable = np.isfinite(length) & (length > 0)
    computed = vertex_normals(positions, triangles)
    return np.where(usable, normals / np.where(usable, length, 1), computed)


def _concatenated(
    arrays: list[np.ndarray | None], parts: "list[ModelPart]", filler: float, width: int
) -> np.ndarray | None:
    """Return the arrays as one, with rows of `filler` for a part that has none; None if no part has one."""
    if all(array is None for array in arrays):
        return None
    return np.concatenate(
        [
            np.full((len(part.positions), width), filler) if array is None else array
            for array, part in zip(arrays, parts, strict=True)
        ]
    )


def _stand_on_floor(mesh: Mesh, turn: tuple[float, float, float, float]) -> np.ndarray:
    """Return the matrix that turns the mesh, scales it to MODEL_SIZE and places it on y = 0 over the origin."""
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

    It stands at the front left and the default light at the front right, so that shadows are seen from the side.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    target = (low + high) / 2
    radius = float(np.linalg.norm(points - target, axis=1).max())
    distance = 4.2 * radius  # at 40 degrees the model fills two thirds of the height
    direction = np.array([-0.55, 0.5, 0.85])
    eye = target + distance * direction / np.linalg.norm(direction)
    # the lowest ray of the picture hits the floor beyond 0.2 times the distance
    return Camera(eye, target, fov_y=40, near=0.2 * distance, far=distance + 16 * MODEL_SIZE)
