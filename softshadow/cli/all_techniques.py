"""``softshadow render --all``: every technique on one scene, as pictures in a folder, and a sheet of all of them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from softshadow.cli.arguments import ChosenTechnique, SceneArguments, chosen_techniques
from softshadow.cli.console import print_json, print_warnings_once, say, say_if_compiling, say_written

if TYPE_CHECKING:
    import numpy as np

COLUMNS, LABEL_HEIGHT, GAP = 4, 16, 6  # of the sheet; pixels
WIDTH = 240  # pixels at most: larger pictures are shown smaller


def render_all(
    scene: SceneArguments, size: tuple[int, int], options: Sequence[str], output: str, opened: bool, force: bool,
    as_json: bool,
) -> None:  # fmt: skip
    """Draw with every technique, and write NAME.png for each, and sheet.png; what a technique refuses is left out."""
    from softshadow import techniques
    from softshadow.errors import SceneError, SoftShadowError
    from softshadow.inspection.files import is_folder, refuse_foreign, write_whole
    from softshadow.inspection.pictures import save_png
    from softshadow.runs import run

    folder = Path(output)
    if not is_folder(output) and folder.suffix:
        raise ValueError(f"{output}: expected a folder, such as {folder.with_suffix('')}/")
    chosen = chosen_techniques(techniques.names(), options)
    with print_warnings_once():
        drawn = scene.load()
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise SoftShadowError(f"{folder}: the folder cannot be made ({error.strerror})") from None
        for each in (*(technique.name for technique in chosen), "sheet"):
            refuse_foreign(folder / f"{each}.png", force)
        say_if_compiling()
        pictures: list[tuple[str, np.ndarray]] = []
        left_out: list[tuple[ChosenTechnique, SceneError]] = []
        for technique in chosen:
            try:
                picture = run(technique.name, drawn, size, **technique.options).image
            except SceneError as error:
                say(f"left out: {technique.name}: {error}")
                left_out.append((technique, error))
                continue
            write_whole(folder / f"{technique.name}.png", partial(save_png, picture), force)
            pictures.append((technique.label, picture))
    if not pictures:
        raise left_out[0][1]
    sheet = sheet_of(pictures)
    path = write_whole(folder / "sheet.png", lambda path: save_png(sheet, path), force)
    if as_json:
        print_json(
            "render-all", scene=drawn.name, size=size, written=path,
            techniques=[{"technique": each.name, "written": folder / f"{each.name}.png"} for each in chosen
                        if each not in [refused for refused, _ in left_out]],
            left_out=[{"technique": each.name, "reason": str(error)} for each, error in left_out],
        )  # fmt: skip
    else:
        say(f"{len(pictures)} techniques")
    say_written(folder, path, opened=opened)


def sheet_of(pictures: Sequence[tuple[str, np.ndarray]]) -> np.ndarray:
    """Return pictures (H, W, 3) uint8 of equal size in rows of four, each below its label."""
    import numpy as np

    from softshadow.inspection.pictures import labelled, resized

    height, width = pictures[0][1].shape[:2]
    times = max(1, -(-width // WIDTH))
    width, height = max(1, width // times), max(1, height // times)
    column, row = max(width, WIDTH // 2) + GAP, height + LABEL_HEIGHT + GAP
    columns, rows = min(COLUMNS, len(pictures)), -(-len(pictures) // COLUMNS)
    sheet = np.full((rows * row - GAP, columns * column - GAP, 3), 255, np.uint8)
    labels = []
    for index, (label, picture) in enumerate(pictures):
        top, left = index // COLUMNS * row, index % COLUMNS * column
        labels.append((left + 1, top + 2, label))
        top += LABEL_HEIGHT
        sheet[top : top + height, left : left + width] = resized(picture, width, height)
    return labelled(sheet, labels)
