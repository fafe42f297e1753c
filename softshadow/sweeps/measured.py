"""Draw one point of a sweep and measure it: a row of the table, and the picture as PNG."""

from __future__ import annotations

import hashlib
import os
import warnings
from dataclasses import replace
from functools import cache
from pathlib import Path

from softshadow.errors import Warning as SoftShadowWarning
from softshadow.inspection.files import MARK
from softshadow.inspection.pictures import png
from softshadow.pipeline import set_threads
from softshadow.pipeline.memory.threads import threads
from softshadow.runs import run
from softshadow.scene import Camera, Light, Scene
from softshadow.sweeps.errors_and_counts import counts, hard_errors, soft_errors
from softshadow.sweeps.frame_times import peak_from_here, peak_memory, timed
from softshadow.sweeps.point import MODEL_SUFFIXES, Point
from softshadow.sweeps.task import Result, Row, Work
from softshadow.testing.machine import machine

OTHERS = ("numpy", "numba", "python")


def measure(point: Point, scene: Scene | None = None) -> Result:
    """Draw a point and measure what it asks for; a point that fails becomes a row with its error.

    Parameters
    ----------
    scene : Scene                that of the point, if it has been loaded before; without its light and camera
    """
    row: Row = {**described(point), "status": "ok", "error": "", **measured_on(), "load_1min": load()}
    before = threads()
    try:
        return _measure(point, scene if scene is not None else load_scene(point.scene), row)
    except Exception as error:  # whatever it is, the other points go on
        return Result({**row, "status": "error", "error": f"{type(error).__name__}: {error}"}, None)
    finally:
        set_threads(before)


def load() -> float | None:
    """Return the mean number of busy processes on this machine in the last minute, where the system tells it."""
    return round(os.getloadavg()[0], 2) if hasattr(os, "getloadavg") else None


def described(point: Point) -> Row:
    """Return the columns that say what the point is."""
    places = {"light": (*point.light, *(1.0,) * (4 - len(point.light))) if point.light else ()}
    places |= {"eye": point.eye, "target": point.target}
    row: Row = {"technique": point.technique, "scene": point.scene}
    row |= {f"option_{name}": value for name, value in sorted(point.options.items())}
    row |= {"width_px": point.size[0], "height_px": point.size[1]}
    row |= {f"{name}_{axis}": n for name, at in places.items() for axis, n in zip("xyzw", at, strict=False)}
    row |= {"fov_degrees": point.fov} if point.fov else {}
    return row | {"threads": point.threads, "repetition": point.repetition}


@cache
def measured_on() -> Row:
    """Return the columns that say on what machine, and with which versions, a point was measured."""
    facts = machine(with_mesa=False)
    return {
        "machine": f"{facts['processor']}, {facts['cores']} cores, {facts['system']}",
        "versions": f"{MARK} " + ", ".join([facts["softshadow"], *(f"{name} {facts[name]}" for name in OTHERS)]),
    }


def load_scene(name: str) -> Scene:
    """Return the scene of a name, scene file or model file."""
    if name.lower().endswith(MODEL_SUFFIXES):
        return Scene.from_mesh(name)
    return Scene.load(name) if name.lower().endswith(".toml") else Scene.named(name)


def sent_scene(point: Point) -> Scene | None:
    """Return the scene of a file; None for a built-in one, which a worker has."""
    return load_scene(point.scene) if Path(point.scene).suffix else None


def placed(scene: Scene, point: Point) -> Scene:
    """Return a scene with the light and the camera of a point."""
    if point.light:
        scene = replace(scene, lights=(Light(point.light, name="light"),))
    camera = scene.camera
    if point.eye or point.target or point.fov:
        camera = Camera(
            point.eye or camera.eye, point.target or camera.target, camera.up, point.fov or camera.fov_y, camera.near,
            camera.far,
        )  # fmt: skip
    return replace(scene, camera=camera)


def _measure(point: Point, scene: Scene, row: Row) -> Result:
    scene = placed(scene, point)
    set_threads(point.threads)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SoftShadowWarning)  # the row has their names
        started = peak_from_here() if "memory" in point.measure else False
        drawn, times = timed(lambda: run(point.technique, scene, point.size, **point.options), point)
        row |= times
        row["warnings"] = " ".join(sorted({type(each).__name__ for each in drawn.warnings}))
        if "memory" in point.measure:
            row["peak_memory_MB"] = peak_memory() if started else None
        row["picture_sha256"] = hashlib.sha256(drawn.image.tobytes()).hexdigest()[:16]
        for name, columns in (("hard", hard_errors), ("soft", soft_errors), ("counts", counts)):
            if name in point.measure:
                row |= columns(drawn)
    return Result(row, png(drawn.image) if point.picture else None)


POINTS = Work(measure, described, sent_scene)
