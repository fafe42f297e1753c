"""Histories of every technique and listing: they end as the buffers, and their causes are those of the picture."""

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import softshadow as ss
from softshadow import listings
from softshadow.inspection import pixel_history
from softshadow.inspection.replay import copy_window
from softshadow.listings.stage import SIZE as LISTING_SIZE
from softshadow.runs import Run
from softshadow.techniques import Technique
from softshadow.testing.comparison import run_recorded

SIZE = (96, 72)
SCENES = ("boxes", "two-lights", "spotlight")
FEW = 6  # pixels of each kind


@cache
def run(name: str, scene: str) -> Run:
    return ss.run(name, scene, size=SIZE)


def some(mask: np.ndarray, count: int = FEW) -> list[tuple[int, int]]:
    """Some pixels (x, y) of a mask."""
    y, x = np.nonzero(mask)
    chosen = np.random.default_rng(len(y)).permutation(len(y))[:count]
    return [(int(x[n]), int(y[n])) for n in chosen]


each_technique = pytest.mark.parametrize("name", ss.technique_names())


@each_technique
def test_last_row_equals_the_buffers(name):
    drawn = run(name, "boxes")
    for x, y in some(np.ones(SIZE[::-1], bool), 12):
        row = drawn.pixel(x, y)[-1]
        assert row.color_after == tuple(drawn.image[y, x])
        assert (row.depth_after, row.stencil_after) == (drawn.depth[y, x], drawn.stencil[y, x])


@pytest.mark.parametrize("name", listings.names())
def test_last_row_of_a_listing_equals_its_buffers(name):
    listing = listings.get(name)
    for program in (listing.printed, listing.corrected):
        _, frame = run_recorded(program, LISTING_SIZE)
        window = copy_window(ss.inspection.Replay(frame).storage_after(len(frame.commands)).window).buffers()
        for x, y in some(np.ones(LISTING_SIZE[::-1], bool)):
            row = pixel_history(frame, x, y)[-1]
            assert row.color_after == tuple(window.color[y, x, :3])
            assert (row.depth_after, row.stencil_after) == (window.depth[y, x], window.stencil[y, x])


@pytest.mark.thin(4)
@pytest.mark.parametrize("scene", SCENES)
@each_technique
def test_table_fits_in_100_columns(name, scene):
    drawn = run(name, scene)
    for x, y in some(drawn.shadow_mask, 3):
        assert max(map(len, str(drawn.pixel(x, y)).splitlines())) <= 100


@each_technique
def test_rows_are_plain_data_for_json(name):
    drawn = run(name, "boxes")
    ((x, y),) = some(drawn.shadow_mask, 1)
    assert len(json.loads(json.dumps(drawn.pixel(x, y).to_dicts()))) == len(drawn.pixel(x, y))


@pytest.mark.thin(2)
@pytest.mark.parametrize("scene", SCENES)
@each_technique
def test_causes_of_shadow_are_failed_tests_or_lookups(name, scene):
    drawn = run(name, scene)
    for x, y in some(drawn.shadow_mask):
        hidden = [light.name for light in drawn.lights if light.visibility[y, x] < 1 - 1e-6]
        causes = drawn.causes(x, y)
        assert [cause.light for cause in causes] == hidden
        for cause in causes:
            assert cause.kind != "unknown"
            row = cause.row
            if cause.kind == "outside the cone":
                continue
            assert row is not None
            is_rejected = row.verdict in ("stencil failed", "alpha failed")
            looks_up = any(lookup.lit is not None and lookup.lit < 1 for lookup in row.lookups)
            is_dark = row.lights == () and row.verdict == "passed"  # painted over, or drawn without the light
            blends_less = row.lights == (cause.light,) and row.verdict == "passed"
            assert is_rejected or looks_up or is_dark or blends_less
            assert row in drawn.pixel(x, y).rows


@pytest.mark.parametrize("scene", SCENES)
@each_technique
def test_sentences_agree_with_the_visibility(name, scene):
    drawn = run(name, scene)
    for word, mask in (("is lit", drawn.visibility >= 1), ("shadow of", drawn.visibility <= 0)):
        for x, y in some(drawn.valid & mask, 3):
            sentence = drawn.explain(x, y)
            assert word in sentence or "in shadow:" in sentence
            assert ("lit" in sentence) or not mask[y, x] or word != "is lit"
            if len(drawn.lights) > 1 and "is lit" not in sentence:
                assert all(light.name in sentence for light in drawn.lights)


