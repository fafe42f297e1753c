"""`ss.animate`: what changes from frame to frame, what the pictures show, and what is said about mistakes."""

import re
import warnings
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import softshadow as ss
from softshadow import techniques
from softshadow.inspection.pictures import GAP, depth_picture
from softshadow.sweeps.films.changes import option_change
from softshadow.sweeps.films.layout import broken, text_size, text_width

SIZE = (32, 24)


@pytest.fixture(scope="module")
def orbit() -> ss.Film:
    """Return a film of a light that turns around, without captions, so that its pictures are those of runs."""
    return ss.animate("map", "boxes", SIZE, light_path="orbit", frames=4, captions=False, map_size=16)


def values(technique: str, text: str, n_frames: int) -> list[Any]:
    return list(option_change(techniques.get(technique), text, n_frames).values)


def test_frame_is_the_picture_of_a_run_with_the_light_moved(orbit: ss.Film) -> None:
    scene = ss.Scene.named("boxes")
    (change,) = orbit.changes
    assert np.array_equal(change.values[0], scene.lights[0].position)
    for frame, position in enumerate(change.values):
        moved = replace(scene, lights=tuple(replace(light, position=position) for light in scene.lights))
        assert np.array_equal(orbit[frame], ss.run("map", moved, SIZE, map_size=16).image)
    assert len({picture.tobytes() for picture in orbit.pictures}) == 4


def test_frame_is_the_picture_of_a_run_with_the_eye_moved_and_the_target_kept() -> None:
    film = ss.animate("blob", "boxes", SIZE, camera_path="line:3,3,4:4,3,4", frames=2, captions=False)
    scene = ss.Scene.named("boxes")
    for frame, eye in enumerate(([3, 3, 4], [4, 3, 4])):
        moved = replace(scene, camera=replace(scene.camera, eye=np.array(eye, float)))
        assert np.array_equal(film[frame], ss.run("blob", moved, SIZE).image)


def test_ranges_pass_from_end_to_end_and_lists_are_divided_evenly() -> None:
    assert values("map", "units=0..8", 5) == [0, 2, 4, 6, 8]
    assert values("map", "map_size=16..256:log", 5) == [16, 32, 64, 128, 256]
    assert values("map", "cull=none,front,back", 7) == ["none", "none", "none", "front", "front", "back", "back"]


def test_caption_writes_what_changes_with_the_same_number_of_digits() -> None:
    film = ss.animate("map", "boxes", SIZE, vary=["units=0..1", "map_size=8,16"], frames=4, light_path="orbit:90")
    assert [each.split(", light ")[0] for each in film.captions] == [
        "units=0.00, map_size=8", "units=0.33, map_size=8", "units=0.67, map_size=16", "units=1.00, map_size=16",
    ]  # fmt: skip
    assert all(len(each.split()[-1].partition(".")[2]) == 2 for each in film.captions)
    plain = ss.animate("map", "boxes", SIZE, vary="units=0..1", frames=2, captions=False)
    assert plain.captions == ("units=0.00", "units=1.00")
    assert plain.size == SIZE
    assert film.size[0] == SIZE[0]
    assert film.size[1] > SIZE[1]
    below = np.stack([picture[SIZE[1] :] for picture in film.pictures])
    assert (below < 128).any(axis=(1, 2, 3)).all()  # dark letters on light ground
    assert not np.array_equal(below[0], below[1])


def test_steps_stand_side_by_side_each_under_its_title() -> None:
    width, height = 64, 48
    moving = {"light_path": "orbit", "frames": 2, "captions": False}
    film = ss.animate("volume-zfail", "boxes", (width, height), steps=True, **moving)
    run = ss.run("volume-zfail", "boxes", (width, height))
    assert len(run.steps) == 4
    assert film.size[0] == 4 * (width + GAP) - GAP
    for index, step in enumerate(run.steps):
        column = film[0][:, index * (width + GAP) :][:, :width]
        assert np.array_equal(column[film.size[1] - height :], step.image)
        assert (column[: film.size[1] - height] < 128).any()  # dark letters


def test_more_than_four_panels_take_several_rows() -> None:
    film = ss.animate("map", "boxes", SIZE, light_path="orbit", frames=2, steps=True, show=["color", "depth"])
    alone = ss.animate("map", "boxes", SIZE, light_path="orbit", frames=2)
    n_panels = 2 * len(ss.run("map", "boxes", SIZE).steps)
    assert n_panels > 4
    assert film.size[0] == 4 * (SIZE[0] + GAP) - GAP
    assert film.size[1] > 2 * alone.size[1]


def test_long_title_is_broken_into_lines_that_fit_and_nothing_is_left_out() -> None:
    title = "3 add the light where the count is 0, with anextraordinarilylongwordthatfitsnowhere in it"
    size = text_size(160)
    lines = broken(title, size, 152)
    assert "".join(lines).replace(" ", "") == title.replace(" ", "")
    assert all(text_width(line, size) <= 152 for line in lines)
    assert broken("color", size, 152) == ["color"]


def test_greys_of_depths_are_those_of_the_whole_film() -> None:
    path = [[3, 3, 4], [6, 6, 8]]
    film = ss.animate("blob", "boxes", SIZE, camera_path=path, frames=2, show="depth", captions=False)
    scene = ss.Scene.named("boxes")
    depths = [
        ss.run("blob", replace(scene, camera=replace(scene.camera, eye=np.array(eye, float))), SIZE).depth
        for eye in path
    ]
    drawn = np.concatenate([each[each != 1] for each in depths])
    for picture, values_of_frame in zip(film.pictures, depths, strict=True):
        assert np.array_equal(picture, depth_picture(values_of_frame, 1.0, (float(drawn.min()), float(drawn.max()))))


