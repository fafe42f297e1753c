"""The player's Python side: what the browser may set, and what it gets."""

from io import BytesIO

import imageio.v3 as imageio
import numpy as np
import pytest

import softshadow as ss
from softshadow import techniques
from softshadow.inspection.pictures import colors_of
from softshadow.notebook.controls import controls_of

SIZE = (64, 48)


@pytest.fixture
def player():
    widget = ss.notebook.play("map", "torus", SIZE, map_size=64)
    yield widget
    widget.close()


def picture(player):
    return imageio.imread(BytesIO(player.picture))


def test_a_slider_of_the_light_draws_the_run_of_the_moved_light(player):
    np.testing.assert_array_equal(picture(player), player.run.image)
    player.values = player.values | {"light.x": -1.0}
    assert player.run.scene.lights[0].position.tolist() == [-1, 6, 2, 1]
    np.testing.assert_array_equal(picture(player), player.run.image)
    expected = ss.run("map", player.run.scene, SIZE, map_size=64)
    np.testing.assert_array_equal(player.run.image, expected.image)


def test_a_slider_of_an_option_draws_with_it(player):
    player.values = player.values | {"bias": 0.01, "map_size": 128.0}  # browsers have no whole numbers
    assert (player.run.options["bias"], player.run.options["map_size"]) == (0.01, 128)
    assert player.drawn == 2


def test_a_pixel_is_explained_with_its_history(player):
    seen = []
    player.observe(lambda change: seen.append(change["new"]), "pixel")
    player.pixel = [30, 35]
    assert seen == [[30, 35]]
    assert player.explanation == player.run.explain(30, 35)
    assert player.history == player.run.pixel(30, 35)._repr_html_()
    player.values = player.values | {"light.x": -3.0}
    assert player.explanation == player.run.explain(30, 35)
    player.pixel = None
    assert (player.explanation, player.history) == ("", "")


def test_a_pixel_outside_the_picture_is_a_sentence(player):
    player.pixel = [64, 3]
    assert "expected a whole number from 0 to 63" in player.explanation


def test_every_buffer_and_map_can_be_viewed(player):
    assert player.views == ["colour", "depth", "stencil", "ZS", "unknown", "visibility", "valid"]
    player.view = "stencil"
    np.testing.assert_array_equal(picture(player), colors_of(player.run.stencil))
    player.view = "ZS"
    assert picture(player).shape == (64, 64, 3)


def test_an_error_is_shown_and_leaves_the_last_run(player):
    before = player.run
    player.values = player.values | {"map_size": 0}
    assert player.failed
    assert player.messages == ["ValueError: option map_size=0: expected a whole number from 1 to 8192"]
    assert player.run is before
    assert player.drawn == 2
    player.values = player.values | {"map_size": 32}
    assert not player.failed
    assert player.messages == []


def test_warnings_of_the_run_are_shown_and_not_issued():
    player = ss.notebook.play("volume-zpass", "eye-in-shadow", SIZE)
    assert [message.split(":")[0] for message in player.messages] == ["NearClipZPass"]
    assert not player.failed


def test_a_technique_that_fails_at_once_is_an_error():
    def broken(gl, scene, *, size):
        yield 1 / 0

    with pytest.raises(ValueError, match="ZeroDivisionError: division by zero"):
        ss.notebook.play(broken, "torus", SIZE)


def test_a_function_of_ones_own_gets_sliders_for_its_arguments():
    def clear(gl, scene, *, size, value: int = 3):
        gl.glClearStencil(value)
        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        yield "clear"

    player = ss.notebook.play(clear, "torus", SIZE)
    (control,) = (control for control in player.controls if control["key"] == "value")
    assert (control["kind"], control["min"], control["max"], control["step"]) == ("range", -12, 12, 1)
    player.values = player.values | {"value": 7}
    assert (player.run.stencil == 7).all()


def test_light_is_chosen_by_name():
    scene = ss.Scene.named("two-lights")
    second = scene.lights[1]
    player = ss.notebook.play("volume-zfail", scene, SIZE, light=second.name)
    player.values = player.values | {"light.x": 0.25}
    assert player.run.scene.lights[0] is scene.lights[0]
    assert player.run.scene.lights[1].position[0] == 0.25
    with pytest.raises(ValueError, match=r"light=.lmap.: "):
        ss.notebook.play("volume-zfail", scene, SIZE, light="lmap")


@pytest.mark.parametrize("name", ss.technique_names())
def test_sliders_begin_at_the_options_and_their_ends_are_allowed(name):
    technique, scene = techniques.get(name), ss.Scene.named("torus")
    options = technique.validate_options({})
    for control in controls_of(technique, options, scene, scene.lights[0]):
        if control["kind"] == "range":
            assert control["min"] <= control["value"] <= control["max"]
            assert 0 < control["step"] < control["max"] - control["min"]
        ends = {"range": ("min", "max")}.get(control["kind"], ())
        values = [control[end] for end in ends] + list(control.get("choices", ()))
        for value in values if control["group"] != "light" else ():
            technique.validate_options({control["key"]: value})


def test_directions_have_sliders_too():
    scene = ss.Scene.named("torus")
    sun = ss.Scene("sun", scene.camera, [ss.Light((1, 2, 1, 0))], scene.objects)
    player = ss.notebook.play("volume-zfail", sun, SIZE)
    player.values = player.values | {"light.x": -1.0}
    assert player.run.scene.lights[0].position.tolist() == [-1, 2, 1, 0]
    player.values = player.values | {"light.x": 0, "light.y": 0, "light.z": 0}
    assert player.failed
    assert "not all 0" in player.messages[0]


def test_places_without_widgets_have_the_picture(player):
    bundle, _ = player._repr_mimebundle_()
    assert bundle["text/plain"] == f"Player({player.run!r})"
    assert bundle["image/png"].startswith("iVBORw0KGgo")
    assert "application/vnd.jupyter.widget-view+json" in bundle
