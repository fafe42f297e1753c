"""Runs as files: a picture, a folder of pictures, a report, or an npz that holds all and is read without pickle."""

from __future__ import annotations

import importlib
import json
import os
import re
import zipfile
import zlib
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import softshadow
from softshadow import errors
from softshadow.context import Frame
from softshadow.errors import SoftShadowError
from softshadow.inspection.files import DESCRIPTION, MARK, refuse_foreign, write_whole
from softshadow.inspection.pictures import (
    color_picture,
    depth_picture,
    map_pictures,
    save_png,
    sheet_of,
    stencil_picture,
    visibility_picture,
)
from softshadow.inspection.recording import Packer, Unpacker
from softshadow.inspection.replay import Buffers
from softshadow.scene import Scene

if TYPE_CHECKING:
    from softshadow.run import Run

SCHEMA = 2
# what reading a damaged file may raise
BROKEN = (OSError, ValueError, KeyError, TypeError, IndexError, AttributeError, EOFError)
ENDINGS = (".png", ".npz", ".html")


def save(run: Run, path: str | os.PathLike[str], force: bool) -> Path:
    """Write a run in the form that the ending of the path asks for; see `Run.save`."""
    target = Path(path)
    if is_folder(path):
        return save_folder(run, target, force)
    refuse(path, force)
    return write_whole(target, lambda temporary: write_file(run, temporary), force)


def is_folder(path: str | os.PathLike[str]) -> bool:
    """Return whether a path names a folder: there is one, or it ends as the name of one.

    A `Path` has lost the slash that it was made with, so one without an ending is a folder.
    """
    lost = isinstance(path, Path) and not path.suffix and not path.exists()
    return lost or str(path).endswith(("/", os.sep)) or Path(path).is_dir()


def refuse(path: str | os.PathLike[str], force: bool) -> None:
    """Make sure that a run may be saved there: to be asked before a long drawing.

    Raises
    ------
    ValueError                   an ending that is none of a run's
    SoftShadowError              see `refuse_foreign`; the files of a folder are looked at when they have names
    """
    if is_folder(path):
        return
    if Path(path).suffix.lower() not in ENDINGS:
        raise ValueError(f"{path}: expected an ending of {', '.join(ENDINGS)}, or a folder (a path that ends in /)")
    refuse_foreign(Path(path), force)


def write_file(run: Run, path: Path) -> None:
    """Write one file; its ending says what."""
    if path.suffix.lower() == ".png":
        save_png(color_picture(run.image), path)
    elif path.suffix.lower() == ".npz":
        write_npz(run, path)
    else:
        # the report stands floors above, on the run itself; nothing else reaches up
        importlib.import_module("softshadow.report").write(run, path)


# -- folder ------------------------------------------------------------------------------------------------------------
def save_folder(run: Run, folder: Path, force: bool) -> Path:
    """Write pictures of every step, their GL state as text, and the npz into a folder, which is made."""
    pictures = {"image.png": color_picture(run.image), "steps.png": sheet_of(run.steps)}
    if "visibility" in run.maps:
        pictures["visibility.png"] = visibility_picture(run.visibility, run.maps.get("valid"))
    for step in run.steps:
        start = f"{step.index:02d}-{file_name(step.title)}"
        pictures[f"{start}-image.png"] = color_picture(step.image)
        pictures[f"{start}-depth.png"] = depth_picture(step.depth)
        pictures[f"{start}-stencil.png"] = stencil_picture(step.stencil)
        for name, picture in map_pictures(step.maps).items():
            pictures[f"{start}-{file_name(name)}.png"] = picture
    text = f"{MARK} {softshadow.__version__}\n" + "\n".join(
        f"\n# step {step.index}: {step.title}\n{step.state}" for step in run.steps
    )
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise SoftShadowError(f"{folder}: the folder cannot be made ({error.strerror})") from None
    for name in (*pictures, "state.txt", "run.npz"):  # all of them before the first is written
        refuse_foreign(folder / name, force)
    for name, picture in pictures.items():
        write_whole(folder / name, partial(save_png, picture), force)
    write_whole(folder / "state.txt", lambda path: path.write_text(text + "\n", encoding="utf-8"), force)
    write_whole(folder / "run.npz", lambda path: write_npz(run, path), force)
    return folder


