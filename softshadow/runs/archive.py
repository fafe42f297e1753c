"""A run as an npz: its buffers under readable names, and the recording as JSON and arrays, without pickle."""

from __future__ import annotations

import json
import os
import zipfile
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import softshadow
from softshadow import errors
from softshadow.context import Frame
from softshadow.errors import SoftShadowError
from softshadow.inspection import Buffers, Maps, Replay, Step, Steps
from softshadow.inspection.files import DESCRIPTION
from softshadow.inspection.recording import Packer, Unpacker
from softshadow.scene import Scene

SCHEMA = 2
# the exceptions that reading a damaged file may raise
DAMAGED = (
    OSError,
    ValueError,
    KeyError,
    TypeError,
    IndexError,
    AttributeError,
    EOFError,
    zipfile.BadZipFile,
    zlib.error,
)


@dataclass(frozen=True, eq=False)
class RunRecord:
    """Everything that a run consists of; files are written from it."""

    technique: str
    scene: Scene | None
    options: Mapping[str, Any]
    warnings: tuple[errors.Warning, ...]
    steps: Steps
    frame: Frame


def write_npz(run: RunRecord, path: Path) -> None:
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
    last, maps = run.steps[-1], run.steps.maps
    arrays = {"image": last.image, "depth": last.depth, "stencil": last.stencil}
    arrays |= {name: maps[name] for name in ("visibility", "valid") if name in maps}
    for step in run.steps:
        arrays |= {f"steps/{step.index}/{name}": buffer for name, buffer in step.buffers._asdict().items()}
        arrays |= {f"maps/{step.index}/{name}": values for name, values in step.maps.items()}
    arrays |= {f"recording/{i}": array for i, array in enumerate(packer.arrays)}
    arrays[DESCRIPTION] = np.array(json.dumps(description))
    # as np.savez_compressed, but at the lowest level: half the time, a tenth more bytes
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, array in arrays.items():
            with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
                np.lib.format.write_array(member, np.asanyarray(array), allow_pickle=False)


def read_npz(path: str | os.PathLike[str]) -> RunRecord:
    """Return the run that `write_npz` wrote.

    Raises
    ------
    SoftShadowError              the file does not exist, or is not a run of this package
    """
    try:
        # opened here because NumPy does not close the file if the archive is damaged
        with open(path, "rb") as file, np.load(file, allow_pickle=False) as stored:
            return _record(stored, json.loads(str(stored[DESCRIPTION])))
    except FileNotFoundError:
        raise SoftShadowError(f"{path}: there is no such file") from None
    except DAMAGED as error:
        raise SoftShadowError(f"{path}: not a run that this package saved ({error})") from error


def _record(stored: Any, description: dict[str, Any]) -> RunRecord:
    if description["schema"] != SCHEMA:
        raise ValueError(f"schema {description['schema']}, this version reads {SCHEMA}")
    n_arrays = sum(name.startswith("recording/") for name in stored.files)
    unpacker = Unpacker(description["objects"], [stored[f"recording/{i}"] for i in range(n_arrays)])
    frame = unpacker.unpack(description["frame"])
    replay = Replay(frame)
    steps = []
    for index, names in enumerate(description["maps"]):
        replay.cache(index, Buffers(**_read(stored, f"steps/{index}", Buffers._fields)))
        steps.append(Step(index, frame.steps[index][0], Maps(_read(stored, f"maps/{index}", names)), frame, replay))
    return RunRecord(
        description["technique"],
        unpacker.unpack(description["scene"]),
        description["options"],
        tuple(unpacker.unpack(warning) for warning in description["warnings"]),
        Steps(steps),
        frame,
    )


def _read(stored: Any, folder: str, names: Iterable[str]) -> dict[str, np.ndarray]:
    arrays = {name: stored[f"{folder}/{name}"] for name in names}
    for array in arrays.values():
        array.setflags(write=False)
    return arrays
