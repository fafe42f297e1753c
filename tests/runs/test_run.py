"""`ss.run` and the questions that a run answers, for every technique in small pictures."""

import warnings
import zipfile
from typing import Any

import imageio.v3 as imageio
import numpy as np
import pytest
from hypothesis import given, settings

import softshadow as ss
from softshadow import gl, techniques
from softshadow.context import current, make_current
from softshadow.inspection import Replay
from softshadow.inspection.replay import copy_window
from softshadow.techniques import Option, Technique
from strategies import floor_scenes

SIZE = (64, 48)
VARIANTS: list[tuple[str, dict[str, Any]]] = [
    *[("planar", {"method": method}) for method in ("depth-off", "offset", "stencil", "stencil-blend", "texture")],
    ("volume-zpass", {}),
    ("volume-zpass", {"generator": "per-polygon", "cap": "finite"}),
    ("volume-zfail", {}),
    ("volume-zfail", {"two_sided": True, "far": "clamp"}),
    ("map", {"map_size": 64}),
    ("map", {"map_size": 32, "storage": "copy", "filter": "linear"}),
]
NAMES = ["-".join([name, *map(str, options.values())]) for name, options in VARIANTS]


@pytest.fixture(scope="module", params=VARIANTS, ids=NAMES)
def run(request):
    name, options = request.param
    return ss.run(name, "torus", SIZE, **options)


@pytest.fixture(scope="module")
def zfail():
    return ss.run("volume-zfail", "torus", SIZE)


# -- buffers -----------------------------------------------------------------------------------------------------------
def test_arrays_have_the_promised_shapes_and_kinds(run):
    width, height = SIZE
    for array, dtype in (
        (run.depth, np.float32), (run.stencil, np.uint8), (run.visibility, np.float32), (run.valid, np.bool_),
        (run.shadow_mask, np.bool_), (run.lights[0].visibility, np.float32),
    ):  # fmt: skip
        assert (array.shape, array.dtype) == ((height, width), dtype)
    assert (run.image.shape, run.image.dtype) == ((height, width, 3), np.uint8)
    arrays = [run.image, run.depth, run.stencil, run.shadow_mask, *run.maps.values()]
    assert not any(array.flags.writeable for array in arrays)
    assert all(array.flags.c_contiguous for array in arrays)


def test_replay_reproduces_every_step_bit_for_bit(run):
    replay = Replay(run.frame)
    for step in run.steps:
        again = copy_window(replay.storage_after(run.frame.steps[step.index][1]).window).buffers()
        for drawn, replayed in zip(step.buffers, again, strict=True):
            assert drawn.tobytes() == replayed.tobytes()


def test_last_row_of_a_pixel_equals_the_buffers(run):
    rng = np.random.default_rng(1)
    for x, y in rng.integers(0, SIZE, (12, 2)):
        last = run.pixel(x, y)[-1]
        assert last.color_after == tuple(run.image[y, x])
        assert (last.depth_after, last.stencil_after) == (run.depth[y, x], run.stencil[y, x])


@pytest.mark.interpreted
@pytest.mark.parametrize("name", ss.technique_names())
def test_every_pixel_of_a_tiny_picture_ends_as_its_history_says(name):
    small = {"map_size": 16, "texture_size": 16, "layers": 2, "samples": 2}
    own = techniques.get(name).options
    run = ss.run(name, "boxes", (12, 9), **{key: value for key, value in small.items() if key in own})
    for y in range(9):
        for x in range(12):
            last = run.pixel(x, y)[-1]
            assert last.color_after == tuple(run.image[y, x])
            assert (last.depth_after, last.stencil_after) == (run.depth[y, x], run.stencil[y, x])


def test_buffers_are_those_of_gl_upside_down():
    with gl.create_context(*SIZE):
        maps = {}
        for item in techniques.get("volume-zfail").steps(gl, ss.Scene.named("torus"), size=SIZE):
            maps |= {} if isinstance(item, str) else item[1]
        stencil = gl.glReadPixels(0, 0, *SIZE, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)
        depth = gl.glReadPixels(0, 0, *SIZE, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
        image = gl.glReadPixels(0, 0, *SIZE, gl.GL_RGB, gl.GL_UNSIGNED_BYTE)
    run = ss.run("volume-zfail", "torus", SIZE)
    for ours, theirs in (
        (run.stencil, stencil), (run.depth, depth), (run.image, image), (run.visibility, maps["visibility"]),
    ):  # fmt: skip
        np.testing.assert_array_equal(ours, np.asarray(theirs).reshape(ours.shape)[::-1])


@settings(max_examples=8)
@given(floor_scenes())
def test_maps_and_buffers_lie_the_same_way_round(scene):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ss.Warning)
        run = ss.run("volume-zfail", scene, (32, 24))
    np.testing.assert_array_equal(run.valid, run[0].depth < 1)
    np.testing.assert_array_equal(run.shadow_mask, run.valid & (run.stencil != 0))
    drawn = run.valid.sum(axis=1)
    assert drawn[-1] >= drawn[0]  # the floor is below the sky


