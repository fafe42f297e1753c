"""``softshadow animate``: a film in which a light, the camera or options change."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from softshadow.cli.arguments import (
    SceneArguments,
    as_json,
    examples,
    force,
    open_file,
    output_option,
    parse_options,
    scene_arguments,
    technique_options,
)
from softshadow.cli.console import print_json, print_warnings_once, say_if_compiling, say_written
from softshadow.cli.names import TechniqueName
from softshadow.cli.sweep_progress import progress_shown


@click.command(
    epilog=examples(
        "softshadow animate volume-zfail --light-path orbit -o light.webp",
        "softshadow animate map --vary units=0..8 --show color --show depth --frames 16 -o bias.png",
    )
)
@click.argument("technique", type=TechniqueName())
@scene_arguments("320x240")
@technique_options
@click.option("--light-path", metavar="PATH", help="Move the light: orbit, circle:…, line:…, points:… or FILE.toml.")
@click.option("--camera-path", metavar="PATH", help="Move the camera in the same ways.")
@click.option("--vary", multiple=True, metavar="OPTION=A..B", help="Change an option: A..B, A..B:log or A,B,C.")
@click.option("--frames", type=click.IntRange(2), default=48, show_default=True, help="Number of frames.")
@click.option("--rate", type=click.IntRange(1, 50), default=24, show_default=True, help="Frames per second.")
@click.option("--show", multiple=True, metavar="BUFFER", help="color, depth, stencil or a map; repeatable.")
@click.option("--steps", is_flag=True, help="Show them after every step, side by side.")
@click.option("--captions/--no-captions", default=True, help="Write below the picture what changes.")
@click.option("--poster", metavar="FILE.png", help="Also write the frame in the middle as a picture.")
@click.option("--workers", type=click.IntRange(1), default=1, show_default=True, help="Number of processes.")
@click.option("--scheduler", metavar="ADDRESS", help="A Dask scheduler that runs already: tcp://HOST:PORT.")
@click.option("--resume", is_flag=True, help="Go on with the frames of a film that was interrupted.")
@output_option("The film: .webp, .png (APNG), .gif or .mp4.  [default: TECHNIQUE.webp]", "FILM")
@open_file
@force
@as_json
def animate(
    technique: str, scene: SceneArguments, size: tuple[int, int], options: tuple[str, ...], light_path: str | None,
    camera_path: str | None, vary: tuple[str, ...], frames: int, rate: int, show: tuple[str, ...], steps: bool,
    captions: bool, poster: str | None, workers: int, scheduler: str | None, resume: bool, output: str | None,
    opened: bool, force: bool, as_json: bool,
) -> None:  # fmt: skip
    """Draw a film while a light, the camera or options of the technique change.

    A path is orbit (around the vertical axis), circle:X,Y,Z,RADIUS, line:X,Y,Z:X,Y,Z or points:X,Y,Z:X,Y,Z:...; a
    closed one can be repeated without a stop. MP4 needs the extra `video`, and several processes the extra `sweep`.
    Each frame is kept beside the film until the film is written, so an interrupted one goes on with --resume.
    """
    from softshadow.inspection.files import refuse_foreign
    from softshadow.sweeps.films.animate import animate as draw
    from softshadow.sweeps.films.film import check_output, check_poster
    from softshadow.sweeps.films.frame import FILES
    from softshadow.sweeps.journal import Journal

    target = output or f"{technique}.webp"
    check_output(target)
    if poster is not None:
        check_poster(Path(poster))
    for path in (target, *([poster] if poster else [])):
        refuse_foreign(Path(path), force)
    if scheduler is not None and workers != 1:
        raise click.UsageError("--scheduler and --workers: expected only one of them")
    journal = Journal(Path(target).with_suffix(".film-journal"), FILES)
    values: dict[str, Any] = parse_options(technique, options)
    say_if_compiling()
    with print_warnings_once(), progress_shown(as_json=False, of="frames") as (started, report):
        film = draw(
            technique, scene.load(), size, light_path=light_path, camera_path=camera_path, vary=vary, frames=frames,
            rate=rate, show=show or ("color",), steps=steps, captions=captions, workers=workers, scheduler=scheduler,
            journal=journal.path, resume=resume, report=report, started=started, **values,
        )  # fmt: skip
    written = [film.save(target, force=force)]
    if poster is not None:
        written.append(film.save_poster(poster, force=force))
    journal.delete()
    if as_json:
        print_json(
            "animate", written=written, technique=technique, scene=film.scene, size=film.size, frames=len(film),
            captions=film.captions,
            warnings=[{"name": type(each).__name__, "text": str(each)} for each in film.warnings],
        )  # fmt: skip
    say_written(*written, opened=opened)
