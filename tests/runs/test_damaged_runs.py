"""Saved runs that are not as they were written: each is refused in one sentence, or loaded and usable."""

import json
import os
import zipfile
from pathlib import Path

import numpy as np
import pytest

import softshadow as ss
from runs.damaged_runs import Damager
from softshadow.inspection.files import DESCRIPTION
from softshadow.runs.members import read_members, write_members

QUICK, LONG = 60, 3000
LONGEST_MESSAGE = 600  # with the path


@pytest.fixture(scope="module")
def damager(tmp_path_factory: pytest.TempPathFactory) -> Damager:
    run = ss.run("map", "boxes", size=(24, 18))
    return Damager(run.save(tmp_path_factory.mktemp("runs") / "good.npz"))


def use(run: ss.Run) -> None:
    """Ask a run what needs every part of it."""
    for step in run:
        assert step.image.shape[:2] == run.size[::-1]
        assert str(step.state)
    assert repr(run)
    run.pixel(12, 9)
    run.explain(12, 9)


def refused_or_usable(damager: Damager, seeds: range, folder: Path) -> int:
    """Load a damaged run of each seed, and use those that are loaded; return how many were refused."""
    refused = 0
    for seed in seeds:
        path, way = damager.damaged(seed, folder)
        try:
            run = ss.load_run(path)
        except ss.SoftShadowError as error:
            refused += 1
            message = str(error)
            assert message.startswith(f"{path}: not a run that this package saved"), (seed, way, message)
            assert len(message) < LONGEST_MESSAGE, (seed, way, message)
            assert "\n" not in message, (seed, way, message)
        else:
            use(run)
    return refused


def test_damaged_runs_are_refused_in_one_sentence(damager, tmp_path):
    assert refused_or_usable(damager, range(QUICK), tmp_path) > QUICK / 2


@pytest.mark.slow
def test_thousands_of_damaged_runs_are_refused_in_one_sentence(damager, tmp_path):
    assert refused_or_usable(damager, range(QUICK, LONG), tmp_path) > LONG / 2


def test_a_state_without_all_its_clip_planes_is_refused(damager, tmp_path):
    plane = '{"tuple": [0.0, 0.0, 0.0, 0.0]}, '
    text = json.dumps(damager.description)
    damager.reseal(tmp_path / "a.npz", text.replace(f'"equations": {{"tuple": [{plane}', '"equations": {"tuple": [', 1))
    with pytest.raises(ss.SoftShadowError, match=r"ClipPlanes\.equations: expected 6 values"):
        ss.load_run(tmp_path / "a.npz")


def test_any_changed_byte_of_the_contents_is_noticed(damager, tmp_path):
    image = damager.arrays["image"].copy()
    image[3, 4] ^= 1
    with zipfile.ZipFile(tmp_path / "other.npz", "w") as archive, zipfile.ZipFile(tmp_path / "whole.npz", "w") as whole:
        for name, content in damager.members.items():
            same = name != "image.npy"
            archive.writestr(name, content if same else content[: -image.nbytes] + image.tobytes())
            whole.writestr(name, content)
        archive.comment = whole.comment = damager.comment
    assert ss.load_run(tmp_path / "whole.npz").size == (24, 18)
    with pytest.raises(ss.SoftShadowError, match="the contents do not have the hash that was stored with them"):
        ss.load_run(tmp_path / "other.npz")


def test_an_object_array_is_never_unpickled(tmp_path):
    class Trap:
        def __reduce__(self):
            return pytest.fail, ("unpickled",)

    write_members(tmp_path / "a.npz", {DESCRIPTION: np.array("{}")})
    np.savez(tmp_path / "b.npz", **{DESCRIPTION: np.array([Trap()], object)})
    with zipfile.ZipFile(tmp_path / "b.npz", "a") as archive, zipfile.ZipFile(tmp_path / "a.npz") as other:
        archive.comment = other.comment
    with pytest.raises(ss.SoftShadowError, match="not an array of numbers or text"):
        ss.load_run(tmp_path / "b.npz")


@pytest.mark.parametrize(
    "array",
    [
        np.zeros((3, 0)), np.float32(2), np.array("text"), np.asfortranarray(np.arange(6).reshape(2, 3)),
        np.array([True, False]), np.arange(24, dtype=np.uint16).reshape(2, 3, 4)[:, ::2], np.array([], "<U1"),
    ],
    ids=lambda array: f"{array.dtype} {array.shape}",
)  # fmt: skip
def test_arrays_come_back_as_they_were(array, tmp_path):
    write_members(tmp_path / "a.npz", {"it": array})
    (again,) = read_members(tmp_path / "a.npz").values()
    assert (again.dtype, again.shape, again.tobytes()) == (np.asarray(array).dtype, np.shape(array), array.tobytes())
    with np.load(tmp_path / "a.npz") as stored:
        assert stored["it"].tobytes() == array.tobytes()


@pytest.mark.parametrize("kind", ["folder", "fifo", "device"])
def test_what_is_no_file_is_refused(kind, tmp_path):
    path = tmp_path / "run.npz"
    if kind == "folder":
        path.mkdir()
    elif kind == "fifo":
        os.mkfifo(path)
    else:
        path.symlink_to("/dev/zero")
    with pytest.raises(ss.SoftShadowError, match="not a regular file"):
        ss.load_run(path)
