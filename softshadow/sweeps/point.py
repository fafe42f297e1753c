"""One point of a sweep: everything that is needed to draw it again, and the command line that does so."""

from __future__ import annotations

import hashlib
import json
import shlex
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

from softshadow.sweeps.task import package_digest

MEASURES = ("hard", "soft", "counts", "time", "memory")
MODEL_SUFFIXES = (".obj", ".ply", ".stl", ".off", ".glb", ".gltf")
Numbers = tuple[float, ...]


@dataclass(frozen=True)
class Point:
    """A technique on a scene, with options, and what is measured.

    Attributes
    ----------
    technique : str
    scene : str                  a scene name, a scene file (.toml) or a model file, which is put on a floor
    options : mapping            of the technique; the others keep their defaults
    size : (width, height)       pixels
    light : tuple of floats      (x, y, z) or (x, y, z, w), in place of the scene's lights; () keeps them
    eye, target : tuple of floats       of the camera, in place of the scene's; () keeps them
    fov : float                  vertical angle of view in degrees; 0 keeps the scene's
    threads : int                number of kernel threads
    frames : int                 number of timed frames
    repetition : int             number of the repetition, from 0
    measure : tuple of str       some of `MEASURES`
    picture : bool               whether the picture is stored
    """

    technique: str
    scene: str = "torus"
    options: Mapping[str, Any] = field(default_factory=dict)
    size: tuple[int, int] = (320, 240)
    light: Numbers = ()
    eye: Numbers = ()
    target: Numbers = ()
    fov: float = 0.0
    threads: int = 1
    frames: int = 1
    repetition: int = 0
    measure: tuple[str, ...] = ("hard", "counts", "time")
    picture: bool = False

    def __hash__(self) -> int:
        return hash(self.key)

    @property
    def scene_arguments(self) -> list[str]:
        """The words of a command line that describe scene, light, camera and size."""
        words = ["--mesh" if self.scene.lower().endswith(MODEL_SUFFIXES) else "--scene", self.scene]
        words += [f"--light={spelled(self.light)}"] if self.light else []
        words += [f"--{name}={spelled(at)}" for name, at in (("eye", self.eye), ("target", self.target)) if at]
        words += [f"--fov={self.fov!r}"] if self.fov else []
        return [*words, "--size", f"{self.size[0]}x{self.size[1]}"]

    @property
    def recipe(self) -> str:
        """The command line that draws this point again."""
        options = [word for key, value in self.options.items() for word in ("-O", f"{key}={value}")]
        return shlex.join(["softshadow", "render", self.technique, *self.scene_arguments, *options])

    @property
    def key(self) -> str:
        """A name for the point: equal for equal points, scene files and sources of this package, otherwise not."""
        facts = {**asdict(self), "options": sorted(self.options.items()), "package": package_digest()}
        if Path(self.scene).suffix:
            facts["file"] = file_digest(self.scene, Path(self.scene).stat().st_mtime_ns if exists(self.scene) else 0)
        return hashlib.sha256(json.dumps(facts, sort_keys=True, default=str).encode()).hexdigest()[:24]


def spelled(numbers: Numbers) -> str:
    """Return numbers as the command line takes them, such as "2,5,3"."""
    return ",".join(repr(float(number)).removesuffix(".0") for number in numbers)


def exists(path: str) -> bool:
    """Return whether a file can be read; a point whose file is missing becomes a row with an error."""
    return Path(path).is_file()


@cache
def file_digest(path: str, changed: int) -> str:
    """Return a digest of a file's bytes; `changed` is its time of change, so that an edit is noticed."""
    return hashlib.sha256(Path(path).read_bytes()).hexdigest() if exists(path) else "missing"
