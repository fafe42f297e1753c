"""Nested planar shadows: hard shadows on parallel copies of the floor, laid over each other.

The light stays a point. The casters are flattened onto several planes parallel to the receiver, each a little nearer to
the light, and the pictures are moved straight back to the receiver. The mean of these layers looks like a soft shadow
for the price of a few hard ones, and is not meant to be more: the paper draws technical illustrations.

Seen from the foot of the light on the receiver, every layer is a smaller copy of the first, by (H - k) / H for a plane
at height k under a light at height H; a distant light shifts the layers instead.

Paper: Gooch, Sloan, Gooch, Shirley & Riesenfeld 1999, "Interactive technical illustration", section on shadows.
Slides: Zimányi & Valient, Mäkké tiene, Gooch.

Known failures: the softness grows with the distance from the foot of the light and not with the height of the caster,
so a caster that stands on the floor is blurred at its feet, where a real shadow is sharp; parts of casters below a
layer's plane cast nothing onto it, and the shadow comes off their feet; with the first plane at the receiver the umbra
is that of the light's centre, too large; receivers have to be flat, casters have no shadow on themselves.
"""

from typing import Annotated, Any

import numpy as np

from softshadow.scene import Light, Scene, SceneObject
from softshadow.techniques import drawing, receiver_textures
from softshadow.techniques.planar_accumulated import draw_with_shares
from softshadow.techniques.technique import Range, Steps

SPREAD = 0.25  # of the light's height over the receiver, between the first and the last plane
FAR_SPREAD = 0.05  # of the scene's size, for a light at infinity, which has no height


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    layers: Annotated[int, "parallel planes on which hard shadows are drawn", Range(1, 255)] = 8,
    spread: Annotated[
        float | None,
        "distance between the first and the last plane, in world units; by default a quarter of the light's height",
        Range(0),
    ] = None,
    texture_size: Annotated[int, "texels on a side of each receiver's shadow", Range(1, 4096)] = 512,
) -> Steps:
    """Draw the scene with nested planar shadows."""
    shares: list[dict[str, np.ndarray]] = []
    for light in scene.lights:
        share = {}
        for receiver in scene.receivers:
            shifts = heights_of_planes(scene, receiver, light, layers, spread)
            views = (receiver_textures.view_of(scene, receiver, light.position, shift) for shift in shifts)
            covered = receiver_textures.count_covered(gl, scene, receiver, views, texture_size)
            share[receiver.name] = (1 - covered / layers).astype(np.float32)
        shares.append(share)
        yield (
            drawing.title("flatten the casters onto parallel planes", scene, light),
            {drawing.title(f"texture of {name}", scene, light): image for name, image in share.items()},
        )
    yield from draw_with_shares(gl, scene, size, shares)


def heights_of_planes(
    scene: Scene, receiver: SceneObject, light: Light, layers: int, spread: float | None
) -> np.ndarray:
    """Return the distances of the planes from the receiver towards the light, (layers,), the first is 0."""
    assert receiver.plane is not None
    if spread is None:
        if light.is_directional:
            vertices = np.concatenate([thing.world_positions for thing in scene.objects])
            spread = FAR_SPREAD * float(np.ptp(vertices, axis=0).max())
        else:
            height = abs(float(receiver.plane @ light.position)) / float(np.linalg.norm(receiver.plane[:3]))
            spread = SPREAD * height
    return np.linspace(0.0, spread, layers)