def test_a_budget_of_one_byte_changes_nothing(zfail):
    poor = ss.run("volume-zfail", "torus", SIZE, keep_bytes=1)
    for step, other in zip(zfail, poor, strict=True):
        np.testing.assert_array_equal(step.stencil, other.stencil)
        np.testing.assert_array_equal(step.image, other.image)


# -- steps -------------------------------------------------------------------------------------------------------------
def test_steps_are_found_by_number_and_by_title(zfail):
    assert zfail["count back faces"] is zfail[1]
    assert zfail[-1].title == "add the light where the count is 0"
    assert len(zfail) == len(zfail.steps) == len(list(zfail)) == 4
    with pytest.raises(KeyError, match="did you mean 'count back faces'"):
        zfail["count back face"]
    with pytest.raises(IndexError, match="there are 4"):
        zfail[4]


def test_a_step_tells_its_state_as_calls_and_its_draws_by_object(zfail):
    step = zfail["count back faces"]
    assert "glStencilOp(GL_KEEP, GL_INCR_WRAP, GL_KEEP)" in str(step.state)
    assert {draw.object for draw in step.draws} == {"torus"}
    assert [draw.draw for each in zfail for draw in each.draws] == list(range(zfail.ledger.total.draws))


def test_what_a_step_changed_is_in_the_difference(zfail):
    counts = zfail.diff(0, "count back faces").counts
    assert counts == {"image": 0, "depth": 0, "stencil": np.count_nonzero(zfail[1].stencil)}


def test_ledger_has_the_counts_of_every_step(zfail):
    titles = [counts.title for counts in zfail.ledger.steps]
    assert titles == zfail.steps.titles
    assert zfail.ledger.steps[1].stencil_updates > 0
    assert zfail.ledger.steps[0].stencil_updates == 0


def test_explanations_are_sentences_that_agree_with_the_visibility(run):
    sentences = {"is lit:": run.valid & (run.visibility == 1), "is in shadow:": run.valid & (run.visibility == 0)}
    for words, where in sentences.items():
        for y, x in np.argwhere(where)[::97]:
            sentence = run.explain(x, y)
            assert words in sentence
            assert sentence.startswith(f"pixel x={x} y={y} (GL y={SIZE[1] - 1 - y})")
    assert "background" in run.explain(0, 0)


def test_shadow_of_a_volume_is_explained_by_the_count(zfail):
    y, x = np.argwhere(zfail.shadow_mask)[0]
    assert "stencil test EQUAL: 0 == 1 is false" in zfail.explain(x, y)


# -- comparison --------------------------------------------------------------------------------------------------------
@pytest.mark.parametrize("scene", ["boxes", "room", "staircase", "two-lights"])
def test_z_fail_agrees_with_ray_casting_off_the_edges(scene):
    comparison = ss.run("volume-zfail", scene, SIZE).compare(truth="hard")
    assert {name: comparison.parts[name].wrong for name in ("lit", "umbra", "penumbra")} == dict.fromkeys(
        ("lit", "umbra", "penumbra"), 0
    )


def test_a_run_agrees_with_itself_and_differs_from_another(zfail):
    assert zfail.compare(zfail).max == 0
    assert zfail.compare(ss.run("map", "torus", SIZE, map_size=8)).max == 1


def test_comparisons_that_make_no_sense_are_refused(zfail):
    with pytest.raises(TypeError, match="expected another run"):
        zfail.compare()
    with pytest.raises(ValueError, match="sizes differ"):
        zfail.compare(ss.run("volume-zfail", "torus", (32, 24)))
    with pytest.raises(ValueError, match="sizes differ"):
        zfail.compare(truth=ss.soft_truth(zfail.scene, (32, 24)))
    with pytest.raises(ValueError, match='expected "hard" or "soft"'):
        zfail.compare(truth="harsh")


