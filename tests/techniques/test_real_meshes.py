"""Shadow volumes of real models: thousands of faces, boundary edges, several bodies."""

import numpy as np
import pytest

from paths import shared_file
from softshadow.errors import NearClipZPass
from softshadow.scene import Scene
from techniques.drawn_frames import Drawn, cast_rays, draw

SIZE = (96, 72)
MODELS = ["stanford-bunny.obj", "teapot.obj", "rocker-arm.obj", "Duck.glb", "multibody.stl", "wallhole.obj"]


@pytest.fixture(scope="module", params=MODELS)
def drawn(request: pytest.FixtureRequest) -> tuple[Scene, Drawn]:
    scene = Scene.from_mesh(shared_file(f"meshes/{request.param}"))
    return scene, draw("volume-zfail", scene, SIZE)


def test_count_of_a_model_is_that_of_rays(drawn: tuple[Scene, Drawn]) -> None:
    scene, zfail = drawn
    truth = cast_rays(scene, SIZE)
    sure = truth.sure()
    assert sure.mean() > 0.2
    assert (truth.counts[0][sure] > 0).any()
    differing = (zfail.stencil["count front faces"] != truth.counts[0]) & sure
    assert not differing.any(), np.argwhere(differing)[:5]


def test_zpass_counts_what_zfail_counts_on_a_model(drawn: tuple[Scene, Drawn]) -> None:
    scene, zfail = drawn
    zpass = draw("volume-zpass", scene, SIZE)
    assert NearClipZPass not in zpass.warnings
    np.testing.assert_array_equal(zpass.stencil["count back faces"], zfail.stencil["count front faces"])
