"""One buffer or map of a run as a file: npz and EXR keep every value, PNG is the picture that reports show."""

from __future__ import annotations

import json
import os
import zipfile
from pathlib import Path
from typing import Any

import numpy as np

import softshadow
from softshadow.errors import SoftShadowError, nearest
from softshadow.inspection.files import DESCRIPTION, MARK, write_whole
from softshadow.inspection.pictures import depth_picture, map_pictures, save_png
from softshadow.inspection.step import Step, Steps

EXTENSIONS = (".npz", ".png", ".exr")
WINDOW = ("color", "depth", "stencil")
CHANNELS = {1: ("Y",), 3: ("R", "G", "B"), 4: ("R", "G", "B", "A")}
LARGEST_UINT = 2**32 - 1
BYTE = np.float32(255)


def buffer_names(steps: Steps) -> list[str]:
    """Return the names of what can be exported: the window's buffers and all maps."""
    return [*WINDOW, *steps.maps]


def buffer_of(steps: Steps, name: str, step: int | str | None = None) -> np.ndarray:
    """Return a buffer of the window after a step, or a map; by default after the last step that has it.

    Raises
    ------
    ValueError                   there is no such buffer or map, or not in this step; the message has the nearest name
    KeyError, IndexError         there is no such step
    """
    if name not in buffer_names(steps):
        raise ValueError(f"buffer {name!r}: {nearest(name, buffer_names(steps))}")
    if step is None:
        return _window(steps[-1], name) if name in WINDOW else steps.maps[name]
    chosen = steps[step]
    if name not in WINDOW and name not in chosen.maps:
        having = ", ".join(str(each.index) for each in steps if name in each.maps)
        raise ValueError(f"buffer {name!r}: step {chosen.index} has no such map; expected step {having}")
    return _window(chosen, name) if name in WINDOW else chosen.maps[name]


def _window(step: Step, name: str) -> np.ndarray:
    buffer: np.ndarray = getattr(step.buffers, name)
    return buffer


def check_extension(path: str | os.PathLike[str]) -> None:
    """Raise an error if a buffer cannot be written to such a file; called before a long drawing.

    Raises
    ------
    ValueError                   another file name extension
    SoftShadowError              EXR without the package for it
    """
    extension = Path(path).suffix.lower()
    if extension not in EXTENSIONS:
        raise ValueError(f"{path}: expected a name that ends in {', '.join(EXTENSIONS[:-1])} or {EXTENSIONS[-1]}")
    if extension == ".exr":
        exr_module()


def export(
    steps: Steps, name: str, path: str | os.PathLike[str], step: int | str | None = None, force: bool = False
) -> Path:
    """Write a buffer to a file, and return its path; see `Run.export`."""
    check_extension(path)
    values = buffer_of(steps, name, step)

    def write(file: Path) -> None:
        if file.suffix.lower() == ".png":
            save_png(picture_of(steps, name, values), file)
        elif file.suffix.lower() == ".npz":
            write_array(name, values, file)
        else:
            write_exr(name, values, file)

    return write_whole(Path(path), write, force)


def picture_of(steps: Steps, name: str, values: np.ndarray) -> np.ndarray:
    """Return the picture of a buffer: stencil values in their palette, depths as greys, maps as in reports."""
    if name == "depth":
        return depth_picture(values)
    if name in WINDOW:
        return values[..., :3] if name == "color" else values
    valid = steps.maps.get("valid")
    maps = {name: values} if valid is None or valid.shape != values.shape[:2] else {name: values, "valid": valid}
    return map_pictures(maps)[name]


def write_array(name: str, values: np.ndarray, path: Path) -> None:
    """Write an array to an npz under its name."""
    description = {"made by": f"softshadow {softshadow.__version__}", "buffer": name}
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for member, array in ((name, values), (DESCRIPTION, np.array(json.dumps(description)))):
            with archive.open(f"{member}.npy", "w", force_zip64=True) as file:
                np.lib.format.write_array(file, np.asanyarray(array), allow_pickle=False)


def exr_module() -> Any:
    """Return the package that writes EXR files.

    Raises
    ------
    SoftShadowError              it is not installed; the message says how to install it
    """
    try:
        import OpenEXR
    except ImportError:
        raise SoftShadowError("EXR files need OpenEXR: pip install 'softshadow[exr]'") from None
    return OpenEXR


def write_exr(name: str, values: np.ndarray, path: Path) -> None:
    """Write an array as an EXR, compressed without loss.

    Raises
    ------
    ValueError                   whole numbers that EXR does not have, negative ones or ones over 2**32 - 1
    """
    openexr = exr_module()
    header = {"type": openexr.scanlineimage, "compression": openexr.ZIP_COMPRESSION, "comments": f"{MARK} {name}"}
    with openexr.File(header, exr_channels(name, values)) as file:
        file.write(str(path))


def exr_channels(name: str, values: np.ndarray) -> dict[str, np.ndarray]:
    """Return the channels of an array (H, W) or (H, W, C).

    Colours of 8 bits become floats from 0 to 1, from which ``numpy.rint(255 * value)`` returns them exactly. Other
    whole numbers and truth values are UINT channels, floats are FLOAT channels.
    """
    is_color = values.ndim == 3 and values.dtype == np.uint8
    if is_color:
        values = values.astype(np.float32) / BYTE
    elif values.dtype.kind in "biu":
        if values.size and (int(values.min()) < 0 or int(values.max()) > LARGEST_UINT):
            raise ValueError(f"buffer {name!r}: EXR holds whole numbers from 0 to {LARGEST_UINT}; npz holds all")
        values = values.astype(np.uint32)
    else:
        values = values.astype(np.float32)
    if values.ndim == 2:
        return {{"depth": "Z", "stencil": "stencil"}.get(name, "Y"): np.ascontiguousarray(values)}
    channels = CHANNELS.get(values.shape[2]) or tuple(f"channel {i}" for i in range(values.shape[2]))
    return {channel: np.ascontiguousarray(values[..., i]) for i, channel in enumerate(channels)}