# -- misuse ------------------------------------------------------------------------------------------------------------
def test_a_technique_of_ones_own_is_run_like_a_registered_one():
    def steps(gl, scene, *, size, stencil=3):
        gl.glClearStencil(stencil)
        gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
        yield "clear"

    options = {"stencil": Option(3, int, "what to clear to")}
    own = Technique("own", "Its own", "tests", "nowhere", steps, options)
    assert (ss.run(own, "torus", SIZE).stencil == 3).all()
    run = ss.run(own, "torus", SIZE, stencil=5)
    assert (run.technique, run.steps.titles) == ("own", ["clear"])
    assert (run.stencil == 5).all()
    with pytest.raises(ValueError, match="technique 'own' has no option 'stencl': did you mean 'stencil'"):
        ss.run(own, "torus", SIZE, stencl=5)


def test_unknown_names_are_answered_with_the_nearest():
    with pytest.raises(ValueError, match="did you mean 'volume-zfail'"):
        ss.run("volume-zfial", "torus", SIZE)
    with pytest.raises(ss.SceneError, match="did you mean 'torus'"):
        ss.run("volume-zfail", "toruss", SIZE)
    with pytest.raises(ValueError, match="did you mean 'generator'"):
        ss.run("volume-zfail", "torus", SIZE, generater="silhouette")
    with pytest.raises(TypeError, match="expected a Scene"):
        ss.run("volume-zfail", 3, SIZE)


@pytest.mark.parametrize("size", [(0, 48), (64, -1), (64.5, 48), (64,), 64, "64x48", (64, 48, 3), (20000, 1), None])
def test_sizes_that_are_none_are_refused(size):
    with pytest.raises(ValueError, match="expected"):
        ss.run("volume-zfail", "torus", size)


def test_a_picture_larger_than_memory_is_refused_before_anything_is_drawn(monkeypatch):
    monkeypatch.setattr("softshadow.runs.perform.memory", lambda: 1e9)
    with pytest.raises(ss.StateError, match=r"about 4.3 GB and this machine has 1.0"):
        ss.run("volume-zfail", "torus", (4096, 4096))


def test_the_callers_context_is_current_again_also_after_an_error(monkeypatch):
    with gl.create_context(8, 8):
        mine = current()
        ss.run("volume-zfail", "torus", SIZE)
        assert current() is mine
        monkeypatch.setattr("softshadow.techniques.drawing.begin_frame", lambda gl, scene: 1 / 0)
        with pytest.raises(ZeroDivisionError):
            ss.run("volume-zfail", "torus", SIZE)
        assert current() is mine
    before = make_current(None)
    assert before is None or before is not mine


# -- warnings ----------------------------------------------------------------------------------------------------------
def test_warnings_point_to_the_call_and_are_kept():
    with pytest.warns(ss.NearClipZPass) as caught:
        run = ss.run("volume-zpass", "eye-in-shadow", SIZE)
    assert caught[0].filename == __file__
    assert [type(warning) for warning in run.warnings] == [ss.NearClipZPass]


def test_an_open_mesh_is_warned_of():
    with pytest.warns(ss.OpenMesh):
        ss.run("volume-zfail", "open-tube", SIZE)


def test_a_counter_at_its_end_is_warned_of_once():
    with pytest.warns(ss.CounterSaturated, match="largest count, 1") as caught:
        run = ss.run("volume-zfail", "overlapping", SIZE, ops="saturate", stencil_bits=1)
    assert len(caught) == len(run.warnings) == 1


def test_counters_that_wrap_are_not_called_saturated(zfail):
    assert zfail.warnings == ()


# -- files -------------------------------------------------------------------------------------------------------------
def test_a_saved_run_answers_as_before(run, tmp_path):
    again = ss.load_run(run.save(tmp_path / "run.npz"))
    assert (again.technique, again.size, dict(again.options)) == (run.technique, run.size, dict(run.options))
    assert again.steps.titles == run.steps.titles
    for step, other in zip(run, again, strict=True):
        assert all(a.tobytes() == b.tobytes() for a, b in zip(step.buffers, other.buffers, strict=True))
        assert {name: a.tobytes() for name, a in step.maps.items()} == {n: a.tobytes() for n, a in other.maps.items()}
        assert str(step.state) == str(other.state)
    for x, y in ((32, 30), (10, 40)):
        assert again.pixel(x, y) == run.pixel(x, y)
    assert again.compare(truth="hard").rms == run.compare(truth="hard").rms


