"""Scene files: TOML, checked as a whole, so that one message names every mistake.

The example scenes in `docs/scenes` show all keys. Lengths are in scene units, angles in degrees, y points up.
"""

import tomllib
from os import PathLike
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from softshadow.errors import SceneError
from softshadow.scene.scene import Scene
from softshadow.scene.scene_schema import (
    CameraTable,
    Context,
    LightTable,
    MaterialTable,
    ObjectTable,
    ReceiverTable,
    SceneTable,
)
from softshadow.scene.validation_errors import mistakes

TABLES: dict[str, type[BaseModel]] = {
    "": SceneTable,
    "camera": CameraTable,
    "light": LightTable,
    "object": ObjectTable,
    "receiver": ReceiverTable,
    "materials": MaterialTable,
}


def load_scene(path: str | PathLike[str]) -> Scene:
    """Return the scene of a TOML file.

    Model files are named relative to the scene file and have to lie in its folder or below.

    Raises
    ------
    SceneError      the file cannot be read or is no TOML, or names each mistake in it with its place, the value and
                    what was expected
    """
    file = Path(path)
    tree = _read(file)
    materials = tree.get("materials", {})
    context = Context(file.parent, materials if isinstance(materials, dict) else {})
    try:
        table = SceneTable.model_validate(tree, context=context)
    except ValidationError as error:
        found = mistakes(error, TABLES)
        count = "1 mistake" if len(found) == 1 else f"{len(found)} mistakes"
        raise SceneError("\n  ".join([f"{file}: {count}", *found])) from None
    return Scene(
        file.stem,
        table.camera.built,
        [item.built for item in table.light],
        [*(item.built for item in table.receiver), *(item.built for item in table.object)],
        title=table.title or file.stem,
        ambient=table.ambient,
        background=table.background,
        notes=context.notes,
    )


def _read(file: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(file.read_bytes().decode("utf-8"))
    except OSError as error:
        raise SceneError(f"{file}: cannot be read ({error.strerror}); expected a scene file (TOML)") from None
    except UnicodeDecodeError as error:
        raise SceneError(f"{file}: byte {error.start} is not UTF-8; expected a scene file (TOML)") from None
    except tomllib.TOMLDecodeError as error:
        raise SceneError(f"{file}: not TOML: {error}") from None
