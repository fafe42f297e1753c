"""Drawing all stops of the tour, and writing its folder."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from softshadow import techniques
from softshadow.errors import SceneError
from softshadow.gallery import GALLERY
from softshadow.inspection import compare
from softshadow.inspection.files import write_folder
from softshadow.inspection.hard_truth import hard_visibility
from softshadow.inspection.pictures import UNDEFINED
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
from softshadow.tour.folder import INDEX, is_tour, refuse_foreign_folder
from softshadow.tour.stops import STOPS, Stop

TOO_DARK, TOO_BRIGHT, SAME = (0xB3, 0x26, 0x1E), (0x00, 0x5C, 0x94), (0xEE, 0xEE, 0xEE)  # in pictures of differences


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

    def write(work: Path) -> None:
        visits, left_out = [], []
        truth = hard_visibility(scene, size)
        for stop in STOPS:
            progress(stop.title)
            try:
                result = run(stop.technique, scene, size, **stop.options)
            except SceneError as error:
                progress(f"{stop.title}: left out. {error}")
                left_out.append((stop.title, error))
                continue
            visits.append(_write_stop(stop, result, truth, work, arguments))
        if not visits:
            raise left_out[0][1]
        reasons = [(title, str(error)) for title, error in left_out]
        write_tour_page(TourPage(scene, size, visits, reasons, arguments), work / INDEX)

    was_tour = target.is_dir() and is_tour(target)
    write_folder(target, write, lambda entry: was_tour)
    return target / INDEX


def _write_stop(
    stop: Stop, result: Run, truth: tuple[list[np.ndarray], np.ndarray], work: Path, arguments: str
) -> Visit:
    """Write the pictures, buffers and report of a stop, and return what the page shows of it."""
    folder = work / stop.name
    folder.mkdir()
    write = folder_writer(folder)
    result.save(folder / "run.npz")
    result.save(folder / "run.html")
    error, words = _error(result, truth)
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
        f"{stop.name}/run.html",
        write(error, "error") if error is not None else "",
        words,
        [(failure.name, failure.title) for failure in GALLERY.values() if failure.technique == stop.technique],
    )


def _error(result: Run, truth: tuple[list[np.ndarray], np.ndarray]) -> tuple[np.ndarray | None, str]:
    """Return a picture of where a run is darker or brighter than hard shadows, and the number of such pixels."""
    if "visibility" not in result.maps or "valid" not in result.maps:
        return None, "no visibility to compare"
    visibilities, seen = truth
    reference = np.asarray(np.mean(visibilities, axis=0, dtype=np.float32))
    comparison = compare(result.visibility, result.valid, reference, seen, "ray casting")
    amount = np.abs(comparison.error)[..., None]
    strong = np.where(comparison.error[..., None] < 0, np.array(TOO_DARK), np.array(TOO_BRIGHT))
    plain = np.where(comparison.compared[..., None], np.array(SAME), np.array(UNDEFINED))
    picture = np.rint(plain + amount * (strong - plain)).astype(np.uint8)
    return picture, f"{np.count_nonzero(comparison.error)} of {int(comparison.compared.sum())} pixels differ"