def test_an_npz_is_plain_arrays_under_readable_names(zfail, tmp_path):
    with np.load(zfail.save(tmp_path / "run.npz"), allow_pickle=False) as stored:
        np.testing.assert_array_equal(stored["stencil"], zfail.stencil)
        np.testing.assert_array_equal(stored["steps/1/stencil"], zfail[1].stencil)
        np.testing.assert_array_equal(stored["visibility"], zfail.visibility)


def test_warnings_are_saved(tmp_path):
    with pytest.warns(ss.OpenMesh):
        run = ss.run("volume-zfail", "open-tube", SIZE)
    again = ss.load_run(run.save(tmp_path / "run.npz"))
    assert [(type(w), str(w)) for w in again.warnings] == [(type(w), str(w)) for w in run.warnings]


def test_a_png_is_the_picture(zfail, tmp_path):
    picture = imageio.imread(zfail.save(tmp_path / "picture.png"))
    np.testing.assert_array_equal(picture, zfail.image)


def test_an_html_file_is_the_report(zfail, tmp_path):
    assert "<h1>volume-zfail on torus</h1>" in zfail.save(tmp_path / "run.html").read_text(encoding="utf-8")


def test_a_folder_gets_every_buffer_of_every_step(zfail, tmp_path):
    folder = zfail.save(f"{tmp_path}/steps/")
    names = {path.name for path in folder.iterdir()}
    assert {"image.png", "steps.png", "visibility.png", "state.txt", "run.npz"} <= names
    assert {f"01-count-back-faces-{buffer}.png" for buffer in ("image", "depth", "stencil")} <= names
    assert "glStencilOp(GL_KEEP, GL_INCR_WRAP, GL_KEEP)" in (folder / "state.txt").read_text()
    zfail.save(folder)  # its own files may be written again


def test_a_path_without_an_ending_is_a_folder_though_it_has_no_slash(zfail, tmp_path):
    assert (zfail.save(tmp_path / "steps") / "run.npz").is_file()
    with pytest.raises(ValueError, match="a path that ends in /"):
        zfail.save(str(tmp_path / "other"))


def test_a_folder_with_one_foreign_file_in_the_way_is_left_as_it_was(zfail, tmp_path):
    (tmp_path / "state.txt").write_text("mine")
    with pytest.raises(ss.SoftShadowError, match="was not written by softshadow"):
        zfail.save(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["state.txt"]


def test_unknown_endings_and_foreign_files_are_refused(zfail, tmp_path):
    with pytest.raises(ValueError, match=r"expected an ending of .png, .npz, .html"):
        zfail.save(tmp_path / "run.tiff")
    (tmp_path / "photo.png").write_bytes(b"\x89PNG of somebody")
    with pytest.raises(ss.SoftShadowError, match="exists and was not written by softshadow"):
        zfail.save(tmp_path / "photo.png")
    zfail.save(tmp_path / "photo.png", force=True)


def test_files_that_are_no_runs_are_named(zfail, tmp_path):
    (tmp_path / "text.npz").write_text("no run")
    np.savez(tmp_path / "other.npz", image=np.zeros(3))
    good = zfail.save(tmp_path / "run.npz")
    (tmp_path / "cut.npz").write_bytes(good.read_bytes()[:5000])
    for name in ("text.npz", "other.npz", "cut.npz"):
        with pytest.raises(ss.SoftShadowError, match=f"{name}: not a run"):
            ss.load_run(tmp_path / name)
    with pytest.raises(ss.SoftShadowError, match=r"none.npz: there is no such file"):
        ss.load_run(tmp_path / "none.npz")


def test_a_run_holds_no_pickle(zfail, tmp_path):
    with zipfile.ZipFile(zfail.save(tmp_path / "run.npz")) as archive:
        assert {name.rsplit(".", 1)[-1] for name in archive.namelist()} == {"npy"}


# -- display -----------------------------------------------------------------------------------------------------------
def test_a_notebook_gets_text_and_a_picture(zfail):
    shown = zfail._repr_mimebundle_()[0]
    assert shown["text/plain"].startswith("Run('volume-zfail', scene 'torus', 64 x 48, 4 steps)")
    assert shown["image/png"].startswith("iVBORw0KGgo")  # a PNG's first bytes in base64
