"""Random GL programs, one per seed: random state and random triangles, for comparing two implementations of GL.

A program draws a few batches of primitives, each under freshly drawn state, and reads some buffers on its way. Vertices
are drawn from what rasterizers get wrong: tiny, huge and degenerate triangles, common planes, vertices on pixel
centres, behind the eye, with w <= 0 and at infinity. Many colours are exact ties of the rounding to 8 bits.

A family is a part of GL: what is prepared once, and the state drawn before every batch.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mesa import (
    random_arrays,
    random_attributes,
    random_boxes,
    random_buffers,
    random_combining,
    random_cube_maps,
    random_extremes,
    random_images,
    random_mipmaps,
    random_packed,
    random_pixels,
    random_scenes,
    random_shading,
    random_structure,
    random_texturing,
)
from mesa.gl_calls import Call
from mesa.random_writer import LINES_AND_POINTS, PRIMITIVES, Writer


def nothing(writer: Writer) -> None:
    """Prepare nothing."""


def geometry(writer: Writer) -> None:
    if writer.chance(0.2):
        writer.matrices(rotations=False)
    writer.geometry_state()
    if writer.chance(0.3):
        writer.fragment_state()


def fragments(writer: Writer) -> None:
    if writer.chance(0.2):
        writer.matrices(rotations=False)
    writer.fragment_state()
    if writer.chance(0.2):
        writer.clear()


def matrices(writer: Writer) -> None:
    writer.matrices(rotations=True)
    writer.geometry_state()
    if writer.chance(0.3):
        writer.fragment_state()


def everything(writer: Writer) -> None:
    """All of the state of geometry and fragments, with wild vertices: shadow volumes are such programs."""
    if writer.chance(0.5):
        writer.matrices(rotations=True)
    writer.geometry_state()
    writer.fragment_state()


def lines(writer: Writer) -> None:
    """Lines, points, and polygons of which only these are drawn."""
    if writer.chance(0.2):
        writer.matrices(rotations=False)
    writer.geometry_state()
    if writer.chance(0.3):
        writer.fragment_state()
    writer.outline_state()
    writer.primitives = LINES_AND_POINTS if writer.chance(0.5) else PRIMITIVES


@dataclass(frozen=True)
class Family:
    """A part of GL: what is written before each batch, what once before all and once after, and which vertices."""

    state: Callable[[Writer], None]
    prepare: Callable[[Writer], None] = nothing
    finish: Callable[[Writer], None] = nothing
    batch: Callable[[Writer, bool], None] = Writer.draw
    wild: bool = True


FAMILIES = {
    "geometry": Family(geometry),
    "fragments": Family(fragments, wild=False),
    "matrices": Family(matrices),
    "everything": Family(everything),
    "lines": Family(lines),
    "textures": Family(random_texturing.textured, random_texturing.texture, random_texturing.copied, wild=False),
    "framebuffers": Family(random_texturing.shadowed, Writer.shadow_map, wild=False),
    "projected textures": Family(random_texturing.projected, random_texturing.texture),
    "two textures": Family(random_texturing.two_textures, random_texturing.texture_pair, wild=False),
    "lighting": Family(random_shading.lit, random_shading.lights),
    "fog": Family(random_shading.fogged),
    "clip planes": Family(random_structure.clipped),
    "scissored clears": Family(random_structure.scissored_clears),
    "lists": Family(everything, batch=random_structure.listed),
    "attribute stacks": Family(random_structure.pushed),
    "offscreen": Family(random_structure.offset, random_structure.offscreen, random_structure.read_offscreen),
    "cube maps": Family(random_cube_maps.mapped, random_cube_maps.cubes, random_cube_maps.copied_faces, wild=False),
    "other dimensions": Family(random_boxes.boxed, random_boxes.boxes, random_boxes.copied_boxes, wild=False),
    "arrays": Family(random_arrays.pointed_state, random_texturing.texture, batch=random_arrays.pointed),
    "mipmaps": Family(random_mipmaps.minified, random_mipmaps.levels, wild=False),
    "images": Family(random_images.uploaded, wild=False),
    "depth images": Family(random_images.uploaded_depth, wild=False),
    "read-outs": Family(everything, finish=random_images.read_out),
    "combiners": Family(random_combining.combined, random_combining.two_images, wild=False),
    "accumulation": Family(random_buffers.accumulated, finish=random_buffers.accumulated_lights),
    "queries": Family(everything, batch=random_buffers.counted),
    "float targets": Family(random_buffers.blended_floats, random_buffers.float_target, random_buffers.read_target),
    "several framebuffers": Family(
        random_buffers.switched, random_buffers.several_framebuffers, random_buffers.read_framebuffers, wild=False
    ),
    "many lights": Family(random_shading.lit, random_shading.many_lights, batch=random_shading.with_materials),
    "planar shadows": Family(random_scenes.view, batch=random_scenes.planar_shadow),
    "shadow volumes": Family(random_scenes.view, batch=random_scenes.shadow_volumes),
    "shadow maps": Family(random_scenes.view, batch=random_scenes.shadow_mapped),
    "lights one by one": Family(random_scenes.view, batch=random_scenes.lights_one_by_one),
    "soft shadows": Family(random_scenes.view, batch=random_scenes.soft_shadow),
    "far coordinates": Family(random_extremes.extreme, random_extremes.odd_window, batch=random_extremes.far_away),
    "extreme viewports": Family(random_extremes.extreme, random_extremes.odd_window),
    "slivers": Family(geometry, random_extremes.odd_window, batch=random_extremes.sliver),
    "meshes": Family(geometry, random_extremes.odd_window, batch=random_extremes.mesh),
    "packed depth and stencil": Family(
        random_packed.packed_state, random_packed.packed_targets, random_packed.read_packed
    ),
    "pixel rectangles": Family(random_pixels.transferred, wild=False),
    "secondary colours": Family(random_attributes.summed, random_attributes.textured, batch=random_attributes.colored),
    "small pairs": Family(random_attributes.followed, batch=random_attributes.small_pairs),
}


def random_program(family: str, seed: int) -> tuple[list[Call], tuple[int, int]]:
    """Return the program of a seed and the (width, height) of its window; the same ones each time."""
    parts = FAMILIES[family]
    writer = Writer(np.random.default_rng([list(FAMILIES).index(family), seed]))
    writer.call("glClearColor", *writer.color())
    writer.call("glClearDepth", writer.pick([1.0, 1.0, 1.0, writer.number(0, 1)]))
    writer.call("glClearStencil", writer.integer(0, 255))
    writer.call("glClear", "GL_COLOR_BUFFER_BIT")
    writer.clear()
    parts.prepare(writer)
    for _ in range(writer.integer(1, 5)):
        parts.state(writer)
        parts.batch(writer, parts.wild)
        if writer.chance(0.2):
            writer.read()
    parts.finish(writer)
    return writer.calls, writer.size
