"""`animate`: draw the frames of a film, each a task of its own, and put them together."""

from __future__ import annotations

import operator
import os
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from zipfile import BadZipFile

from softshadow import errors, techniques
from softshadow.errors import SoftShadowError
from softshadow.runs.issue_once import issue_once
from softshadow.runs.perform import checked_size, memory
from softshadow.scene import Scene
from softshadow.sweeps.execution import Engine, Progress, engine_for, execute
from softshadow.sweeps.films.changes import (
    Change,
    camera_change,
    changed_options,
    light_change,
    moves_of,
    option_change,
)
from softshadow.sweeps.films.film import Film
from softshadow.sweeps.films.frame import FILES, DrawnFrame, Frame, described, draw_frame, drawn_frame, scene_digest
from softshadow.sweeps.films.layout import Layout
from softshadow.sweeps.films.panels import depth_limits
from softshadow.sweeps.films.writers import LARGEST_RATE
from softshadow.sweeps.journal import Journal
from softshadow.sweeps.task import Result, Work
from softshadow.techniques import Technique

SHARE_OF_MEMORY = 0.5  # that the panels and pictures of a film may take


def animate(
    technique: str | Technique | Callable[..., Any],
    scene: Scene | str,
    size: tuple[int, int] = (320, 240),
    *,
    light_path: Any = None,
    camera_path: Any = None,
    vary: str | Iterable[str] = (),
    frames: int = 48,
    of_light: str | None = None,
    show: str | Iterable[str] = "color",
    steps: bool = False,
    captions: bool = True,
    rate: int = 24,
    poster_frame: int | None = None,
    workers: int | None = 1,
    scheduler: str | None = None,
    journal: str | os.PathLike[str] | None = None,
    resume: bool = False,
    report: Callable[[Progress], Any] = lambda progress: None,
    started: Callable[[str | None], Any] = lambda dashboard: None,
    **options: Any,
) -> Film:
    """Draw a film: a technique again and again while a light, the camera or options change.

    Parameters
    ----------
    technique, scene, options    as in `run`; values that change are set with `vary`
    size : (width, height)       of each panel, in pixels
    light_path, camera_path      where the light and the camera's eye stand: a text such as "orbit", "circle:0,4,0,3",
                                 "line:-2,4,1:2,4,1" or "points:2,4,1:0,5,2:-2,4,1"; a TOML file; or points (N, 3)
    vary : str or several        options that change: "units=0..8", "map_size=32..1024:log" or "cull=none,front,back"
    frames : int                 how many, at least 2
    of_light : str               which light moves; the first by default
    show : str or several        "color", "depth", "stencil" or names of maps, side by side
    steps : bool                 show them after every step, side by side
    captions : bool              write below the picture what changes
    rate : int                   frames per second, 1 to 50
    poster_frame : int           stands for the film where it does not play; the middle one by default
    workers : int | None         1: in this process; more: so many processes; None: one for each core
    scheduler : str              address of a Dask scheduler that runs already, such as "tcp://host:8786"
    journal : path               where each frame is kept as soon as it is drawn, with a folder beside it
    resume : bool                go on with the journal that is there: no frame is drawn twice
    report : callable            called with a `Progress` at the beginning and after every frame
    started : callable           called with the address of the cluster's page, or None, when it is ready

    Raises
    ------
    ValueError, TypeError        as `run`; nothing that changes; a change of what does not exist
    SceneError                   a path that is wrong
    SoftShadowError              a frame that the technique cannot draw (the message tells which); a journal exists, or
                                 cannot be written; the scheduler is lost
    """
    technique = techniques.get(technique)
    scene = Scene.named(scene) if isinstance(scene, str) else scene
    if not isinstance(scene, Scene):
        raise TypeError(f"scene={scene!r}: expected a Scene or the name of one")
    n_frames = _whole("frames", frames, 2)
    rate = _whole("rate", rate, 1, LARGEST_RATE)
    poster = n_frames // 2 if poster_frame is None else _whole("poster_frame", poster_frame, 0, n_frames - 1)
    shown = _texts(show)
    if not shown:
        raise ValueError("show: expected color, depth, stencil or the name of a map")
    changes = _changes(technique, scene, light_path, camera_path, _texts(vary), n_frames, of_light)
    _refuse_fixed(changes, options)
    texts = [[change.labels[frame] for change in changes] for frame in range(n_frames)]
    here = scheduler is None and workers == 1
    digest, panel_size = scene_digest(scene), checked_size(size)
    tasks = [
        Frame(
            technique, digest, moves_of(changes, frame),
            technique.validate_options({**options, **changed_options(changes, frame)}), panel_size, shown, steps,
            f"frame {frame} ({', '.join(texts[frame])})", None if here else 1,
        )
        for frame in range(n_frames)
    ]  # fmt: skip
    work = Work(draw_frame, described, lambda frame: scene)
    with TemporaryDirectory() as folder, engine_for(work, scheduler, workers) as (engine, count_workers, dashboard):
        started(dashboard)
        place = Path(folder) / "film.journal" if journal is None else Path(journal)
        rows = execute(
            tasks, place, _all_or_none(engine, n_frames), resume=resume, report=report, workers=count_workers,
            files=FILES,
        )  # fmt: skip
        read = {row["key"]: _read(row, Journal(place, FILES)) for row in {row["key"]: row for row in rows}.values()}
    drawn = [read[row["key"]] for row in rows]  # equal frames are one
    limits = depth_limits(panel for frame in drawn for panel in frame.panels)
    layout = Layout([frame.panels for frame in drawn], texts if captions else [], panel_size)
    pictures = [layout.picture(number, frame.panels, limits) for number, frame in enumerate(drawn)]
    raised = one_of_each([frame.warnings for frame in drawn])
    for message in raised:
        issue_once(message, sys._getframe(1))
    captions_of = tuple(", ".join(parts) for parts in texts)
    return Film(technique.name, scene.name, pictures, changes, captions_of, rate, poster, raised)


