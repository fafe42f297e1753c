"""Programs for PyOpenGL run unchanged, without a screen."""

import sys
from pathlib import Path

import numpy as np
import pytest

import softshadow as ss
from softshadow.errors import CallsLeftOut, SoftShadowError
from softshadow.windows import run_script
from windows.window_programs import GLFW, GLUT, PYGAME, SINGLE_BUFFERED

RED, GREEN, BLUE = [255, 0, 0], [0, 255, 0], [0, 0, 255]


def written(folder: Path, text: str) -> Path:
    path = folder / "program.py"
    path.write_text(text)
    return path


def middle(run: ss.Run) -> list[int]:
    color: list[int] = run.image[6, 8].tolist()
    return color


@pytest.mark.parametrize("text", [GLUT, PYGAME, GLFW], ids=["glut", "pygame", "glfw"])
def test_a_program_runs_unchanged_and_hears_keys(tmp_path: Path, text: str) -> None:
    path = written(tmp_path, text)
    assert middle(run_script(path)) == RED
    run = run_script(path, keys="x,g")
    assert middle(run) == GREEN
    assert run.options == {"program": "program.py", "frame": 2}
    assert run.size == (16, 12)


def test_glut_hears_special_keys_and_clicks(tmp_path: Path) -> None:
    path = written(tmp_path, GLUT)
    assert middle(run_script(path, keys="Up")) == BLUE
    assert middle(run_script(path, clicks=[(16, 6)])) == [255, 128, 0]


def test_a_window_can_have_another_size(tmp_path: Path) -> None:
    assert run_script(written(tmp_path, GLUT), size=(20, 10)).size == (20, 10)


def test_timers_follow_the_clock_and_a_single_buffer_ends_frames(tmp_path: Path) -> None:
    path = written(tmp_path, SINGLE_BUFFERED)
    assert [run_script(path, frames=n).image[0, 0, 0] for n in (1, 2, 5)] == [0, 64, 255]


def test_a_history_names_the_line_of_the_program(tmp_path: Path) -> None:
    run = run_script(written(tmp_path, PYGAME), frames=3)
    line = PYGAME.splitlines().index("    glRectf(-0.5, -0.5, 0.5, 0.5)") + 1
    assert run.pixel(8, 6)[-1].object == f"line {line}"
    assert run.steps.titles == ["clear colour", f"line {line}: GL_QUADS"]


def test_lines_of_other_files_are_named_with_them(tmp_path: Path) -> None:
    (tmp_path / "shapes.py").write_text("from OpenGL.GL import glRectf\ndef square():\n    glRectf(-1, -1, 1, 1)\n")
    text = "import glfw, shapes\nw = glfw.create_window(8, 8, '')\nshapes.square()\nglfw.swap_buffers(w)\n"
    run = run_script(written(tmp_path, text))
    sys.modules.pop("shapes")
    assert run.pixel(4, 4)[-1].object == "shapes.py line 3"


@pytest.mark.filterwarnings("ignore::softshadow.Warning")
def test_a_missing_call_is_counted_and_does_not_stop_the_program(tmp_path: Path) -> None:
    text = GLFW.replace("    glColor3f", "    glNoSuchCall(1)\n    glColor3f")
    run = run_script(written(tmp_path, text), frames=2)
    assert middle(run) == RED
    assert [str(message) for message in run.warnings] == ["glNoSuchCall (2 calls), missing call"]


def test_a_program_that_ends_early_is_told_and_its_last_frame_is_shown(tmp_path: Path) -> None:
    text = GLUT.replace("    glutSwapBuffers()", "    glutSwapBuffers()\n    sys.exit()")
    with pytest.warns(CallsLeftOut, match="drew 1 of 4 frames"):
        run = run_script(written(tmp_path, text), frames=4)
    height, width = run.image.shape[:2]
    assert [row.verdict for row in run.pixel(width // 2, height // 2)] == ["clear", "passed"]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (GLFW.replace("glClear(GL_", "glClear(7 + GL_"), r"program.py line 16: GL_INVALID_VALUE: glClear"),
        ("x = 1\ny = x / 0\n", "program.py line 2: ZeroDivisionError: division by zero"),
        ("def f(:\n", "program.py line 1: SyntaxError: "),
        ("print()\n", "program.py: the program opened no window"),
    ],
)
def test_an_error_of_the_program_is_told_with_its_line(tmp_path: Path, text: str, expected: str) -> None:
    with pytest.raises(SoftShadowError, match=expected):
        run_script(written(tmp_path, text))


def test_wrong_arguments_are_told(tmp_path: Path) -> None:
    path = written(tmp_path, GLUT)
    with pytest.raises(SoftShadowError, match="no such file"):
        run_script(tmp_path / "none.py")
    with pytest.raises(ValueError, match="'Upp' is no key"):
        run_script(path, keys="a,Upp")
    with pytest.raises(ValueError, match="frames=0: expected 1 or more"):
        run_script(path, frames=0)


def test_modules_and_arguments_are_as_before_afterwards(tmp_path: Path) -> None:
    before, argv, path = dict(sys.modules), list(sys.argv), list(sys.path)
    run_script(written(tmp_path, PYGAME + "\nimport sys\n"))
    assert (sys.argv, sys.path) == (argv, path)
    replaced = {name for name in sys.modules if name.split(".")[0] in ("OpenGL", "pygame", "glfw")}
    assert replaced == {name for name in before if name.split(".")[0] in ("OpenGL", "pygame", "glfw")}


@pytest.mark.parametrize("shape", ["Sphere", "Cube", "Cone", "Torus", "Teapot", "Icosahedron", "Dodecahedron"])
def test_shapes_are_seen_from_outside(tmp_path: Path, shape: str) -> None:
    """With GL_CULL_FACE, a solid shape has the same depths: no back face is nearer than a front face.

    The front faces of the teapot are clockwise, as GLUT's manual says.
    """
    sizes = {"Sphere": "0.8, 12, 8", "Cube": "1", "Cone": "0.7, 0.9, 12, 4", "Torus": "0.2, 0.6, 12, 16",
             "Teapot": "0.5", "Icosahedron": "", "Dodecahedron": ""}  # fmt: skip
    text = f"""
import sys
from OpenGL.GL import *
from OpenGL.GLUT import *
def display():
    glEnable(GL_DEPTH_TEST)
    if len(sys.argv) > 1: glEnable(GL_CULL_FACE)
    glFrontFace({"GL_CW" if shape == "Teapot" else "GL_CCW"})
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT)
    glOrtho(-1, 1, -1, 1, -1, 1)
    glScalef(0.5, 0.5, 0.5)
    glRotatef(30, 1, 1, 0)
    glutSolid{shape}({sizes[shape]})
    glutSwapBuffers()
glutInit(sys.argv)
glutInitWindowSize(64, 48)
glutCreateWindow("shape")
glutDisplayFunc(display)
glutMainLoop()
"""
    path = written(tmp_path, text)
    both, front = run_script(path), run_script(path, ["cull"])
    differing = int(np.count_nonzero(both.depth != front.depth))
    assert differing <= (1 if shape == "Teapot" else 0)  # whose inside shows in the spout
    assert np.count_nonzero(both.depth < 1) > 100
