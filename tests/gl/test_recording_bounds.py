"""A bounded recording forgets its earliest commands; what it keeps gives every buffer again."""

import json
import warnings

import numpy as np
import pytest

from mesa.gl_calls import as_program
from mesa.random_programs import FAMILIES, random_program
from softshadow import HistoryCut, gl
from softshadow.context import Frame
from softshadow.context.recording import COMMAND_BYTES, Contents, copy_storage
from softshadow.framebuffer import Storage
from softshadow.image import Image
from softshadow.inspection import Replay, pixel_history
from softshadow.inspection.recording import Packer, Unpacker
from softshadow.pipeline.commands import Draw

SIZE = (16, 12)


def images_of(storage: Storage) -> dict[tuple, Image]:
    images = {("renderbuffer", name): image for name, image in storage.renderbuffers.items()}
    for name, texture in storage.textures.items():
        images |= {("texture", name, *place): image for place, image in texture.images.items()}
    for name, target in storage.framebuffers.items():
        images |= {("target", name, point): each.image for point, each in target.attachments.items()}
    return images


def assert_same_storage(one: Storage, other: Storage) -> None:
    ours, theirs = images_of(one), images_of(other)
    assert ours.keys() == theirs.keys()
    for name, image in ours.items():
        assert image.same_as(theirs[name]), name
        assert image.layout == theirs[name].layout, name
    shared = [[a is b for a in images.values() for b in images.values()] for images in (ours, theirs)]
    assert shared[0] == shared[1]
    assert (one.queries, one.active_query) == (other.queries, other.active_query)
    for name, target in one.framebuffers.items():
        ours, theirs = target.accumulation, other.framebuffers[name].accumulation
        assert (ours is None and theirs is None) or np.array_equal(ours, theirs)
        for key in ("flipped", "draw_buffers", "read_buffer"):
            assert getattr(target, key) == getattr(other.framebuffers[name], key)
    for name, texture in one.textures.items():
        assert texture.sampler == other.textures[name].sampler
        assert texture.target == other.textures[name].target


def quietly(frame: Frame) -> Storage:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", HistoryCut)
        return Replay(frame).storage_after(len(frame.commands))


@pytest.mark.parametrize("family", FAMILIES)
def test_random_programs_are_replayed_from_any_cut(family):
    """Of every part of GL: the recording is cut after every few commands, and replayed from there."""
    for seed in (0, 1):
        calls, size = random_program(family, seed)
        with gl.create_context(*size, history_mb=(3 + 8 * seed) * COMMAND_BYTES / (1 << 20)) as context:
            as_program(calls)(gl)
            frame = context.frame
            assert_same_storage(context.storage, quietly(frame))


@pytest.mark.parametrize("precision", ["mesa", "exact"])
@pytest.mark.parametrize("family", FAMILIES)
def test_draws_that_are_not_counted_yet_have_at_most_their_bound(family, precision):
    for seed in (2, 3):
        calls, size = random_program(family, seed)
        with gl.create_context(*size, precision=precision, history_mb=1000) as context:
            as_program(calls)(gl)
            frame, exact = context.frame, Contents()
            for command in frame.commands:
                exact.add(command)
            assert frame._most_bytes >= exact.new_bytes
            assert frame.bytes == exact.bytes == frame._most_bytes


def test_a_thousand_frames_keep_their_last_bytes_only():
    rng = np.random.default_rng(3)
    limit = 1 << 20
    with gl.create_context(*SIZE, history_mb=1) as context:
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        most = 0
        for number in range(1000):
            corners = rng.random((300, 3)).astype(np.float32)
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
            gl.glVertexPointer(3, gl.GL_FLOAT, 0, corners)
            for _ in range(2):
                gl.glDrawArrays(gl.GL_POINTS, 0, 300)
            if number % 20 == 19:
                most = max(most, context.frame.bytes)
        frame = context.frame
        assert frame.dropped + len(frame.commands) == 3000
        owners = {}
        for command in frame.commands:
            if isinstance(command, Draw):
                array = command.vertices.position
                owners[id(array.base if array.base is not None else array)] = array.nbytes
        held = len(frame.commands) * COMMAND_BYTES + sum(owners.values())
        assert limit // 2 < held <= frame.bytes <= most < limit + 2 * 300 * 16 + 3 * COMMAND_BYTES
        arrays = context.arrays
        for cache in (arrays.sources, arrays.indices, arrays.snapshots):
            assert cache.bytes <= 256 << 20
        assert_same_storage(context.storage, quietly(frame))


def test_arrays_that_are_drawn_again_do_not_cut_the_recording():
    with gl.create_context(*SIZE, history_mb=0.25) as context:
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(3, gl.GL_FLOAT, 0, np.zeros((20_000, 3), np.float32))  # more than the bound
        for _ in range(50):
            gl.glDrawArrays(gl.GL_POINTS, 0, 20_000)
        assert context.frame.dropped == 0
        assert context.frame.bytes == 20_000 * 16 + 50 * COMMAND_BYTES


