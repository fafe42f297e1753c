"""Buffers as files: what is read again from npz and EXR has every bit, PNG those of colours and stencil values."""

import builtins
import sys

import imageio.v3 as imageio
import numpy as np
import pytest
from PIL import Image

import softshadow as ss
from softshadow.inspection.buffer_files import exr_channels

SIZE = (48, 36)


@pytest.fixture(scope="module")
def runs():
    return {
        "volume": ss.run("volume-zfail", "boxes", SIZE),
        "map": ss.run("map", "boxes", SIZE, map_size=64),
        "silhouette": ss.run("map-silhouette", "boxes", SIZE, map_size=64),
        "variance": ss.run("map-variance", "boxes", SIZE, map_size=64),
    }


def read_exr(path):
    """Return the channels of an EXR file."""
    import OpenEXR

    with OpenEXR.File(str(path), separate_channels=True) as file:
        return {name: channel.pixels.copy() for name, channel in file.channels().items()}


def everything(runs):
    for name, run in runs.items():
        yield from ((name, buffer, run) for buffer in ("color", "depth", "stencil", *run.maps))


def values_of(run, buffer):
    return getattr(run.steps[-1].buffers, buffer) if buffer in ("color", "depth", "stencil") else run.maps[buffer]


def test_npz_has_every_buffer_exactly(runs, tmp_path):
    for name, buffer, run in everything(runs):
        path = run.export(buffer, tmp_path / f"{name}.npz")
        with np.load(path, allow_pickle=False) as stored:
            assert stored[buffer].dtype == values_of(run, buffer).dtype
            assert np.array_equal(stored[buffer], values_of(run, buffer), equal_nan=stored[buffer].dtype.kind == "f")


def test_exr_has_every_buffer_exactly(runs, tmp_path):
    for name, buffer, run in everything(runs):
        values = values_of(run, buffer)
        channels = read_exr(run.export(buffer, tmp_path / f"{name}.exr"))
        order = {1: channels.keys(), 2: ("channel 0", "channel 1"), 3: "RGB", 4: "RGBA"}[len(channels)]
        stored = np.stack([channels[channel] for channel in order], axis=-1)
        stored = stored[..., 0] if values.ndim == 2 else stored
        if values.dtype == np.uint8 and values.ndim == 3:
            stored = np.rint(255 * stored)
        else:
            assert stored.dtype == (np.float32 if values.dtype.kind == "f" else np.uint32)
        assert np.array_equal(stored, values), (name, buffer)


def test_depth_and_stencil_have_channels_of_their_own(runs, tmp_path):
    run = runs["volume"]
    assert read_exr(run.export("depth", tmp_path / "depth.exr")).keys() == {"Z"}
    assert read_exr(run.export("stencil", tmp_path / "stencil.exr")).keys() == {"stencil"}


def test_png_has_colours_and_stencil_values(runs, tmp_path):
    run = runs["volume"]
    assert np.array_equal(imageio.imread(run.export("color", tmp_path / "color.png")), run.image)
    with Image.open(run.export("stencil", tmp_path / "stencil.png")) as picture:
        assert np.array_equal(np.asarray(picture), run.stencil)
    for name, buffer, other in everything(runs):
        height, width = values_of(other, buffer).shape[:2]
        with Image.open(other.export(buffer, tmp_path / f"{name}.png")) as picture:
            assert picture.size == (width, height)


def test_a_step_can_be_chosen_by_number_or_title(runs, tmp_path):
    run = runs["volume"]
    for step in (1, "count back faces"):
        with np.load(run.export("stencil", tmp_path / "s.npz", step)) as stored:
            assert np.array_equal(stored["stencil"], run["count back faces"].stencil)
    with pytest.raises(ValueError, match="buffer 'visibility': step 1 has no such map; expected step 3"):
        run.export("visibility", tmp_path / "v.npz", 1)


def test_mistakes_are_told(runs, tmp_path):
    run = runs["volume"]
    with pytest.raises(ValueError, match="did you mean 'depth'"):
        run.export("dept", tmp_path / "a.npz")
    with pytest.raises(ValueError, match=r"expected a name that ends in .npz, .png or .exr"):
        run.export("depth", tmp_path / "a.tiff")
    (tmp_path / "foreign.exr").write_bytes(b"v/1")
    with pytest.raises(ss.SoftShadowError, match="was not written by softshadow"):
        run.export("depth", tmp_path / "foreign.exr")
    run.export("depth", tmp_path / "own.exr")
    run.export("stencil", tmp_path / "own.exr")
    with pytest.raises(ValueError, match="npz holds all"):
        exr_channels("below zero", np.array([[-1]]))


def test_exr_without_its_package_names_the_extra(runs, tmp_path, monkeypatch):
    real = builtins.__import__

    def without(name, *more, **named):
        if name == "OpenEXR":
            raise ImportError(name)
        return real(name, *more, **named)

    monkeypatch.delitem(sys.modules, "OpenEXR", raising=False)
    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(ss.SoftShadowError, match=r"pip install 'softshadow\[exr\]'"):
        runs["volume"].export("depth", tmp_path / "depth.exr")
    assert not (tmp_path / "depth.exr").exists()
