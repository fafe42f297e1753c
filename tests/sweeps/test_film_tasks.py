"""Frames as tasks: a film that was interrupted goes on, and no frame is drawn twice."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import softshadow as ss
from softshadow import techniques
from softshadow.sweeps import Progress
from softshadow.sweeps.films.frame import FILES, Frame, described, draw_frame, drawn_frame, scene_digest, source_of
from softshadow.sweeps.journal import Journal
from softshadow.sweeps.task import Work

SIZE, FRAMES = (24, 18), 6


class Counting:
    """A technique that remembers with which shade it was drawn."""

    def __init__(self) -> None:
        self.drawn: list[float] = []

        def steps(gl: Any, scene: ss.Scene, *, size: tuple[int, int], shade: float = 0.5) -> Any:
            self.drawn.append(shade)
            gl.glClearColor(shade, shade, shade, 1)
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
            yield "clear"

        self.steps = steps

    def film(self, journal: Path, **more: Any) -> ss.Film:
        return ss.animate(self.steps, "boxes", SIZE, vary="shade=0..1", frames=FRAMES, journal=journal, **more)


def interrupted_after(n_frames: int) -> Callable[[Progress], None]:
    def report(progress: Progress) -> None:
        if progress.done == n_frames:
            raise KeyboardInterrupt

    return report


def test_film_goes_on_where_it_was_interrupted_and_draws_no_frame_twice(tmp_path: Path) -> None:
    technique, path = Counting(), tmp_path / "film.film-journal"
    with pytest.raises(KeyboardInterrupt):
        technique.film(path, report=interrupted_after(4))
    assert len(technique.drawn) == 4
    seen: list[Progress] = []
    film = technique.film(path, resume=True, report=seen.append)
    assert (seen[0].done, seen[0].total) == (4, FRAMES)
    assert technique.drawn == pytest.approx(np.linspace(0, 1, FRAMES))
    whole = Counting().film(tmp_path / "other.film-journal")
    assert np.array_equal(film.pictures, whole.pictures)
    assert film.save(tmp_path / "a.webp").read_bytes() == whole.save(tmp_path / "b.webp").read_bytes()
    technique.film(path, resume=True)
    assert len(technique.drawn) == FRAMES


def test_journal_with_frames_is_not_overwritten_but_one_without_is(tmp_path: Path) -> None:
    path = tmp_path / "film.film-journal"
    with pytest.raises(ValueError, match="did you mean 'color'"):
        Counting().film(path, show="colour")
    Counting().film(path)
    with pytest.raises(ss.SoftShadowError, match="an earlier journal is here; expected --resume"):
        Counting().film(path)


def test_frame_that_failed_is_tried_again(tmp_path: Path) -> None:
    path, attempts = tmp_path / "film.film-journal", []

    def steps(gl: Any, scene: ss.Scene, *, size: tuple[int, int], shade: float = 0.5) -> Any:
        attempts.append(shade)
        if attempts.count(1.0) == 1:
            raise ss.StateError("out of luck")
        yield "nothing"

    given: dict[str, Any] = {"vary": "shade=0..1", "frames": 3, "journal": path}
    with pytest.raises(ss.SoftShadowError, match=r"frame 2 .*: out of luck"):
        ss.animate(steps, "boxes", SIZE, **given)
    assert len(ss.animate(steps, "boxes", SIZE, resume=True, **given)) == 3
    assert attempts == [0, 0.5, 1, 1]


def test_lost_file_of_a_frame_is_named(tmp_path: Path) -> None:
    path = tmp_path / "film.film-journal"
    Counting().film(path)
    lost = sorted((tmp_path / "film.film-frames").iterdir())[0]
    lost.write_bytes(b"PK")
    with pytest.raises(ss.SoftShadowError, match=rf"{lost.name}: the frame cannot be read"):
        Counting().film(path, resume=True)


def test_deleted_journal_leaves_files_of_others(tmp_path: Path) -> None:
    path = tmp_path / "film.film-journal"
    Counting().film(path)
    (tmp_path / "film.film-frames" / "mine.txt").write_text("mine")
    Journal(path, FILES).delete()
    assert [each.name for each in sorted(tmp_path.rglob("*"))] == ["film.film-frames", "mine.txt"]


def frame(**changed: Any) -> Frame:
    technique = techniques.get("map")
    given = {
        "technique": technique, "scene": scene_digest(ss.Scene.named("boxes")), "moves": (), "size": SIZE,
        "options": technique.validate_options({"map_size": 16}), "show": ("color", "depth"), "steps": True,
        "label": "frame 0", "threads": None,
    }  # fmt: skip
    return Frame(**{**given, **changed})


def test_key_depends_on_everything_that_a_frame_is_drawn_from_and_on_nothing_else() -> None:
    boxes = ss.Scene.named("boxes")
    darker = replace(boxes, lights=(replace(boxes.lights[0], color=(0.1, 0.1, 0.1)),))
    own, other = Counting().steps, lambda gl, scene, *, size: iter(())
    different = [
        frame(), frame(technique=techniques.get("map-pcf")), frame(scene=scene_digest(darker)),
        frame(moves=(("light", "light", (1.0, 2.0, 3.0, 1.0)),)), frame(options={"map_size": 17}), frame(size=(25, 18)),
        frame(show=("color",)), frame(steps=False), frame(technique=techniques.get(own)),
        frame(technique=replace(techniques.get(own), steps=other)),
    ]  # fmt: skip
    assert len({each.key for each in different}) == len(different)
    assert frame(label="frame 7", threads=3).key == frame().key
    assert scene_digest(ss.Scene.named("boxes")) == scene_digest(boxes)
    assert source_of(techniques.get(own)) == source_of(techniques.get(Counting().steps))


def test_panels_and_warnings_are_read_as_they_were_drawn() -> None:
    scene = ss.Scene.named("boxes")
    inside = frame(moves=(("light", scene.lights[0].name, (0.2, 0.9, 0.0, 1.0)),))
    result = draw_frame(inside, scene)
    assert result.file is not None
    drawn = drawn_frame(result.row, result.file)
    moved = replace(scene, lights=(replace(scene.lights[0], position=np.array([0.2, 0.9, 0, 1])),))
    with pytest.warns(ss.OutsideLightFrustum):
        run = ss.run("map", moved, SIZE, map_size=16)
    assert [str(each) for each in drawn.warnings] == [str(each) for each in run.warnings]
    assert [type(each) for each in drawn.warnings] == [type(each) for each in run.warnings]
    assert [panel.buffer for panel in drawn.panels] == ["color", "depth"] * len(run.steps)
    for step, color, depth in zip(run.steps, drawn.panels[::2], drawn.panels[1::2], strict=True):
        assert np.array_equal(color.values, step.image)
        assert np.array_equal(depth.values, step.depth)
        assert depth.values.dtype == step.depth.dtype


def test_engine_of_one_process_loads_a_scene_once_for_all_its_frames() -> None:
    loads = []

    def load(task: Frame) -> ss.Scene:
        loads.append(task.scene)
        return ss.Scene.named("boxes")

    tasks = [frame(), frame(steps=False), frame(size=(8, 6))]
    results = list(Work(draw_frame, described, load).here(tasks))
    assert [task for task, _ in results] == tasks
    assert all(result.row["status"] == "ok" for _, result in results)
    assert len(loads) == 1
