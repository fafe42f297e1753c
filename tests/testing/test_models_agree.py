"""Shadows of real and of degenerate models are right off the band, and defects of a model cause warnings."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import softshadow as ss
from paths import shared_file
from softshadow.scene import shapes
from softshadow.testing import agreement, cast_truth

SIZE = (96, 72)
pytestmark = pytest.mark.filterwarnings("ignore::softshadow.Warning")

MODELS = [
    "BoxTextured.glb", "Duck.glb", "cow.obj", "fandisk.obj", "monkey.glb", "multibody.stl", "soup.stl", "sphere.ply",
    "spot.obj", "suzanne.obj", "teapot.obj", "wallhole.obj",
]  # fmt: skip


def off_the_band(scene: ss.Scene) -> dict[str, int]:
    """Return the number of wrong pixels off the band for each exact technique."""
    truth = cast_truth(scene, SIZE)
    assert (truth.counts[0] > 0).any()
    techniques = ("planar", "volume-zfail", "volume-zpass-plus")
    return {name: agreement(ss.run(name, scene, size=SIZE), truth)[0].off_band for name in techniques}


@pytest.mark.parametrize("name", MODELS)
def test_shadows_of_a_real_model_are_right_off_the_band(name: str) -> None:
    assert set(off_the_band(ss.Scene.from_mesh(shared_file(f"meshes/{name}"))).values()) == {0}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["stanford-bunny.obj", "rocker-arm.obj"])
def test_shadows_of_a_large_model_are_right_off_the_band(name: str) -> None:
    assert set(off_the_band(ss.Scene.from_mesh(shared_file(f"meshes/{name}"))).values()) == {0}


def written(path: Path, positions: np.ndarray, triangles: np.ndarray) -> Path:
    """Write a mesh to an OBJ file, and return its path."""
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in np.asarray(positions)]
    lines += [f"f {a} {b} {c}" for a, b, c in np.asarray(triangles) + 1]
    path.write_text("\n".join(lines))
    return path


RING = shapes.torus(0.7, 0.25, 24, 12)
POINTS = RING.positions[RING.topology.representatives].astype(np.float64)
FACES = RING.topology.triangles


def some_turned() -> np.ndarray:
    faces = FACES.copy()
    faces[::7] = faces[::7, ::-1]
    return faces


AWKWARD: dict[str, tuple[Callable[[], tuple[np.ndarray, np.ndarray]], set[type]]] = {
    "every face has vertices of its own": (
        lambda: (POINTS[FACES].reshape(-1, 3), np.arange(FACES.size).reshape(-1, 3)),
        set(),
    ),
    "every face twice": (lambda: (POINTS, np.concatenate([FACES, FACES])), {ss.NonManifoldMesh}),
    "every face from both sides": (lambda: (POINTS, np.concatenate([FACES, FACES[:, ::-1]])), {ss.NonManifoldMesh}),
    "some faces the wrong way round": (lambda: (POINTS, some_turned()), {ss.MisorientedMesh}),
    "all faces the wrong way round": (lambda: (POINTS, FACES[:, ::-1]), {ss.InsideOutMesh}),
    "faces without area": (
        lambda: (POINTS, np.concatenate([FACES, [[0, 0, 1], [3, 3, 3]]])),
        {ss.DegenerateFaces},
    ),
    "huge": (lambda: (POINTS * 1e17, FACES), set()),
    "tiny": (lambda: (POINTS * 1e-17, FACES), set()),
    "a hole": (lambda: (POINTS, FACES[5:]), {ss.OpenMesh}),
}


@pytest.mark.parametrize("what", AWKWARD)
def test_an_awkward_model_is_named_and_right_off_the_band(what: str, tmp_path: Path) -> None:
    make, named = AWKWARD[what]
    scene = ss.Scene.from_mesh(written(tmp_path / "ring.obj", *make()))
    assert {type(warning) for warning in scene.warnings()} == named
    assert set(off_the_band(scene).values()) == {0}


def test_a_closed_body_beside_an_open_one_is_right_for_parity_too(tmp_path: Path) -> None:
    sheet = np.array([[2.0, 0, 0], [3, 0, 0], [2, 1, 0]])
    triangles = np.concatenate([FACES, [[len(POINTS) + corner for corner in range(3)]]])
    both = written(tmp_path / "pair.obj", np.concatenate([POINTS, sheet]), triangles)
    scene = ss.Scene.from_mesh(both)
    truth = cast_truth(scene, SIZE)
    (result,) = agreement(ss.run("volume-parity", scene, size=SIZE), truth)
    # the ring casts once, not with both of its layers; only where it shades itself the count is even
    assert (result.wrong == ((truth.counts[0] > 0) & (truth.counts[0] % 2 == 0)))[~result.band].all()
    alone = cast_truth(ss.Scene.from_mesh(written(tmp_path / "alone.obj", POINTS, FACES)), SIZE)
    assert truth.counts[0].max() == alone.counts[0].max()
