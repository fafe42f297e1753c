"""All workloads by name: those of the performance targets, and each technique on each scene."""

from __future__ import annotations

from softshadow import techniques
from softshadow.bench import (
    light_samples,
    shadow_map_shading,
    small_triangles,
    stencil_fill,
    technique_frame,
    volume_frame,
    volume_geometry,
)
from softshadow.bench.workload import Workload
from softshadow.errors import nearest
from softshadow.scene import scene_names

FULL_HD, HD, SQUARE, VGA = (1920, 1080), (1280, 720), (2048, 2048), (640, 480)


def _stencil_fill(counting: str, depth_format: str) -> Workload:
    where = "passes" if counting == "zpass" else "fails"
    return Workload(
        f"w1-{counting}-{depth_format}",
        f"stencil fill: 400 large quads counted where the depth test {where}, {depth_format}",
        stencil_fill.prepare,
        FULL_HD,
        {"counting": counting, "depth_format": depth_format, "quads": stencil_fill.QUADS},
        aim=6.0,
    )


def _steep_fill(counting: str, depth_format: str, *, saturating: bool = False) -> Workload:
    where = "passes" if counting == "zpass" else "fails"
    ending = ", counts stop at their ends" if saturating else ""
    return Workload(
        f"w1-steep-{counting}-{depth_format}{'-saturating' if saturating else ''}",
        f"stencil fill: 400 steep triangles counted where the depth test {where}, {depth_format}{ending}",
        stencil_fill.prepare_steep,
        FULL_HD,
        {
            "counting": counting,
            "depth_format": depth_format,
            "saturating": saturating,
            "triangles": stencil_fill.TRIANGLES,
        },
        aim=6.0,
    )


def _small_triangles(shape: str) -> Workload:
    amounts = {"shape": shape, "triangles": small_triangles.TRIANGLES}
    title = f"small triangles: depth only, 1 M triangles of a {shape}"
    return Workload(f"w2-{shape}", title, small_triangles.prepare, SQUARE, amounts, aim=3.0)


def _shading(name: str, program: str, lookups: str) -> Workload:
    amounts = {"program": program, "triangles": 70_000, "map_size": shadow_map_shading.MAP_SIZE}
    title = f"shading: Blinn-Phong per pixel with a shadow map, {lookups}"
    return Workload(f"w3-{name}", title, shadow_map_shading.prepare, FULL_HD, amounts, aim=1.8)


WORKLOADS = {
    workload.name: workload
    for workload in (
        _stencil_fill("zpass", "d24"),
        _stencil_fill("zfail", "d24"),
        _stencil_fill("zpass", "d32f"),
        _stencil_fill("zfail", "d32f"),
        _steep_fill("zpass", "d24"),
        _steep_fill("zfail", "d32f"),
        _steep_fill("zpass", "d24", saturating=True),
        _small_triangles("sphere"),
        _small_triangles("grid"),
        _shading("nearest", "blinn-phong-shadowed", "one comparison"),
        _shading("pcf", "blinn-phong-shadowed-5x5", "5x5 comparisons"),
        Workload(
            "w4",
            "whole z-fail frame: silhouette, extrusion, ambient, two volume passes, light",
            volume_frame.prepare,
            HD,
            {"triangles": 70_000},
            aim=2.5,
        ),
        Workload(
            "w5",
            "soft shadow from light samples: one shadow map each, accumulated",
            light_samples.prepare,
            VGA,
            {"samples": light_samples.SAMPLES, "triangles": light_samples.TRIANGLES},
            aim=5.0,
        ),
        Workload(
            "silhouette",
            "silhouette, extrusion and caps of a shadow volume, nothing drawn",
            volume_geometry.prepare,
            VGA,
            {"triangles": volume_geometry.TRIANGLES},
        ),
    )
}


def names() -> list[str]:
    """Return the names of all workloads: the numbered ones, then TECHNIQUE/SCENE."""
    return [*WORKLOADS, *(f"{technique}/{scene}" for technique in techniques.names() for scene in scene_names())]


def get(name: str) -> Workload:
    """Return the workload with this name.

    Raises
    ------
    ValueError                   unknown name; the message suggests the nearest
    """
    technique, slash, scene = name.partition("/")
    if name in WORKLOADS:
        return WORKLOADS[name]
    if not slash:
        raise ValueError(f"unknown workload {name!r}: {nearest(name, [*WORKLOADS, 'TECHNIQUE/SCENE'])}")
    title = techniques.get(technique).title
    if scene not in scene_names():
        raise ValueError(f"workload {name!r}: unknown scene {scene!r}: {nearest(scene, scene_names())}")
    amounts = {"technique": technique, "scene": scene}
    return Workload(name, f"{title}, scene {scene}", technique_frame.prepare, VGA, amounts)


def select_workloads(patterns: list[str]) -> list[Workload]:
    """Return the workloads that match names or patterns, each once.

    A pattern may be the beginning of numbered names ("w1", "w3-"), "all" for every workload in `WORKLOADS`, or
    "TECHNIQUE/all" for a technique on each scene.

    Raises
    ------
    ValueError                   as `get`
    """
    matches: list[str] = []
    for pattern in patterns:
        technique, slash, scene = pattern.partition("/")
        if pattern == "all":
            matches += WORKLOADS
        elif slash and scene == "all":
            matches += [f"{technique}/{each}" for each in scene_names()]
        else:
            matches += [name for name in WORKLOADS if name.partition("-")[0] == pattern.rstrip("-")] or [pattern]
    return [get(name) for name in dict.fromkeys(matches)]
