"""The report of one run, or of two side by side: a page that shows every step, and tells the history of any pixel."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from softshadow.errors import Warning
from softshadow.inspection import Ledger, Step, Steps
from softshadow.inspection.pictures import CLEAR_DEPTH, UNDEFINED, is_visibility, stencil_palette
from softshadow.report.commands import heading, question_spelled
from softshadow.report.fragment_events import FATES, FragmentRecord
from softshadow.report.history_record import history_json, recorded
from softshadow.report.packing import LIMIT, Packing
from softshadow.report.page import map_note, named, write_page
from softshadow.report.questions import questions
from softshadow.report.script import script_of
from softshadow.report.state_changes import marked_calls
from softshadow.report.view3d import view3d_document
from softshadow.report.wireframe import wireframe
from softshadow.scene import Scene
from softshadow.space.sight_lines import COUNTING

SHOWN_MAPS = 4  # that stand on the page from the beginning; the others can be chosen
LARGEST_VIEW = 1 << 20  # characters of a 3-D view
MINOR_MAPS = ("valid", "unknown")
DIFFERENT = (0xD5, 0x5E, 0x00)  # pixels in which two runs differ
FATE_COLORS = ((0, 0, 0), (0xF0, 0xE4, 0x42), (0x56, 0xB4, 0xE9), (0xBB, 0xBB, 0xBB), (0xCC, 0x79, 0xA7),
               (0xD5, 0x5E, 0x00), (0x00, 0x72, 0xB2), (0x66, 0x66, 0x66))  # fmt: skip


@dataclass(frozen=True, eq=False)
class RunPage:
    """What the report of a run shows.

    Attributes
    ----------
    ledger : Ledger or None      None leaves it out
    name : str                   what the run is called beside another one; by default its technique
    more_maps : dict             maps (H, W) of the last step, besides those of the technique
    """

    technique: str
    scene: Scene | None
    size: tuple[int, int]
    options: Mapping[str, Any]
    warnings: tuple[Warning, ...]
    steps: Steps
    ledger: Ledger | None
    name: str = ""
    more_maps: Mapping[str, np.ndarray] = field(default_factory=dict)

    @property
    def heading(self) -> str:
        """The technique and the scene, or the program that was recorded."""
        return heading(self.technique, self.scene, self.options)


def write_run_page(run: RunPage, path: Path, beside: RunPage | None = None) -> None:
    """Write the report of a run as one file; of a technique that counts volumes, with the 3-D view of its first light.

    Parameters
    ----------
    beside : RunPage             of the same size; the page shows both, and their difference

    Raises
    ------
    ValueError                   the runs differ in size
    """
    view = view3d_document(run) if run.technique in COUNTING and run.scene is not None and run.scene.lights else ""
    write_runs(path, [run] if beside is None else [run, beside], view3d=view)


def write_runs(path: Path, runs: Sequence[RunPage], failure: Any = None, command: str = "", view3d: str = "") -> None:
    """Write the page of one or two runs.

    Parameters
    ----------
    failure : FailurePage        if the first run has a failure that the second one cures
    command : str                of the command line; by default the one for the history of a pixel
    view3d : str                 the page of the 3-D view, which is left out if it is larger than `LARGEST_VIEW`
    """
    start = {"side": "both", "marker": failure.pixel} if failure else {"side": "first"}
    write_page(
        path, "run.html", run=runs[0], runs=runs, data=page_data(runs, start, view3d), failure=failure, command=command,
        warnings=named(runs[0].warnings), script=script_of("report.js"),
    )  # fmt: skip


def page_data(runs: Sequence[RunPage], start: Mapping[str, Any], view3d: str = "") -> dict[str, Any]:
    """Return what the page's script reads (templates/data.js); `start` is what it shows first: side, marker.

    Raises
    ------
    ValueError                   the runs differ in size
    """
    run = runs[0]
    for other in runs[1:]:
        if other.size != run.size:
            raise ValueError(f"beside: sizes differ, {run.size} and {other.size}; expected the same")
    packing, texts = Packing(LIMIT), list[Any]()
    if len(view3d) > LARGEST_VIEW:
        packing.leave_out("3-D view", f"it would take {len(view3d) / 1e6:.2g} MB")
        view3d = ""
    records = [recorded(each.steps[0].frame, packing) for each in runs]
    described: list[dict[str, Any]] = [
        {"name": each.name or each.technique, "technique": each.technique, "steps": _steps(each, record, packing)}
        for each, record in zip(runs, records, strict=True)
    ]
    for each, record, description in zip(runs, records, described, strict=True):
        description["history"] = history_json(record, each.steps, packing, texts) if record else None
    scenes = [(one.scene, one.size, one.technique) for one in runs if one.scene is not None]
    lines = {each.name: asdict(each) for seen in scenes for each in wireframe(*seen)}
    return {
        "size": run.size,
        "runs": described,
        "texts": texts,
        "lines": list(lines.values()),
        "questions": [asdict(question) for question in questions(run.steps, records[0])],
        "hidden": _hidden(run.steps),
        "fates": FATES,
        "palette": stencil_palette().tolist(),
        "colors": {"undefined": UNDEFINED, "clear": CLEAR_DEPTH, "different": DIFFERENT, "fates": FATE_COLORS},
        "start": start,
        "view3d": view3d,
        "command": question_spelled(run.technique, run.scene, run.size, run.options),
        "notices": packing.notices,
        "arrays": packing.arrays,
    }


def _steps(run: RunPage, record: FragmentRecord | None, packing: Packing) -> list[dict[str, Any]]:
    """Return what the page knows of each step; if arrays have no room, those of the last steps are kept."""
    described, steps = [], run.steps
    calls = [step.state.calls() for step in steps]
    more = {len(steps) - 1: run.more_maps}
    pictures = {step.index: _pictures(step, steps, packing, more.get(step.index, {})) for step in reversed(steps)}
    for step in steps:
        before = calls[step.index - 1] if step.index else calls[step.index]
        described.append({
            "title": step.title,
            "state": marked_calls(before, calls[step.index]),
            "draws": [f"{draw.object or f'draw {draw.draw}'}, {draw.triangles} triangles" for draw in step.draws],
            "pictures": pictures[step.index],
            "colour": pictures[step.index][0]["array"],
        })  # fmt: skip
        counts = record.steps[step.index] if record else None
        numbers = packing.add("fragments per pixel", [counts.last, *counts.counts.values()]) if counts else None
        if counts and numbers:
            described[-1] |= {"last": numbers[0], "counts": dict(zip(counts.counts, numbers[1:], strict=True))}
    return described


def _pictures(step: Step, steps: Steps, packing: Packing, more_maps: Mapping[str, np.ndarray]) -> list[dict[str, Any]]:
    """Return the pictures of a step: its buffers and its maps."""
    buffers = {"colour": step.image, "depth": step.depth, "stencil": step.stencil}
    forms = {"colour": "color", "depth": "depth", "stencil": "counts"}
    numbers = packing.add(f"buffers of step {step.index}", list(buffers.values())) or (None, None, None)
    pictures: list[dict[str, Any]] = []
    for (name, buffer), number in zip(buffers.items(), numbers, strict=True):
        earlier = [getattr(steps[step.index - 1], "image" if name == "colour" else name)] if step.index else []
        changed = not all(np.array_equal(buffer, each) for each in earlier) if earlier else not _is_blank(buffer)
        blank = _is_blank(buffer) and (name != "stencil" or _is_blank(step.depth))
        pictures.append({"key": name, "title": name, "array": number, "form": forms[name], "changed": changed,
                         "blank": blank})  # fmt: skip
    for name, values in (step.maps | dict(more_maps)).items():
        found = packing.add(f"map {name}", [values])
        pictures.append({
            "key": f"map {name}", "title": name, "array": found[0] if found else None, "form": form_of(name, values),
            "map": True, "note": map_note(name),
        })  # fmt: skip
        if is_visibility(name) and "valid" in step.maps:
            valid = packing.add("map valid", [step.maps["valid"]])
            pictures[-1]["valid"] = valid[0] if valid else None
    return pictures


def _is_blank(buffer: np.ndarray) -> bool:
    return bool((buffer == buffer[0, 0]).all())


def form_of(name: str, values: np.ndarray) -> str:
    """Return how a map is shown: visibility, yes, color, counts or depth (see `inspection.pictures.map_picture`)."""
    if is_visibility(name):
        return "visibility"
    if values.dtype == np.bool_:
        return "yes"
    if values.ndim == 3:
        return "color"
    return "counts" if values.dtype == np.uint8 else "depth"


def _hidden(steps: Steps) -> list[str]:
    """Return the keys of the maps that the reader has to choose first: minor ones, and those beyond `SHOWN_MAPS`."""
    names = [name for name in steps.maps if name.split(":")[0] not in MINOR_MAPS]
    return [f"map {name}" for name in steps.maps if name not in names[:SHOWN_MAPS]]
