"""Scene files in TOML, checked as a whole, so that one message lists every mistake.

The example scenes in `docs/scenes` show all keys. Lengths are in scene units, angles in degrees, y points up.
"""

import tomllib
from os import PathLike
from pathlib import Path
from typing import Any

from softshadow.errors import SceneError
from softshadow.scene.scene import Scene
from softshadow.scene.validate import shortened

LARGEST_FILE = 1 << 24  # bytes; descriptions are short, and meshes lie in files of their own
MOST_LINES = 20  # of mistakes that one message lists


def load_scene(path: str | PathLike[str]) -> Scene:
    """Return the scene that a TOML file describes.

    Paths of model files are relative to the scene file, and must lie in its folder or below.

    Raises
    ------
    SceneError      the file cannot be read or is not TOML, or has mistakes: lists each with its place, the value and
                    what was expected
    """
    # imported here, because pydantic takes longer to load than the rest of the package's scenes
    from pydantic import ValidationError

    from softshadow.scene.scene_schema import TABLES, LoadContext, SceneTable
    from softshadow.scene.validation_errors import error_lines

    file = Path(path)
    tree = _read(file)
    materials = tree.get("materials", {})
    context = LoadContext(file.parent, materials if isinstance(materials, dict) else {})
    try:
        table = SceneTable.model_validate(tree, context=context)
    except ValidationError as error:
        lines = error_lines(error, TABLES)
        heading = f"{file}: {len(lines)} mistake{'' if len(lines) == 1 else 's'}"
        more = [f"and {len(lines) - MOST_LINES} more"] if len(lines) > MOST_LINES else []
        raise SceneError("\n  ".join([heading, *map(shortened, lines[:MOST_LINES]), *more])) from None
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
    expected = "expected a scene file (TOML)"
    try:
        if file.exists() and not file.is_file():
            raise SceneError(f"{file}: is {'a folder' if file.is_dir() else 'not a regular file'}; {expected}")
        if file.exists() and file.stat().st_size > LARGEST_FILE:
            raise SceneError(f"{file}: has {file.stat().st_size} bytes; expected at most {LARGEST_FILE}")
        return tomllib.loads(file.read_bytes().decode("utf-8-sig"))
    except OSError as error:
        raise SceneError(f"{file}: cannot be read ({error.strerror}); {expected}") from None
    except UnicodeDecodeError as error:
        raise SceneError(f"{file}: byte {error.start} is not UTF-8; {expected}") from None
    except RecursionError:
        raise SceneError(f"{file}: brackets in brackets, too deep to be read; {expected}") from None
    except ValueError as error:  # not TOML; a whole number of thousands of digits; a zero byte in the file's name
        raise SceneError(f"{file}: not TOML: {shortened(str(error))}") from None