def test_the_default_keeps_all_of_an_ordinary_program():
    with gl.create_context(*SIZE) as context:
        for _ in range(10):
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        assert context.frame.start is None
        assert context.frame.history_bytes == 64 << 20


def cut_context() -> gl.Context:
    context = gl.create_context(*SIZE, history_mb=20 * COMMAND_BYTES / (1 << 20))
    gl.glEnable(gl.GL_DEPTH_TEST)
    for i in range(30):
        gl.glColor3f(i / 30, 1 - i / 30, 0)
        gl.glRectf(-1, -1, 1 - i / 40, 1)
        context.end_step(f"rectangle {i}")
    return context


def test_steps_that_remain_are_those_of_the_whole_recording():
    with gl.create_context(*SIZE, history_mb=None) as whole:
        for i in range(30):
            gl.glEnable(gl.GL_DEPTH_TEST)
            gl.glColor3f(i / 30, 1 - i / 30, 0)
            gl.glRectf(-1, -1, 1 - i / 40, 1)
            whole.end_step(f"rectangle {i}")
    with cut_context() as context:
        frame, replay = context.frame, Replay(whole.frame)
        assert 0 < frame.dropped == frame.dropped_steps < 30
        assert len(frame.steps) + frame.dropped_steps == 30
        with pytest.warns(HistoryCut, match=f"{frame.dropped} earlier commands and {frame.dropped} steps"):
            kept = Replay(frame).after_step(0)
        for buffer, expected in zip(kept, replay.after_step(frame.dropped_steps), strict=True):
            np.testing.assert_array_equal(buffer, expected)
        with pytest.warns(HistoryCut):
            rows = list(pixel_history(frame, 1, 1))
        assert [row.title for row in rows] == [title for title, _ in frame.steps]
        assert rows[0].title == f"rectangle {frame.dropped}"


def test_replay_that_began_before_a_cut_begins_again():
    with cut_context() as context:
        replay = Replay(context.frame)
        with pytest.warns(HistoryCut):
            replay.storage_after(2)
        for i in range(25):
            gl.glColor3f(0, 0, i / 30)
            gl.glRectf(-1, -1, 1, 1 - i / 40)
            gl.glFlush()
        with pytest.warns(HistoryCut):
            played = replay.storage_after(len(context.frame.commands))
        assert_same_storage(context.storage, played)


def test_cut_recording_is_saved_and_loaded_with_its_start():
    with cut_context() as context:
        packer = Packer()
        packed = json.loads(json.dumps([packer.pack(context.frame), packer.objects]))
        frame = Unpacker(packed[1], packer.arrays).unpack(packed[0])
        assert frame.dropped == context.frame.dropped
        assert_same_storage(quietly(frame), context.storage)


def test_copies_share_images_as_the_originals_do():
    with gl.create_context(*SIZE) as context:
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        texture = gl.glGenTextures(1)
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
        kind = (gl.GL_DEPTH_STENCIL, gl.GL_UNSIGNED_INT_24_8)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH24_STENCIL8, 8, 8, 0, *kind, None)
        for point in (gl.GL_STENCIL_ATTACHMENT, gl.GL_DEPTH_ATTACHMENT):  # the stencil image first
            gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, point, gl.GL_TEXTURE_2D, texture, 0)
        copy = copy_storage(context.storage)
        assert_same_storage(context.storage, copy)
        target = copy.framebuffers[1]
        assert target.depth.stencil is target.stencil
        before = {name: image.view.copy() for name, image in images_of(copy).items()}
        gl.glDrawBuffer(gl.GL_NONE)
        gl.glClearDepth(0.25)
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
        assert all(np.array_equal(image.view, before[name]) for name, image in images_of(copy).items())


def test_shared_arrays_count_once():
    with gl.create_context(*SIZE, history_mb=None) as context:
        gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
        gl.glVertexPointer(4, gl.GL_FLOAT, 0, np.zeros((100, 4), np.float32))
        indices = np.arange(50, dtype=np.uint32)
        for start in range(3):
            gl.glDrawArrays(gl.GL_POINTS, start, 50)
            gl.glDrawElements(gl.GL_POINTS, 50, gl.GL_UNSIGNED_INT, indices)
        first = Contents()
        for command in context.frame.commands:
            first.add(command)
        assert first.bytes == first.new_bytes == 6 * COMMAND_BYTES + 100 * 16 + 50 * 4
        second = Contents(first)
        second.add(context.frame.commands[0])
        assert second.new_bytes == COMMAND_BYTES
        assert second.bytes == COMMAND_BYTES + 100 * 16


@pytest.mark.parametrize("history_mb", [0, -1, float("nan")])
def test_a_bound_without_bytes_is_refused(history_mb):
    with pytest.raises(ValueError, match="history_mb"):
        gl.create_context(*SIZE, history_mb=history_mb)
