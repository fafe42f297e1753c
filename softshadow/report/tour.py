"""The tour: every technique on one scene, a folder of pictures and buffers with a page to read."""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from softshadow import techniques
from softshadow.errors import SceneError, SoftShadowError
from softshadow.inspection.files import own
from softshadow.inspection.pictures import color_picture
from softshadow.report.commands import options_spelled, scene_spelled
from softshadow.report.page import Section, beside, environment, named, sections
from softshadow.run import checked_size, run

if TYPE_CHECKING:
    from softshadow.run import Run
    from softshadow.scene import Scene

INDEX = "index.html"


@dataclass(frozen=True)
class Stop:
    """One run of the tour: what to draw, and what to look at."""

    title: str
    technique: str
    look_at: str
    options: Mapping[str, Any] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """The name of its files: technique and options."""
        words = [
            self.technique,
            *(f"{key}={value}" if key != "method" else value for key, value in self.options.items()),
        ]
        return re.sub(r"[^\w.]+", "-", "-".join(words))


STOPS = (
    Stop(
        "Planar shadow, depth test off",
        "planar",
        "The slides' first form: flattened casters are painted over the receiver whatever is in front of it.",
        {"method": "depth-off"},
    ),
    Stop(
        "Planar shadow, polygon offset",
        "planar",
        "The offset (-1, -1) lifts the flattened casters off the receiver: no z-fighting, and depth is kept.",
        {"method": "offset"},
    ),
    Stop(
        "Planar shadow, stencil",
        "planar",
        "The stencil marks the receiver, the flattened casters unmark it: no shadow outside the receiver.",
        {"method": "stencil"},
    ),
    Stop(
        "Planar shadow, stencil and blending",
        "planar",
        "Each marked pixel is darkened once, however many flattened triangles cover it.",
        {"method": "stencil-blend"},
    ),
    Stop(
        "Planar shadow, as a texture",
        "planar",
        "The shadow is drawn into a texture of the receiver once; while nothing moves it can be used again.",
        {"method": "texture"},
    ),
    Stop(
        "Shadow polygons",
        "shadow-polygons",
        "What each object shadows is cut out as polygons once; they serve every camera.",
    ),
    Stop(
        "Blob shadow",
        "blob",
        "A dark disc below each caster: no light is asked where it stands, and no shape what it is.",
    ),
    Stop(
        "Shadow volumes, z-pass",
        "volume-zpass",
        "The stencil counts volumes entered and left in front of each surface; what is left over is shadow.",
    ),
    Stop(
        "Shadow volumes, z-fail",
        "volume-zfail",
        "Counted behind the surface instead: right wherever the eye is, but the volume needs both caps.",
    ),
    Stop(
        "Shadow volumes, one per polygon",
        "volume-zfail",
        "Without a silhouette: the same counts, many more fragments. Compare the ledgers.",
        {"generator": "per-polygon"},
    ),
    Stop(
        "Shadow volumes, two-sided stencil",
        "volume-zfail",
        "Front and back faces in one draw: one pass less, the same counts.",
        {"two_sided": True},
    ),
    Stop(
        "Shadow volumes, z-pass or z-fail for each pixel",
        "volume-zfail",
        "A plane through each shadow marks what lies behind it: z-fail there, z-pass before it. Compare the updates.",
        {"choose": "split-plane"},
    ),
    Stop(
        "Shadow volumes, z-pass from the near-plane count",
        "volume-zpass-plus",
        "Casting faces thrown onto the near rectangle start the count: z-pass, right wherever the eye is.",
    ),
    Stop(
        "Shadow volumes, parity",
        "volume-parity",
        "One bit, inverted at every face: light where two volumes overlap.",
    ),
    Stop(
        "Shadow map",
        "map",
        "The scene's depths from the light, compared for each pixel: blocky edges, no geometry to extrude.",
    ),
    Stop(
        "Shadow map, second depth",
        "map",
        "The far sides of the casters are stored: lit faces need no bias, and errors are where it is dark anyway.",
        {"surface": "back", "factor": 0.0, "units": 0.0},
    ),
    Stop(
        "Shadow map, percentage-closer filtering",
        "map-pcf",
        "The share of 3 x 3 comparisons that are lit: a ramp as wide as the texels, near the caster and far from it.",
    ),
    Stop(
        "Shadow maps to all six sides",
        "map-cube",
        "One map for each direction, for lights that stand among their casters; here five of the six stay empty.",
    ),
    Stop(
        "Shadow silhouette map",
        "map-silhouette",
        "The silhouette's own points beside the depths: a map this coarse has straight edges all the same.",
        {"map_size": 128},
    ),
    Stop(
        "Shadow map without bias",
        "map",
        "Surfaces shadow themselves: the map's texel is as deep as the surface, give or take half its slope.",
        {"factor": 0.0, "units": 0.0},
    ),
)


