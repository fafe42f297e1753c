"""Carry out recorded commands: which function executes which command."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from softshadow import pipeline
from softshadow.framebuffer import Storage
from softshadow.pipeline import commands
from softshadow.pipeline.buffers import accumulation, blit, clear, copy, mipmaps, objects
from softshadow.pipeline.commands import BeginQuery, BlitFramebuffer, Command, Draw, DrawDepths
from softshadow.pipeline.depth_rectangles import draw_depths
from softshadow.pipeline.records import FragmentCounts


def execute(command: Command, storage: Storage) -> None:
    """Carry out a command: change the storage as the GL call does that it stands for."""
    EXECUTORS[type(command)](command, storage)


def _draw(command: Draw, storage: Storage) -> None:
    """Draw; while an occlusion query is active, its count grows by the fragments that pass."""
    if not storage.active_query:
        pipeline.draw(command, storage)
        return
    counts = FragmentCounts.zero(only_passed=True)
    pipeline.draw(command, storage, counts)
    storage.note_passed(storage.active_query, counts.passed)


def _draw_depths(command: DrawDepths, storage: Storage) -> None:
    """Draw a rectangle of depths; an active occlusion query counts its fragments."""
    if not storage.active_query:
        draw_depths(command, storage)
        return
    counts = FragmentCounts.zero()
    draw_depths(command, storage, counts)
    storage.note_passed(storage.active_query, counts.passed)


def _begin_query(command: BeginQuery, storage: Storage) -> None:
    storage.active_query = command.query
    if command.query:
        storage.queries[command.query] = 0


def _blit(command: BlitFramebuffer, storage: Storage) -> None:
    blit.blit(command, storage, pipeline.draw)


EXECUTORS: dict[type, Callable[[Any, Storage], None]] = {
    commands.Draw: _draw,
    commands.DrawDepths: _draw_depths,
    commands.Clear: clear.clear,
    commands.Accumulate: accumulation.accumulate,
    commands.BeginQuery: _begin_query,
    commands.DefineImage: objects.define_image,
    commands.UpdateImage: objects.update_image,
    commands.CopyToTexture: copy.copy_to_texture,
    commands.GenerateMipmaps: mipmaps.generate_mipmaps,
    commands.BlitFramebuffer: _blit,
    commands.CreateTexture: objects.create_texture,
    commands.SetSampler: objects.set_sampler,
    commands.DeleteTextures: objects.delete_textures,
    commands.CreateFramebuffer: objects.create_framebuffer,
    commands.DeleteFramebuffers: objects.delete_framebuffers,
    commands.DefineRenderbuffer: objects.define_renderbuffer,
    commands.DeleteRenderbuffers: objects.delete_renderbuffers,
    commands.AttachTexture: objects.attach_texture,
    commands.AttachRenderbuffer: objects.attach_renderbuffer,
    commands.SelectBuffers: objects.select_buffers,
}
