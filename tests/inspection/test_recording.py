"""Recordings as JSON and arrays."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from inspection.recorded_frames import random_frame
from softshadow.errors import OpenMesh, SoftShadowError
from softshadow.inspection import Replay
from softshadow.inspection.recording import Packer, Unpacker
from softshadow.scene import Scene, scene_names

pytestmark = pytest.mark.interpreted


def there_and_back(value):
    packer = Packer()
    packed = json.loads(json.dumps([packer.pack(value), packer.objects]))
    return Unpacker(packed[1], [array.copy() for array in packer.arrays]).unpack(packed[0])


@settings(max_examples=10)
@given(st.integers(0, 2**32 - 1))
def test_an_unpacked_recording_plays_to_the_same_bits(seed):
    frame = random_frame(seed).frame
    again = there_and_back(frame)
    assert again.steps == frame.steps
    for one, other in zip(Replay(frame).after_step(4), Replay(again).after_step(4), strict=True):
        assert one.tobytes() == other.tobytes()


def test_states_come_back_equal():
    frame = random_frame(1).frame
    again = there_and_back(frame)
    assert [command.state for command in again.commands] == [command.state for command in frame.commands]


@pytest.mark.parametrize("name", scene_names())
def test_scenes_come_back_with_every_number(name):
    scene = Scene.named(name)
    again = there_and_back(scene)
    assert [light.position.tolist() for light in again.lights] == [light.position.tolist() for light in scene.lights]
    for one, other in zip(scene.objects, again.objects, strict=True):
        assert one.mesh.positions.tobytes() == other.mesh.positions.tobytes()
        assert one.object_to_world.tobytes() == other.object_to_world.tobytes()
        assert (one.name, one.casts, one.receives) == (other.name, other.casts, other.receives)
    assert (again.name, again.camera.fov_y, again.title) == (scene.name, scene.camera.fov_y, scene.title)


def test_what_is_shared_is_packed_once():
    packer, array = Packer(), np.arange(3)
    packer.pack([array, (array, array)])
    assert len(packer.arrays) == 1


def test_warnings_come_back_as_what_they_were():
    again = there_and_back(OpenMesh("a tube: 2 boundary loops"))
    assert (type(again), str(again)) == (OpenMesh, "a tube: 2 boundary loops")


def test_what_is_no_part_of_a_recording_is_neither_packed_nor_made():
    with pytest.raises(TypeError, match="cannot be saved"):
        Packer().pack(object())
    with pytest.raises(SoftShadowError, match="a recording has no 'Popen'"):
        Unpacker([["Popen", {"args": "ls"}]], [])