def test_warning_of_several_frames_is_told_once_and_says_in_which() -> None:
    path = [[0.2, 0.9, 0], [2, 5, 1]]  # from between the casters
    with pytest.warns(ss.OutsideLightFrustum) as caught:
        film = ss.animate("map", "boxes", SIZE, light_path=path, frames=9)
    (told,) = film.warnings
    assert [each.message for each in caught] == [told]
    assert caught[0].filename == __file__
    scene = ss.Scene.named("boxes")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        alone = [
            ss.run("map", replace(scene, lights=(replace(scene.lights[0], position=at),)), SIZE).warnings
            for at in film.changes[0].values
        ]
    count = sum(map(bool, alone))
    assert 1 < count < 9
    assert str(told) == f"frame 0: {alone[0][0]} (in {count} of 9 frames)"


def test_film_plays_with_its_rate_and_its_poster_is_the_frame_asked_for() -> None:
    film = ss.animate("blob", "boxes", SIZE, light_path="orbit", frames=4, rate=8, poster_frame=3)
    assert (film.seconds, len(film)) == (0.5, 4)
    assert np.array_equal(film.poster, film[3])
    assert repr(film).startswith("Film('blob', scene 'boxes', ")


def test_equal_frames_are_drawn_once() -> None:
    seen: list[Any] = []
    film = ss.animate("map", "boxes", SIZE, vary="map_size=8,16", frames=6, report=seen.append)
    assert (seen[-1].done, seen[-1].total) == (2, 2)
    assert len(film) == 6


def test_technique_of_ones_own_is_animated() -> None:
    def steps(gl: Any, scene: ss.Scene, *, size: tuple[int, int], shade: float = 0.5) -> Any:
        gl.glClearColor(shade, shade, shade, 1)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        yield "clear"

    film = ss.animate(steps, "boxes", SIZE, vary="shade=0..1", frames=2, captions=False)
    assert [int(picture.max()) for picture in film.pictures] == [0, 255]


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({}, "nothing changes from frame to frame; expected light_path, camera_path or vary"),
        ({"vary": "unit=0..1"}, "has no option 'unit'; did you mean 'units'?"),
        ({"vary": "units=0..b"}, "expected two numbers with .. between them, as in 0..8"),
        ({"vary": "units=0..1:log"}, "expected two numbers above 0 for :log"),
        ({"vary": "units=0..1:lin"}, "expected nothing or :log after the range, got :lin"),
        ({"vary": "units"}, "expected OPTION=A..B, OPTION=A..B:log or OPTION=A,B,C"),
        ({"vary": "cull=a..b"}, "expected a list, OPTION=A,B,C"),
        ({"vary": "cull=side,none"}, "option cull='side'"),
        ({"vary": "map_size=8,9,10"}, "3 values for 2 frames; expected a frame for each"),
        ({"vary": "units=0..1", "units": 3}, "option 'units': is fixed to 3 and varied, too"),
        ({"vary": ["units=0..1", "units=0..2"]}, "option 'units' is given twice"),
        ({"light_path": "orbit", "frames": 1}, "frames=1: expected a whole number of at least 2"),
        ({"light_path": "orbit", "rate": 51}, "rate=51: expected a whole number from 1 to 50"),
        ({"light_path": "orbit", "poster_frame": 2}, "poster_frame=2: expected a whole number from 0 to 1"),
        ({"light_path": "orbit", "show": ()}, "show: expected color, depth, stencil or the name of a map"),
        ({"light_path": "orbit", "show": "colour"}, "show 'colour': did you mean 'color'?"),
        ({"vary": "units=0..1", "of_light": "light"}, "of_light='light': expected a light_path, too"),
    ],
)
def test_mistake_is_named_with_what_was_expected(given: dict[str, Any], said: str) -> None:
    with pytest.raises(ValueError, match=re.escape(said)):
        ss.animate("map", "boxes", SIZE, **{"frames": 2, **given})


def test_light_that_is_not_there_is_an_error_that_suggests_another() -> None:
    with pytest.raises(ss.SceneError, match=r"light 'lihgt': did you mean 'light'"):
        ss.animate("map", "boxes", SIZE, light_path="orbit", of_light="lihgt", frames=2)


def test_frame_that_cannot_be_drawn_is_an_error_that_tells_which() -> None:
    def steps(gl: Any, scene: ss.Scene, *, size: tuple[int, int], shade: float = 0.5) -> Any:
        if shade > 0.4:
            raise ss.StateError("too bright")
        yield "nothing"

    with pytest.raises(ss.SoftShadowError, match=r"^frame 1 \(shade=0.50\): too bright$"):
        ss.animate(steps, "boxes", SIZE, vary="shade=0..1", frames=3)


def test_film_that_needs_too_much_memory_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("softshadow.sweeps.films.animate.memory", lambda: 10_000)
    with pytest.raises(ss.SoftShadowError, match=r"2 frames of 1 pictures need about .* expected fewer frames"):
        ss.animate("blob", "boxes", SIZE, light_path="orbit", frames=2)