def file_name(title: str) -> str:
    """Return a title as a part of a file name.

    Examples
    --------
    >>> file_name("add the light: lamp 1")
    'add-the-light-lamp-1'
    """
    return re.sub(r"[^\w]+", "-", title).strip("-").lower()


# -- npz ---------------------------------------------------------------------------------------------------------------
@dataclass(frozen=True, eq=False)
class Contents:
    """What an npz holds: everything a run is made of."""

    technique: str
    options: dict[str, Any]
    scene: Scene
    frame: Frame
    warnings: tuple[errors.Warning, ...]
    maps: list[dict[str, np.ndarray]]
    buffers: list[Buffers]


def write_npz(run: Run, path: Path) -> None:
    """Write buffers and maps of every step under readable names, and the recording beside them."""
    packer = Packer()
    description = {
        "made by": f"softshadow {softshadow.__version__}",
        "schema": SCHEMA,
        "technique": run.technique,
        "options": dict(run.options),
        "maps": [list(step.maps) for step in run.steps],
        "warnings": [packer.pack(warning) for warning in run.warnings],
        "scene": packer.pack(run.scene),
        "frame": packer.pack(run.frame),
        "objects": packer.objects,
    }
    arrays = {"image": run.image, "depth": run.depth, "stencil": run.stencil}
    arrays |= {name: run.maps[name] for name in ("visibility", "valid") if name in run.maps}
    for step in run.steps:
        arrays |= {f"steps/{step.index}/{name}": plane for name, plane in step.buffers._asdict().items()}
        arrays |= {f"maps/{step.index}/{name}": values for name, values in step.maps.items()}
    arrays |= {f"recording/{i}": array for i, array in enumerate(packer.arrays)}
    arrays[DESCRIPTION] = np.array(json.dumps(description))
    # what np.savez_compressed does, at the lowest level: half the time, a tenth more bytes
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, array in arrays.items():
            with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
                np.lib.format.write_array(member, np.asanyarray(array), allow_pickle=False)


def load(path: str | os.PathLike[str]) -> Contents:
    """Read what `write_npz` wrote; see `load_run`."""
    try:
        # opened here: NumPy leaves the file of a damaged archive open
        with open(path, "rb") as file, np.load(file, allow_pickle=False) as stored:
            description = json.loads(str(stored[DESCRIPTION]))
            if description["schema"] != SCHEMA:
                raise SoftShadowError(f"{path}: schema {description['schema']}, this version reads {SCHEMA}")
            recorded = sum(name.startswith("recording/") for name in stored.files)
            unpacker = Unpacker(description["objects"], [stored[f"recording/{i}"] for i in range(recorded)])
            return Contents(
                description["technique"],
                description["options"],
                unpacker.unpack(description["scene"]),
                unpacker.unpack(description["frame"]),
                tuple(unpacker.unpack(warning) for warning in description["warnings"]),
                [_read(stored, f"maps/{i}", names) for i, names in enumerate(description["maps"])],
                [Buffers(**_read(stored, f"steps/{i}", Buffers._fields)) for i in range(len(description["maps"]))],
            )
    except FileNotFoundError:
        raise SoftShadowError(f"{path}: there is no such file") from None
    except (*BROKEN, zipfile.BadZipFile, zlib.error) as error:
        raise SoftShadowError(f"{path}: not a run that this package saved ({error})") from error


def _read(stored: Any, folder: str, names: Any) -> dict[str, np.ndarray]:
    arrays = {name: stored[f"{folder}/{name}"] for name in names}
    for array in arrays.values():
        array.setflags(write=False)
    return arrays
