"""Penumbra wedges: hard shadow volumes, corrected at each silhouette edge by what the edge hides of an area light.

From the light's centre, shadow volumes tell how often each point is covered: all of the light, or nothing. Around each
silhouette edge, the wedge contains the points that see this edge in front of the light. There the edge is projected
onto the light: to a point outside the hard shadow it hides a part of the light, which is taken away; to a point inside
it leaves a part visible, which is given back. The part is an exact area, and the wedges are independent of each other:
all of them are added up in a float buffer, in one draw.

Paper: Assarsson & Akenine-Möller 2003, "A geometry-based soft shadow volume algorithm using graphics hardware".
Slides: Zimányi & Valient, Penumbra wedges (construction, rasterization, pros and cons).

At the edge of the hard shadow the count jumps by 1, and so does the sum of what is taken and given back. The light
changes continuously, provided that count and wedges agree on which side of an edge's plane a point lies. So the sides
of volumes are not tested against the depth buffer, but by the sign that the wedges use; `decide` = depth shows what
happens else. A light without a shape has no wedges, and gives the shadows of z-fail.

Known failures: the silhouette is that of the light's centre, so casters whose silhouette changes over the light get
wrong penumbrae, the more the nearer and larger the light is; a face whose plane cuts the light sees the part below its
own horizon, too; what two casters cover is added, where they overlap too (0.8 of the light for 0.4); an edge near the
light has all of space as its wedge.
"""

import warnings
from typing import Annotated, Any

import numpy as np

from softshadow.errors import EdgeNearLight
from softshadow.scene import Light, Scene
from softshadow.scene.penumbra_wedge import PenumbraWedges, SilhouetteEdges, penumbra_wedges, silhouette_edges
from softshadow.techniques import drawing, shadow_volumes, wedge_passes
from softshadow.techniques.technique import Steps
from softshadow.techniques.visibility_buffer import add_light_times


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    decide: Annotated[
        wedge_passes.Decide,
        "what decides whether a side of a volume is behind a point: its plane, as for wedges, or depth",
    ] = "planes",
) -> Steps:
    """Draw the scene with penumbra wedges."""
    # step 1: the scene as if all of it were in shadow
    drawing.begin_frame(gl, scene)
    drawing.set_camera(gl, scene.camera, size)
    drawing.light_ambient_only(gl, scene)
    drawing.draw_objects(gl, scene.objects)
    valid = drawing.read_depth(gl, size) < 1
    yield "draw the scene without the light"

    lit = []
    for light in scene.lights:
        # step 2: the points that are visible, for which the programs compute what they see of the light
        buffers, positions = wedge_passes.draw_positions(gl, scene, light, size)
        yield (
            drawing.title("store the visible points", scene, light),
            {drawing.title("positions", scene, light): positions},
        )

        # step 3: the hard shadow, counted in the float buffer
        volumes = shadow_volumes.volumes_of(scene, light)
        edges = silhouette_edges(scene.casters, light)
        texture = wedge_passes.edge_texture(gl, edges, light)
        by = "depth" if light.shape is None else decide
        with wedge_passes.behind_points(gl, scene, buffers, size):
            wedge_passes.count_volumes(gl, volumes, buffers, texture, by)
        counts = wedge_passes.read_texture(gl, buffers.covered)[..., 3]
        yield (
            drawing.title("count the volumes", scene, light),
            {drawing.title("count", scene, light): as_counts(counts, valid)},
        )

        # step 4: what each wedge takes of the light or gives back
        if light.shape is not None:
            wedges = wedges_of(edges, light)
            with wedge_passes.behind_points(gl, scene, buffers, size):
                wedge_passes.add_wedges(gl, scene, light, edges, wedges, buffers, texture)
        taken, given, number, covered = np.moveaxis(wedge_passes.read_texture(gl, buffers.covered), 2, 0)
        yield (
            drawing.title("add what each wedge takes or gives back", scene, light),
            {
                drawing.title("taken", scene, light): np.where(valid, taken, 0),
                drawing.title("given back", scene, light): np.where(valid, given, 0),
                drawing.title("wedges", scene, light): as_counts(number, valid),
                drawing.title("coverage", scene, light): np.where(valid, covered, 0),
            },
        )

        # step 5: the light, times the share of it that is not covered
        visibility, values = wedge_passes.visible_share(gl, scene, light, size, buffers)
        lit.append(values)
        add_light_times(gl, scene, size, light, visibility)
        gl.glDeleteTextures([visibility, texture.name])
        wedge_passes.delete_buffers(gl, buffers)
        yield drawing.title("add the share of the light", scene, light), drawing.visibility_maps(scene, lit, valid)


def as_counts(values: np.ndarray, valid: np.ndarray) -> np.ndarray:
    """Return whole numbers as uint8, from 0 to its largest value; 0 where there is no surface."""
    return np.where(valid, values.clip(0, 255), 0).astype(np.uint8)


def wedges_of(edges: SilhouetteEdges, light: Light) -> PenumbraWedges:
    """Return the wedges of silhouette edges; warns of those that are all of space."""
    assert light.shape is not None
    wedges = penumbra_wedges(edges.ends, light.position[:3], light.shape.bounding_radius)
    if wedges.everywhere.any():
        warnings.warn(
            f"light {light.name!r}: the lines of {int(wedges.everywhere.sum())} of {len(wedges)} silhouette edges meet "
            "the sphere around the light; their penumbra wedges are all of space",
            EdgeNearLight,
            stacklevel=3,
        )
    return wedges