def _changes(
    technique: Technique, scene: Scene, light_path: Any, camera_path: Any, vary: Sequence[str], n_frames: int,
    of_light: str | None,
) -> tuple[Change, ...]:  # fmt: skip
    if of_light is not None and light_path is None:
        raise ValueError(f"of_light={of_light!r}: expected a light_path, too")
    changes = [option_change(technique, text, n_frames) for text in vary]
    if light_path is not None:
        changes.append(light_change(scene, light_path, n_frames, of_light))
    if camera_path is not None:
        changes.append(camera_change(scene, camera_path, n_frames))
    if not changes:
        raise ValueError("nothing changes from frame to frame; expected light_path, camera_path or vary")
    return tuple(changes)


def _refuse_fixed(changes: Sequence[Change], options: dict[str, Any]) -> None:
    names = [change.name for change in changes if change.target == "option"]
    for name in names:
        if name in options:
            raise ValueError(f"option {name!r}: is fixed to {options[name]!r} and varied, too; expected one of both")
        if names.count(name) > 1:
            raise ValueError(f"vary: option {name!r} is given twice")


def _texts(value: str | Iterable[str]) -> tuple[str, ...]:
    return (value,) if isinstance(value, str) else tuple(value)


def _whole(name: str, value: Any, smallest: int, largest: int | None = None) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name}={value!r}: expected a whole number") from None
    if number < smallest or (largest is not None and number > largest):
        limits = f"of at least {smallest}" if largest is None else f"from {smallest} to {largest}"
        raise ValueError(f"{name}={value!r}: expected a whole number {limits}")
    return number


# -- drawing -----------------------------------------------------------------------------------------------------------
def _all_or_none(engine: Engine, n_frames: int) -> Engine:
    """Return an engine that ends with an error at the first frame that cannot be drawn: a film needs all of them."""

    def draw(tasks: Sequence[Frame]) -> Iterator[tuple[Frame, Result]]:
        checked = False
        for task, result in engine(tasks):
            if result.file is None:
                raise _error_of(task, result.row["error"])
            if not checked:
                _check_memory(drawn_frame(result.row, result.file), n_frames)
                checked = True
            yield task, result

    return draw


def _error_of(frame: Frame, text: str) -> Exception:
    """Return the error of a frame: for a wrong argument that error itself, else one that tells the frame."""
    kind, _, said = text.partition(": ")
    if kind in ("ValueError", "TypeError"):
        return {"ValueError": ValueError, "TypeError": TypeError}[kind](said)
    known = isinstance(getattr(errors, kind, None), type)
    return SoftShadowError(f"{frame.label}: {said if known else text}")


def _check_memory(frame: DrawnFrame, n_frames: int) -> None:
    width_by_height = sum(panel.values.shape[0] * panel.values.shape[1] for panel in frame.panels)
    needed = n_frames * (sum(panel.values.nbytes for panel in frame.panels) + 3 * width_by_height)
    if needed > SHARE_OF_MEMORY * memory():
        raise SoftShadowError(
            f"{n_frames} frames of {len(frame.panels)} pictures need about {needed / 1e9:.1f} GB and this machine has "
            f"{memory() / 1e9:.1f}; expected fewer frames, or a smaller size"
        )


def _read(row: dict[str, Any], journal: Journal) -> DrawnFrame:
    """Return a frame from its journal."""
    file = journal.file_of(row["key"])
    try:
        return drawn_frame(row, file.read_bytes())
    except (OSError, ValueError, KeyError, BadZipFile) as error:
        raise SoftShadowError(
            f"{file}: the frame cannot be read ({error}); delete {journal.path} and this folder to draw all anew"
        ) from None


def one_of_each(by_frame: Sequence[Sequence[errors.Warning]]) -> tuple[errors.Warning, ...]:
    """Return the first warning of each kind of all frames; its text tells in which frames there are warnings of it."""
    first: dict[type[errors.Warning], tuple[int, errors.Warning]] = {}
    counts: dict[type[errors.Warning], int] = {}
    for number, raised in enumerate(by_frame):
        for message in raised:
            first.setdefault(type(message), (number, message))
        for kind in {type(message) for message in raised}:
            counts[kind] = counts.get(kind, 0) + 1
    texts = {
        kind: f"{message}"
        if counts[kind] == len(by_frame)
        else f"frame {number}: {message} (in {counts[kind]} of {len(by_frame)} frames)"
        for kind, (number, message) in first.items()
    }
    return tuple(kind(text) for kind, text in texts.items())
