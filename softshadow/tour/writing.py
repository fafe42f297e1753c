"""Drawing all stops of the tour, and writing its folder."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

from softshadow import techniques
from softshadow.errors import SceneError, SoftShadowError
from softshadow.report import (
    TourPage,
    Visit,
    folder_writer,
    named,
    options_spelled,
    scene_spelled,
    sections,
    write_tour_page,
)
from softshadow.runs import Run, run
from softshadow.runs.perform import checked_size
from softshadow.scene import Scene
from softshadow.tour.folder import INDEX, move_tour, refuse_foreign_folder
from softshadow.tour.stops import STOPS, Stop


def write_tour(
    scene: Scene,
    size: tuple[int, int],
    folder: str | Path,
    force: bool = False,
    progress: Callable[[str], None] = lambda title: None,
    arguments: str | None = None,
) -> Path:
    """Draw all stops, write the folder, and return the path of its page. The folder is written whole or not at all.

    Stops whose technique refuses the scene (`SceneError`) are left out, and the page says why.

    Parameters
    ----------
    scene, size                  as for `run`
    folder : path                created if missing; an earlier tour in it is replaced
    force : bool                 write to a folder that holds other files; these stay, unless a file of the tour has the
                                 same name
    progress : callable          called with the title of each stop before it is drawn
    arguments : str              of the command line that draws this scene at this size

    Raises
    ------
    SoftShadowError              the folder holds files that are not of a tour, or cannot be written
    ValueError, StateError       the size is invalid, see `run`
    """
    target = Path(folder)
    size = checked_size(size)
    arguments = arguments or scene_spelled(scene, size)
    refuse_foreign_folder(target, force)
    try:
        # inside the target if it exists: files can be renamed only within one file system
        work = Path(tempfile.mkdtemp(prefix=".softshadow-", dir=target if target.is_dir() else target.parent))
    except OSError as error:
        raise SoftShadowError(f"{target}: the folder cannot be made ({error.strerror})") from None
    try:
        visits, left_out = [], []
        for stop in STOPS:
            progress(stop.title)
            try:
                result = run(stop.technique, scene, size, **stop.options)
            except SceneError as error:
                progress(f"{stop.title}: left out. {error}")
                left_out.append((stop.title, error))
                continue
            visits.append(_write_stop(stop, result, work, arguments))
        if not visits:
            raise left_out[0][1]
        reasons = [(title, str(error)) for title, error in left_out]
        write_tour_page(TourPage(scene, size, visits, reasons, arguments), work / INDEX)
        move_tour(work, target)
    except OSError as error:
        raise SoftShadowError(f"{target}: cannot be written ({error.strerror or error})") from None
    finally:
        shutil.rmtree(work, ignore_errors=True)
    return target / INDEX


def _write_stop(stop: Stop, result: Run, work: Path, arguments: str) -> Visit:
    """Write the pictures and buffers of a stop, and return what the page shows of it."""
    folder = work / stop.name
    folder.mkdir()
    write = folder_writer(folder)
    result.save(folder / "run.npz")
    return Visit(
        stop.name,
        stop.title,
        stop.look_at,
        write(result.image, "picture"),
        sections(result.steps, write),
        result.ledger.to_dicts(),
        named(result.warnings),
        f"{stop.name}/run.npz",
        techniques.get(stop.technique).paper,
        f"softshadow render {stop.technique} {arguments}{options_spelled(result.technique, result.options)}",
    )
