"""A run as an npz: its buffers under readable names, and the recording as JSON and arrays, without pickle."""

from __future__ import annotations

import json
import os
import zipfile
import zlib
from collections.abc import Mapping
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
from softshadow.inspection.validate_recording import validate_buffers, validate_frame, validate_map, validate_type
from softshadow.runs.members import read_members, write_members
from softshadow.scene import Scene

SCHEMA = 4
# the exceptions that reading a damaged file may raise: as an archive, and where its contents are those of another file
DAMAGED = (
    OSError, ValueError, KeyError, TypeError, IndexError, AttributeError, ArithmeticError, EOFError, RuntimeError,
    MemoryError, zipfile.BadZipFile, zlib.error,
)  # fmt: skip
LONGEST_REASON = 200  # characters


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
    write_members(path, arrays)


def read_npz(path: str | os.PathLike[str]) -> RunRecord:
    """Return the run that `write_npz` wrote.

    Raises
    ------
    SoftShadowError              the file does not exist, or is not a run of this package, as it was written
    """
    file = Path(path)
    if file.exists() and not file.is_file():
        raise SoftShadowError(f"{path}: not a regular file; expected a run that this package saved")
    try:
        stored = read_members(file)
        return _record(stored, json.loads(str(stored[DESCRIPTION])))
    except FileNotFoundError:
        raise SoftShadowError(f"{path}: there is no such file") from None
    except (SoftShadowError, *DAMAGED) as error:
        reason = f"{type(error).__name__}: {error}" if isinstance(error, KeyError | MemoryError) else str(error)
        reason = " ".join(reason.split())[:LONGEST_REASON]
        raise SoftShadowError(f"{path}: not a run that this package saved ({reason})") from error


def _record(stored: Mapping[str, np.ndarray], description: dict[str, Any]) -> RunRecord:
    if description["schema"] != SCHEMA:
        raise ValueError(f"schema {description['schema']}, this version reads {SCHEMA}")
    n_arrays = sum(name.startswith("recording/") for name in stored)
    unpacker = Unpacker(description["objects"], [stored[f"recording/{i}"] for i in range(n_arrays)])
    frame, scene = unpacker.unpack(description["frame"]), unpacker.unpack(description["scene"])
    warnings = tuple(unpacker.unpack(warning) for warning in description["warnings"])
    technique, options, maps = (description[key] for key in ("technique", "options", "maps"))
    validate_frame(frame)
    for value, kind in (
        (technique, str),
        (options, dict),
        (scene, Scene | None),
        (warnings, tuple[errors.Warning, ...]),
    ):
        validate_type("the run", value, kind)
    if len(maps) != len(frame.steps):
        raise ValueError(f"{len(frame.steps)} steps with the maps of {len(maps)}")
    replay = Replay(frame)
    run_name = f"{technique} on {scene.name}" if scene is not None else technique
    steps = []
    for index, names in enumerate(maps):
        buffers = Buffers(*(stored[f"steps/{index}/{name}"] for name in Buffers._fields))
        validate_buffers(frame, buffers)
        replay.cache(index, buffers)
        own_maps = {name: stored[f"maps/{index}/{name}"] for name in names}
        for name, values in own_maps.items():
            validate_map(frame, name, values)
        steps.append(Step(index, frame.steps[index][0], Maps(own_maps), frame, replay, run_name))
    return RunRecord(technique, scene, options, warnings, Steps(steps), frame)
