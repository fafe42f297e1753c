"""Cross-sections: the counts along a line of sight are those of the stencil buffer, and the widths those of the law."""

import warnings
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import softshadow as ss
from softshadow.report import cross_section, save_svg, svg_of
from softshadow.report.cut import cut_triangles, join_segments
from softshadow.report.section_plane import visible_share
from softshadow.scene import Scene

SIZE = (96, 72)


@pytest.mark.parametrize("name", ["torus", "boxes", "overlapping", "sunlight", "open-tube", "staircase"])
def test_the_last_count_is_the_stencil_value_of_the_pixel(name):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ss.OpenMesh)
        run = ss.run("volume-zfail", name, SIZE)
    stencil, image = run[2].stencil, run.depth < 1
    # off the edges: where the count of a pixel's own centre is that of all its neighbours
    inner = image.copy()
    for dy in (-1, 0, 1):
        for dx in (-1, 0, 1):
            inner &= np.roll(stencil, (dy, dx), (0, 1)) == stencil
    rng = np.random.default_rng(3)
    tested = 0
    for y, x in rng.permutation(np.argwhere(inner & (stencil > 0)))[:4].tolist():
        section = run.cross_section(x, y)
        assert section.crossings[-1].count == stencil[y, x], (x, y)
        tested += 1
    for y, x in rng.permutation(np.argwhere(inner & (stencil == 0)))[:4].tolist():
        section = run.cross_section(x, y)
        assert not section.crossings or section.crossings[-1].count == 0, (x, y)
    assert tested


def test_the_receiver_of_the_slab_has_the_widths_of_the_law():
    """S0.4: with a light of size s, an occluder at d_b and a receiver at d_r, the penumbra is s (d_r - d_b) / d_b."""
    scene = Scene.named("soft-slab")
    section = cross_section(scene)
    pieces = [piece for line in [section.strips("floor")] for piece in line]
    middle = np.array([piece.mean(axis=0)[0] for piece, _ in pieces])
    share = np.array([value for _, value in pieces])
    step = abs(middle[1] - middle[0])
    size = float(np.linalg.norm(section.ends[1] - section.ends[0]))
    top = section.sides[:, 0, 1].max()  # the silhouette lies on the slab's upper side
    d_b, d_r = -top, -float(section.outlines["floor"][0][0, 1])
    expected = size * (d_r - d_b) / d_b
    measured = ((share > 0) & (share < 1)).sum() / 2 * step
    assert measured == pytest.approx(expected, abs=2 * step)  # a strip more or less at each of its ends
    width = float(np.ptp(section.sides[:, 0, 0]))
    umbra = (width * d_r - size * (d_r - d_b)) / d_b
    assert (share == 0).sum() * step == pytest.approx(umbra, abs=2 * step)


@given(st.integers(0, 2**32 - 1))
def test_visible_share_is_that_of_many_rays(seed):
    random = np.random.default_rng(seed)
    ends = np.array([[-1.0, 2.0], [1.0, 2.0]]) + random.normal(0, 0.2, (2, 2))
    blockers = random.uniform((-1.5, 0.2), (1.5, 1.8), (4, 2, 2))
    share = visible_share(np.zeros(2), ends, blockers)
    rays = np.linspace(0, 1, 401)[:, None]
    targets = ends[0] + (rays + 0.5 / 401) / (1 + 1 / 401) * (ends[1] - ends[0])
    blocked = np.zeros(len(targets), bool)
    for a, b in blockers:
        cross = targets[:, 0] * (b - a)[1] - targets[:, 1] * (b - a)[0]
        t = (a[0] * (b - a)[1] - a[1] * (b - a)[0]) / cross
        u = (a[0] * targets[:, 1] - a[1] * targets[:, 0]) / cross
        blocked |= (t > 0) & (t < 1) & (u >= 0) & (u <= 1)
    # each of 4 blockers has two ends, and each end may shift the count by one ray of 401
    assert share == pytest.approx(1 - blocked.mean(), abs=9 / 401)


def test_a_point_light_is_seen_or_not():
    ends = np.array([[0.0, 2.0], [0.0, 2.0]])
    wall = np.array([[[-0.5, 1.0], [0.5, 1.0]]])
    assert visible_share(np.zeros(2), ends, wall) == 0
    assert visible_share(np.array([3.0, 0.0]), ends, wall) == 1


def test_a_cut_box_is_one_closed_outline():
    mesh = ss.Scene.named("boxes").casters[-1]
    triangles = mesh.world_positions[mesh.mesh.triangles]
    segments = cut_triangles(triangles, triangles.mean(axis=(0, 1)), np.array([0.3, 0.1, 1.0]))
    (outline,) = join_segments(segments[..., :2])
    assert np.allclose(outline[0], outline[-1], atol=1e-8)  # joined by rounding to 1e-9 of the largest number
    assert join_segments(np.zeros((0, 2, 2))) == []


@pytest.mark.parametrize(
    ("name", "pixel"), [("soft-slab", None), ("soft-torus", None), ("sunlight", None), ("torus", (300, 330))]
)
def test_the_drawing_is_svg_with_a_title_and_a_description(name, pixel, tmp_path):
    section = cross_section(name, pixel)
    root = ElementTree.fromstring(svg_of(section))
    space = "{http://www.w3.org/2000/svg}"
    assert root.find(f"{space}title").text.startswith("Cross-section of scene")
    assert "light" in root.find(f"{space}desc").text
    kinds = {element.get("class") for element in root.iter()}
    assert {"volume", "caster", "receiver"} <= kinds
    assert ("wedge" in kinds) == name.startswith("soft")
    assert ("ray" in kinds) == (pixel is not None)
    path = save_svg(section, tmp_path / "section.svg")
    assert save_svg(section, path) == path  # its own file may be overwritten
    with pytest.raises(ValueError, match=r"expected a name that ends in \.svg"):
        save_svg(section, tmp_path / "section.png")


def test_wrong_arguments_are_named():
    with pytest.raises(ValueError, match="no surface is seen there"):
        cross_section("torus", (2, 2))
    with pytest.raises(ValueError, match="expected x from 0 to 639"):
        cross_section("torus", (640, 2))
    with pytest.raises(ValueError, match="light='lamp'"):
        cross_section("torus", light="lamp")
