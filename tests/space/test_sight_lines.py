"""Lines of sight: the crossings, counted along the line, end at the stencil value of every pixel."""

import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import softshadow as ss
from softshadow.space import line_of_sight
from strategies import floor_scenes

SIZE = (96, 72)
VARIANTS = [
    ("volume-zpass", "torus", {}),
    ("volume-zpass", "boxes", {"two_sided": True, "cap": "finite"}),
    ("volume-zpass", "eye-in-shadow", {"start": "near-plane"}),
    ("volume-zpass", "eye-in-shadow", {"start": "preload"}),
    ("volume-zpass", "eye-in-shadow", {"start": "eye"}),
    ("volume-zpass-plus", "eye-in-shadow", {}),
    ("volume-zpass", "torus", {"two_sided": True, "ops": "saturate"}),
    ("volume-zpass", "eye-in-shadow", {"stencil_bits": 1}),
    ("volume-zfail", "torus", {}),
    ("volume-zfail", "overlapping", {"stencil_bits": 2, "ops": "saturate"}),
    ("volume-zfail", "overlapping", {"generator": "per-polygon"}),
    ("volume-zfail", "sunlight", {"far": "clamp"}),
    ("volume-zfail", "open-tube", {"far": "finite"}),
    ("volume-zfail", "boxes", {"choose": "split-plane"}),
    ("volume-zfail", "eye-in-shadow", {"choose": "per-caster"}),
    ("volume-zfail", "two-lights", {}),
    ("volume-parity", "overlapping", {}),
]


def drawn(technique, scene, **options):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ss.Warning)
        return ss.run(technique, scene, SIZE, **options)


@pytest.mark.parametrize(("technique", "scene", "options"), VARIANTS)
def test_the_count_along_the_line_is_the_stencil_value(technique, scene, options):
    run = drawn(technique, scene, **options)
    random = np.random.default_rng(7)
    counted = 0
    for light in run.scene.lights:
        several = len(run.scene.lights) > 1
        last = max(step.index for step in run.steps if not several or step.title.endswith(f": {light.name}"))
        stencil = run.steps[last].stencil
        deep = random.permutation(np.argwhere(stencil != 0))[:10]
        for y, x in [*random.integers(0, (72, 96), (10, 2)).tolist(), *deep.tolist()]:
            line = line_of_sight(run, x, y, light.name)
            count = line.crossings[-1].count if line.crossings else line.start
            assert count == line.end == stencil[y, x], (light.name, x, y)
            counted += len(line.crossings)
            steps = np.diff([line.start, *(each.count for each in line.crossings)])
            values = 2 ** options.get("stencil_bits", 8)
            changes = np.array([each.change for each in line.crossings], int)
            assert line.inverts or not ((steps - changes) % values).any()
    assert counted


@settings(max_examples=12)
@given(floor_scenes(), st.sampled_from(["volume-zpass", "volume-zfail"]), st.randoms(use_true_random=False))
def test_the_count_is_the_stencil_value_in_random_scenes(scene, technique, random):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ss.Warning)
        run = ss.run(technique, scene, (32, 24))
    light = scene.lights[-1].name
    for _ in range(10):
        x, y = random.randrange(32), random.randrange(24)
        line = run.line_of_sight(x, y, light)
        assert (line.crossings[-1].count if line.crossings else line.start) == line.end == run.stencil[y, x]


@pytest.mark.parametrize("technique", ["volume-zpass", "volume-zfail"])
def test_crossings_lie_on_the_line_and_on_the_faces_that_they_name(technique):
    run = drawn(technique, "boxes")
    geometry = run.geometry(distance=1e4)
    random = np.random.default_rng(3)
    checked = 0
    for y, x in random.permutation(np.argwhere(run.stencil != 0))[:30].tolist():
        line = run.line_of_sight(x, y)
        towards = line.near_point - line.eye
        for each in (*line.crossings, *line.others):
            if each.place is None:
                continue
            off = np.linalg.norm(np.cross(each.place - line.eye, towards)) / np.linalg.norm(towards)
            assert off < 1e-9
            part = {"side": "sides"}.get(each.part, each.part)
            faces = geometry[f"volume/light/{each.caster}/{part}"].faces.astype(float)
            face = faces[2 * each.number if each.part == "side" else each.number]
            normal = np.cross(face[1] - face[0], face[2] - face[0])
            distance = abs(normal @ (each.place - face[0])) / np.linalg.norm(normal)
            # window z has 24 bits, and the far end of a face is 10,000 units away
            assert distance < 2e-3, (x, y, each)
            assert (normal @ towards < 0) == each.front_facing
            checked += 1
    assert checked > 20


def test_passing_faces_are_counted_from_the_eye_and_failing_ones_from_infinity():
    for technique, sign in (("volume-zpass", 1), ("volume-zfail", -1)):
        run = drawn(technique, "overlapping")
        y, x = np.argwhere(run.stencil == run.stencil.max())[5]
        line = run.line_of_sight(int(x), int(y))
        assert len(line.crossings) > 1
        depths = sign * np.array([each.z for each in line.crossings])
        assert (np.diff(depths) >= 0).all()
        assert "the count starts from 0" in str(line)
        assert f"{line.crossings[0].change:+d} = {line.crossings[0].count}" in str(line)


def test_a_technique_that_does_not_count_has_a_line_without_crossings():
    line = drawn("map", "boxes").line_of_sight(48, 40)
    assert (line.end, line.crossings) == (None, ())
    assert "counts no faces" in str(line)


def test_a_pixel_or_light_that_does_not_exist_is_refused():
    run = drawn("volume-zfail", "boxes")
    with pytest.raises(ValueError, match="x=96"):
        run.line_of_sight(96, 0)
    with pytest.raises(ValueError, match="did you mean 'light'"):
        run.line_of_sight(1, 1, "ligth")
