"""The same technique files on softshadow and on Mesa's llvmpipe: every step's buffers, pixel by pixel."""

from typing import Any

import pytest

from combinations import with_quick
from softshadow.scene import Scene, scene_names
from softshadow.testing import run_on_mesa
from techniques.drawn_frames import draw, program

SIZE = (96, 72)

VARIANTS: list[tuple[str, dict[str, Any]]] = [
    *[("planar", {"method": method}) for method in ("depth-off", "offset", "stencil", "stencil-blend", "texture")],
    ("blob", {}),
    ("shadow-polygons", {"combine": "modulate"}),
    ("shadow-polygons", {"form": "silhouettes", "method": "decal"}),
    ("volume-zpass", {}),
    ("volume-zpass", {"two_sided": True, "far": "clamp"}),
    ("volume-zfail", {}),
    ("volume-zfail", {"cap": "finite", "generator": "per-polygon", "ops": "saturate"}),
    ("volume-zpass", {"start": "near-plane"}),
    ("volume-zpass", {"start": "preload"}),
    ("volume-zpass", {"choose": "split-plane", "two_sided": True}),
    ("volume-zpass-plus", {}),
    ("volume-parity", {}),
    ("volume-wedges", {}),
    ("map", {}),
    ("map", {"filter": "linear", "map_size": 64}),
    ("map", {"storage": "copy", "map_size": 48}),
    ("map", {"surface": "back", "bias": 0.003, "outside": "shadow"}),
    ("map-pcf", {}),
    ("map-pcf", {"kernel": 1, "bilinear": True, "outside": "shadow"}),
    ("map-pcss", {"map_size": 64, "search": 4, "taps": 5}),
    ("map-variance", {"map_size": 64, "bleed": 0.2}),
    ("map-exponential", {"map_size": 64, "blur": 1, "outside": "shadow"}),
    ("map-cube", {"map_size": 64}),
    ("map-silhouette", {"map_size": 64}),
    ("volume-sampled", {"samples": 4}),
    ("map-sampled", {"samples": 3, "pattern": "sobol", "map_size": 64}),
    ("map-sampled", {"samples": 11, "together": 8, "map_size": 64, "outside": "edge"}),
    ("planar-accumulated", {"samples": 4, "texture_size": 64}),
    ("planar-accumulated", {"samples": 5, "pattern": "jittered", "method": "accumulation"}),
    ("planar-nested", {"layers": 3, "texture_size": 64}),
    ("map", {"surface": "midpoint", "map_size": 64, "factor": 0.0, "normal_bias": 0.02}),
    ("map", {"map_format": "d16", "storage": "copy", "map_size": 48}),
    ("map", {"map_format": "d32f", "surface": "midpoint", "map_size": 64}),
    ("map-pcss", {"map_format": "d32", "map_size": 64, "search": 4, "taps": 5}),
    ("map-cube", {"map_format": "d16", "map_size": 64}),
    ("map-distance", {}),
    ("map-distance", {"map_size": 64, "outside": "shadow", "bias": 0.05, "normal_bias": 0.0}),
]


TAKE_POINTS_ONLY = ("map-cube",)
STEP = 4  # the quick lane takes every fourth scene of a variant, and every fourth variant of a scene
CASES = [(name, *variant) for name in scene_names() for variant in VARIANTS]
QUICK = {i * len(VARIANTS) + j for i in range(len(scene_names())) for j in range(len(VARIANTS)) if (i + j) % STEP == 0}


@pytest.mark.thin(2)
@pytest.mark.mesa
@pytest.mark.parametrize(("name", "technique", "options"), with_quick(CASES, QUICK))
def test_a_technique_leaves_the_same_buffers_on_mesa(name: str, technique: str, options: dict[str, Any]) -> None:
    scene = Scene.named(name)
    if technique in TAKE_POINTS_ONLY and any(light.is_directional for light in scene.lights):
        pytest.skip("a light at infinity has no inside")
    here = draw(technique, scene, SIZE, **options)
    there = run_on_mesa(lambda gl: program(gl, technique, scene, SIZE, options), SIZE).returned
    assert here.titles == there.titles
    assert here.warnings == there.warnings
    for title in here.titles:
        assert (here.stencil[title] == there.stencil[title]).all(), title
        assert (here.depth[title] == there.depth[title]).all(), title
        assert (here.color[title] == there.color[title]).all(), title
    assert here.maps.keys() == there.maps.keys()
    for key, array in here.maps.items():
        assert (array == there.maps[key]).all(), key
