"""Saving a run: as a picture, as an npz, as a report, as geometry, or as a folder of pictures."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import softshadow
from softshadow.inspection import ledger_of
from softshadow.inspection.files import MARK, is_folder, make_parents, refuse_foreign, write_folder, write_whole
from softshadow.inspection.pictures import depth_picture, map_pictures, save_png, visibility_picture
from softshadow.inspection.step import sheet_of
from softshadow.runs.archive import RunRecord, write_npz
from softshadow.space import EXTENSIONS as MODELS
from softshadow.space import geometry_of_run, write_model

if TYPE_CHECKING:
    from softshadow.report import RunPage

EXTENSIONS = (".png", ".npz", ".html", *MODELS)


def save(run: RunRecord, path: str | os.PathLike[str], force: bool, beside: RunRecord | None = None) -> Path:
    """Write a run in the form that the path's extension names; see `Run.save`."""
    target = Path(path)
    if beside is not None:
        if target.suffix.lower() != ".html":
            raise ValueError(f"{path}: a run beside another one is for reports, expected an ending of .html")
        if beside.frame.size != run.frame.size:
            raise ValueError(f"beside: sizes differ, {run.frame.size} and {beside.frame.size}; expected the same")
    if is_folder(path):
        return save_folder(run, target, force)
    check_path(path, force)
    return write_whole(target, partial(write_file, run, beside=beside), force)


def check_path(path: str | os.PathLike[str], force: bool) -> None:
    """Raise an error if a run cannot be saved there; called before a long drawing.

    Raises
    ------
    ValueError                   the extension is none of a run's
    SoftShadowError              see `refuse_foreign`; the files of a folder are checked when it is written
    """
    if is_folder(path):
        return
    if Path(path).suffix.lower() not in EXTENSIONS:
        raise ValueError(f"{path}: expected an ending of {', '.join(EXTENSIONS)}, or a folder (a path that ends in /)")
    refuse_foreign(Path(path), force)


def write_file(run: RunRecord, path: Path, beside: RunRecord | None = None) -> None:
    """Write one file in the form that its extension names."""
    extension = path.suffix.lower()
    if extension == ".png":
        save_png(run.steps[-1].image, path)
    elif extension == ".npz":
        write_npz(run, path)
    elif extension in MODELS:
        geometry = geometry_of_run(run)
        write_model(geometry.pieces, geometry.scene, path)
    else:
        write_report(run, path, beside)


def write_report(run: RunRecord, path: Path, beside: RunRecord | None) -> None:
    """Write the report of a run, or of two; the modules of pages are loaded here, not with every run."""
    from softshadow.report import write_run_page

    if beside is None:
        write_run_page(page_of(run), path)
    else:
        write_run_page(page_of(run, _name(run, beside)), path, page_of(beside, _name(beside, run)))


def _name(run: RunRecord, other: RunRecord) -> str:
    """Return a name that tells a run from another one: its technique, and the options and scene that differ."""
    options = [f"{key}={value}" for key, value in run.options.items() if other.options.get(key) != value]
    same_kind = run.technique == other.technique
    names = ["" if each.scene is None else each.scene.name for each in (run, other)]
    scene = [] if names[0] == names[1] else names[:1]
    return " ".join([run.technique, *scene, *(options if same_kind else [])])


def page_of(run: RunRecord, name: str = "", more_maps: Mapping[str, np.ndarray] | None = None) -> RunPage:
    """Return what the report of a run shows: see `RunPage`."""
    from softshadow.report import RunPage

    return RunPage(
        run.technique, run.scene, run.frame.size, run.options, run.warnings, run.steps, ledger_of(run.frame), name,
        more_maps or {},
    )  # fmt: skip


def save_folder(run: RunRecord, folder: Path, force: bool) -> Path:
    """Write pictures of every step, their GL state as text, and the npz to a folder, which is created if missing."""
    maps = run.steps.maps
    pictures = {"image.png": run.steps[-1].image, "steps.png": sheet_of(run.steps)}
    if "visibility" in maps:
        pictures["visibility.png"] = visibility_picture(maps["visibility"], maps.get("valid"))
    for step in run.steps:
        start = f"{step.index:02d}-{file_name(step.title)}"
        pictures[f"{start}-image.png"] = step.image
        pictures[f"{start}-depth.png"] = depth_picture(step.depth)
        pictures[f"{start}-stencil.png"] = step.stencil
        for name, picture in map_pictures(step.maps).items():
            pictures[f"{start}-{file_name(name)}.png"] = picture
    text = f"{MARK} {softshadow.__version__}\n" + "\n".join(
        f"\n# step {step.index}: {step.title}\n{step.state}" for step in run.steps
    )
    make_parents(folder)
    names = (*pictures, "state.txt", "run.npz")
    for name in names if folder.exists() else ():
        refuse_foreign(folder / name, force)

    def write(place: Path) -> None:
        for name, picture in pictures.items():
            save_png(picture, place / name)
        (place / "state.txt").write_text(text + "\n", encoding="utf-8")
        write_npz(run, place / "run.npz")

    return write_folder(folder, write, lambda entry: entry.name in names)


def file_name(title: str) -> str:
    """Return a title as a part of a file name.

    Examples
    --------
    >>> file_name("add the light: lamp 1")
    'add-the-light-lamp-1'
    """
    return re.sub(r"[^\w]+", "-", title).strip("-").lower()