@pytest.mark.parametrize(
    "name", ["volume-zpass", "volume-zfail", "volume-parity", "map", "map-cube", "shadow-polygons"]
)
def test_casters_stand_between_point_and_light(name):
    drawn = run(name, "boxes")
    hidden_by_one = {
        caster.name: replace(drawn.scene, objects=tuple(t for t in drawn.scene.objects if t is caster or not t.casts))
        for caster in drawn.scene.casters
    }
    truth = {caster: ss.run("volume-zfail", scene, size=SIZE) for caster, scene in hidden_by_one.items()}
    for x, y in some((drawn.shadow_kinds() == 2) & (drawn.stencil >= 0), 12):
        surface = drawn.pixel(x, y).rows[-1].object
        (cause,) = drawn.causes(x, y)
        if surface == "floor":
            assert cause.casters
            around = np.s_[max(y - 1, 0) : y + 2, max(x - 1, 0) : x + 2]  # a map's texels are coarse
            assert all((truth[caster].visibility[around] == 0).any() for caster in cause.casters)


def test_own_shadow_is_told_from_cast_shadow():
    drawn = run("volume-zfail", "boxes")
    kinds = drawn.shadow_kinds()
    assert set(np.unique(kinds)) == {0, 1, 2}
    assert ((kinds > 0) == drawn.shadow_mask).all()
    for kind, words in ((1, "own shadow, "), (2, "cast by ")):
        for x, y in some(kinds == kind):
            assert words in drawn.explain(x, y)


def test_explanation_of_a_technique_without_debug_groups():
    def steps(gl, scene, *, size):
        gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
        gl.glColor3f(1.0, 0.0, 0.0)
        gl.glRectf(-0.5, -0.5, 0.5, 0.5)
        yield "draw a red square", {"visibility": np.zeros(size[::-1], np.float32), "valid": np.ones(size[::-1], bool)}

    drawn = ss.run(Technique("mine", "Mine", "planar", "none", steps), "boxes", size=(20, 12))
    assert "in shadow: the surface (triangle" in drawn.explain(10, 6)
    assert "background" in drawn.explain(0, 0)


def test_history_of_a_framebuffer_object():
    drawn = run("map-pcf", "boxes")
    rows = drawn.pixel(40, 40, framebuffer=2).rows
    assert {row.framebuffer for row in rows} == {2}
    assert any(row.lookups for row in rows)
    with pytest.raises(ValueError, match=r"framebuffer=9: nothing was drawn to it; expected one of \[0, 1, 2\]"):
        drawn.pixel(0, 0, framebuffer=9)


@pytest.mark.parametrize(
    ("name", "options", "shown"),
    [
        ("map", {}, "ZS"),
        ("map", {"storage": "copy", "map_size": 64}, "ZS"),
        ("map-cube", {}, "ZS -y"),
        ("map-variance", {}, "moments"),
        ("map-distance", {}, "distances"),
        ("planar", {"method": "texture"}, "texture of floor"),
    ],
)
def test_history_of_a_texel_ends_with_the_map(name, options, shown):
    drawn = ss.run(name, "boxes", size=SIZE, **options)
    texels = drawn.maps[shown]
    first = texels if texels.ndim == 2 else texels[..., 0]
    for x, y in some(first < first.max()):
        history = drawn.map_pixel(shown, x, y)
        assert history.heading == f"texel x={x} y={y} (GL y={len(first) - 1 - y}) of {shown}"
        if shown.startswith("ZS"):
            assert history[-1].depth_after == first[y, x]
        elif shown in ("moments", "distances"):
            assert history[-1].color_after[0] == first[y, x]
        assert any(row.verdict == "passed" and row.object in ("floor", "cube", "tower", "block") for row in history)


def test_maps_that_are_not_textures_have_no_history():
    with pytest.raises(ss.StateError, match="map 'unknown' does not have the texels of a texture; expected one of"):
        run("map", "boxes").map_pixel("unknown", 0, 0)
    with pytest.raises(ss.StateError, match="did you mean 'ZS'"):
        run("map", "boxes").map_pixel("Zs", 0, 0)


def test_a_saved_run_tells_the_same(tmp_path):
    drawn = run("volume-zfail", "boxes")
    drawn.save(tmp_path / "run.npz")
    loaded = ss.load_run(tmp_path / "run.npz")
    for x, y in some(drawn.shadow_mask):
        assert loaded.pixel(x, y) == drawn.pixel(x, y)
        assert loaded.explain(x, y) == drawn.explain(x, y)