@dataclass(frozen=True)
class Visited:
    """A stop that has been drawn, as the page shows it."""

    stop: Stop
    picture: str
    sections: list[Section]
    ledger: list[dict[str, object]]
    warnings: list[str]
    npz: str
    described: str
    command: str


def write_tour(
    scene: Scene,
    size: tuple[int, int],
    folder: str | Path,
    force: bool = False,
    progress: Callable[[str], None] = lambda title: None,
    again: str | None = None,
) -> Path:
    """Draw all stops, write the folder, and return its page. The folder is made whole or not at all.

    Stops whose technique refuses the scene (`SceneError`) are left out, and the page says why.

    Parameters
    ----------
    scene, size                  as for `run`
    folder : path                made if need be; an earlier tour in it is replaced
    force : bool                 write into a folder that holds other files, which stay unless a file of the tour has
                                 the same name
    progress : callable          gets the title of each stop before it is drawn
    again : str                  the arguments of the command line that ask for this scene and size

    Raises
    ------
    SoftShadowError
        The folder holds files that are not of a tour, or cannot be written; or the size is none, see `run`.
    """
    target = Path(folder)
    size = checked_size(size)
    again = again or scene_spelled(scene, size)
    _refuse_foreign(target, force)
    try:
        # inside the folder where there is one: only within a file system do files move at once
        work = Path(tempfile.mkdtemp(prefix=".softshadow-", dir=target if target.is_dir() else target.parent))
    except OSError as error:
        raise SoftShadowError(f"{target}: the folder cannot be made ({error.strerror})") from None
    try:
        visited, left_out = [], []
        for stop in STOPS:
            progress(stop.title)
            try:
                made = run(stop.technique, scene, size, **stop.options)
            except SceneError as error:  # a technique that is not for such a scene; the others are
                progress(f"{stop.title}: left out. {error}")
                left_out.append((stop, error))
                continue
            visited.append(_visit(stop, made, work, again))
        if not visited:
            raise left_out[0][1]
        page = environment().get_template("tour.html")
        html = page.render(scene=scene, size=size, visited=visited, left_out=left_out, again=again)
        (work / INDEX).write_text(html, encoding="utf-8")
        _move(work, target)
    except OSError as error:
        raise SoftShadowError(f"{target}: cannot be written ({error.strerror or error})") from None
    finally:
        shutil.rmtree(work, ignore_errors=True)
    return target / INDEX


def _refuse_foreign(target: Path, force: bool) -> None:
    if not target.parent.is_dir():
        raise SoftShadowError(f"{target}: the folder {target.parent} does not exist")
    if target.exists() and not target.is_dir():
        raise SoftShadowError(f"{target}: is a file, expected the name of a folder")
    if force or not target.exists() or not any(target.iterdir()):
        return
    if not _is_tour(target):
        raise SoftShadowError(f"{target}: holds files that are not of a tour; force=True writes between them")


def _is_tour(folder: Path) -> bool:
    """Return whether a folder holds a tour and nothing else."""
    index = folder / INDEX
    return index.is_file() and all(path.is_file() and own(path) for path in _files(folder))


def _files(folder: Path) -> Iterator[Path]:
    """Give all that is in a folder and the folders in it, except these folders themselves; links are not followed."""
    for place, folders, names in os.walk(folder):
        for name in (*names, *folders):
            path = Path(place, name)
            if name in names or path.is_symlink():
                yield path


def _move(work: Path, target: Path) -> None:
    """Move the files of a finished tour to their place; an earlier tour goes, files of others stay."""
    if target.is_dir() and _is_tour(target):
        for path in target.iterdir():
            if path == work:
                continue
            if path.is_dir():
                shutil.rmtree(path)
            else:
                path.unlink()
    for path in list(_files(work)):
        place = target / path.relative_to(work)
        place.parent.mkdir(parents=True, exist_ok=True)
        path.replace(place)


def _visit(stop: Stop, made: Run, work: Path, again: str) -> Visited:
    folder = work / stop.name
    folder.mkdir()
    place = beside(folder)
    made.save(folder / "run.npz")
    return Visited(
        stop,
        place(color_picture(made.image), "picture"),
        sections(made, place),
        made.ledger.to_dicts(),
        named(made.warnings),
        f"{stop.name}/run.npz",
        techniques.get(stop.technique).paper,
        f"softshadow render {stop.technique} {again}{options_spelled(made)}",
    )
