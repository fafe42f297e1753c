"""The program of a draw and the textures that it samples."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from softshadow import programs
from softshadow import tokens as gl
from softshadow.framebuffer import Storage
from softshadow.pipeline.commands import Draw
from softshadow.programs import Program
from softshadow.state import State
from softshadow.texture import Texture, stored_name


def program_of(command: Draw, storage: Storage) -> tuple[Program, Mapping[str, Any]]:
    """Return the program of a draw and its uniforms, samplers resolved to textures."""
    bound = bound_textures(command, storage)
    if not command.program_name:
        from softshadow.programs import fixed_function

        return fixed_function.program(command.state, bound), command.uniforms
    program = programs.get(command.program_name)
    places = {
        name: (value, gl.GL_TEXTURE_CUBE_MAP if name in program.cube_samplers else gl.GL_TEXTURE_2D)
        for name, value in command.uniforms.items()
        if name in program.samplers
    }
    # a unit without a texture is sampled as one without images
    textures = {name: bound.get(place) or Texture(0, place[1]) for name, place in places.items()}
    blocks = any(programs.needs_blocks(texture) for texture in textures.values())
    program = replace(program, blocks=True) if blocks else program
    return program, {**command.uniforms, **textures}


def bound_textures(command: Draw, storage: Storage) -> dict[tuple[int, int], Texture]:
    """Return the textures that a draw may sample by (unit, target), with the LOD bias and seamless filter of units."""
    bound, is_fixed = {}, not command.program_name
    for index, unit in enumerate(command.state.units):
        for target in unit.targets if is_fixed else unit.sampled_targets:
            texture = storage.textures.get(stored_name(target, unit.bound(target)))
            if texture is not None:
                bound[index, target] = texture.in_unit(unit.lod_bias, command.state.cube_maps.seamless)
    return bound


def textures_of(state: State) -> set[int]:
    """Return the names, as the storage has them, of the textures that a draw without a program may read."""
    return {stored_name(target, unit.bound(target)) for unit in state.units for target in unit.targets}
