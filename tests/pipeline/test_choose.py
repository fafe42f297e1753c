"""A draw leaves the same buffers whichever way it goes, and tells why it went that way."""

import subprocess
import sys

import numpy as np
import pytest

import softshadow as ss
from softshadow import gl, techniques
from softshadow.pipeline import choose, explain_paths, use_short_cuts

SIZE = (64, 48)


def arrays(run: ss.Run) -> list[np.ndarray]:
    """Return the buffers and maps after every step."""
    return [array for step in run.steps for array in (*step.buffers, *step.maps.values())]


def same_run(a: ss.Run, b: ss.Run) -> bool:
    """Return whether two runs have equal buffers and maps after every step."""
    return all(np.array_equal(one, other) for one, other in zip(arrays(a), arrays(b), strict=True))


@pytest.mark.parametrize("name", techniques.names())
def test_every_technique_draws_the_same_without_short_cuts(name):
    with use_short_cuts("always"):
        run = ss.run(name, "boxes", SIZE)
    with use_short_cuts(False):
        assert same_run(ss.run(name, "boxes", SIZE), run)


WITHOUT_THE_FOLDER = """
import sys
import numpy as np

class NoFast:
    def find_spec(self, name, path=None, target=None):
        if name.startswith("softshadow.pipeline.fast"):
            raise ModuleNotFoundError(name)

sys.meta_path.insert(0, NoFast())
import softshadow as ss

with ss.use_short_cuts(False):
    run = ss.run("volume-zfail", "boxes", (64, 48))
"""
OBJECTS = """
from softshadow import gl

with gl.create_context(64, 48) as context:
    for number in range(60):
        gl.glTranslatef(0.01, 0.005 * (number % 3), 0)
        gl.glColor3f(number / 60, 1, 0)
        gl.glBegin((gl.GL_TRIANGLES, gl.GL_LINE_LOOP)[number // 3 % 2])
        for corner in ((-0.5, -0.5), (0.25, -0.5), (-0.5, 0.25)):
            gl.glVertex2f(*corner)
        gl.glEnd()
    gl.glFinish()
    objects = context.storage.window.color.cells.copy()
"""
SAVE = """
np.savez(sys.argv[1], image=run.image, objects=objects)
"""


def test_the_textbook_works_without_the_folder_of_short_cuts(tmp_path):
    file, ours = tmp_path / "images.npz", {}
    subprocess.run([sys.executable, "-c", WITHOUT_THE_FOLDER + OBJECTS + SAVE, str(file)], check=True)
    exec(OBJECTS, ours)
    with np.load(file) as images:
        assert np.array_equal(images["image"], ss.run("volume-zfail", "boxes", SIZE).image)
        assert np.array_equal(images["objects"], ours["objects"])
        assert np.unique(images["objects"]).size > 2


@pytest.mark.parametrize("policy", ["never", 1, None])
def test_an_unknown_policy_is_refused(policy):
    with pytest.raises(ValueError, match="expected True, False or 'always'"), use_short_cuts(policy):
        pass


def draw_triangle() -> None:
    gl.glBegin(gl.GL_TRIANGLES)
    for x, y in ((-1, -1), (1, -1), (0, 1)):
        gl.glVertex2f(x, y)
    gl.glEnd()
    gl.glFinish()


def test_explain_paths_lists_the_way_of_each_draw_and_its_reasons(monkeypatch):
    monkeypatch.setattr(choose, "_are_compiled", lambda fragments: False)  # the kernels that shade spans
    with gl.create_context(*SIZE), explain_paths() as paths:
        draw_triangle()
        gl.glEnable(gl.GL_ALPHA_TEST)
        gl.glAlphaFunc(gl.GL_GREATER, 0.5)
        draw_triangle()
        gl.glDisable(gl.GL_ALPHA_TEST)
        gl.glColorMask(False, False, False, False)
        draw_triangle()
        with use_short_cuts(False):
            draw_triangle()
    assert [path.way for path in paths] == ["opaque", "in order", "depth and stencil only, in chunks", "opaque"]
    assert [path.shading for path in paths] == ["program", "program", "", ""]
    assert "the alpha test reads colours" in paths[1].reasons
    assert "no colour is written or tested" in paths[2].reasons
    assert "short cuts are off" in paths[3].reasons
    assert paths[3].fill == "textbook"


def test_every_state_is_filled_in_vectors(monkeypatch):
    monkeypatch.setattr(choose, "_are_compiled", lambda fragments: False)
    with gl.create_context(*SIZE), explain_paths() as paths:
        draw_triangle()
        gl.glEnable(gl.GL_STENCIL_TEST)
        gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_INCR)
        draw_triangle()
        gl.glColorMask(False, False, False, False)
        draw_triangle()
    assert [path.fill for path in paths] == ["vectors", "vectors", "stencil tiles"]


def test_one_picture_does_without_the_kernels_that_fill_in_vectors(monkeypatch):
    compiled = []
    monkeypatch.setattr(choose.FILL_KERNELS, "are_compiled", lambda: bool(compiled))
    monkeypatch.setattr(choose.FILL_KERNELS, "note_compiled", lambda: compiled.append(True))
    monkeypatch.setattr(choose.FILL_KERNELS, "pays_after", 20_000)
    monkeypatch.setattr(choose.FILL_KERNELS, "_done", 0)
    with explain_paths() as paths:
        ss.run("volume-zfail", "boxes", size=(20, 10))
        assert not {"vectors", "stencil tiles"} & {path.fill for path in paths}
        ss.run("volume-zfail", "boxes", size=(200, 100))
    assert "stencil tiles" in {path.fill for path in paths}


def test_draws_outside_the_block_are_not_listed():
    with explain_paths() as paths:
        pass
    with gl.create_context(*SIZE):
        draw_triangle()
    assert paths == []
