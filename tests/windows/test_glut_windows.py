"""What happens to GLUT programs: windows and their sizes, menus, modifiers, the pointer, and what is told."""

from pathlib import Path

import pytest

import softshadow as ss
from softshadow.errors import CallsLeftOut, SoftShadowError
from softshadow.windows import run_script

RED, GREEN, BLUE, BLACK = [255, 0, 0], [0, 255, 0], [0, 0, 255], [0, 0, 0]


def written(folder: Path, setup: str, mode: str = "GLUT_DOUBLE", display: str = "glutSwapBuffers()") -> Path:
    """Write a program that fills its window with `color`, which `setup` can change by callbacks."""
    path = folder / "program.py"
    path.write_text(f"""
import sys
from OpenGL.GL import *
from OpenGL.GLUT import *
color = [0.0, 0.0, 0.0]
frame = 0
def paint(*rgb):
    color[:] = rgb
    glutPostRedisplay()
def display():
    global frame
    frame += 1
    glClearColor(*color, 1)
    glClear(GL_COLOR_BUFFER_BIT)
    {display}
glutInit()
glutInitDisplayMode({mode})
glutInitWindowSize(16, 12)
glutCreateWindow("window")
glutDisplayFunc(display)
{setup}
glutMainLoop()
""")
    return path


def color(run: ss.Run) -> list[int]:
    values: list[int] = run.image[3, 3].tolist()
    return values


def told(run: ss.Run) -> str:
    return "; ".join(map(str, run.warnings))


MENUS = """
chosen = lambda value: paint(value == 1, value == 2, value == 3)
shades = glutCreateMenu(chosen)
glutAddMenuEntry(b"blue, dark", 7)
glutAddMenuEntry("blue", 3)
glutCreateMenu(chosen)
glutAddMenuEntry("red", 1)
glutAddMenuEntry("grass", 5)
glutAddSubMenu("more", shades)
glutChangeToMenuEntry(2, "green", 2)
glutAttachMenu(GLUT_RIGHT_BUTTON)
glutKeyboardFunc(lambda *_: paint(0, 0, 0))
"""


@pytest.mark.parametrize(
    ("keys", "expected"),
    [("Menu:red", RED), ("Menu:green", GREEN), ("Menu:more/blue", BLUE), ("Menu:blue", BLUE), ("Menu:red,x", BLACK)],
)
def test_an_entry_of_a_menu_is_chosen_by_its_label(tmp_path: Path, keys: str, expected: list[int]) -> None:
    run = run_script(written(tmp_path, MENUS), keys=keys)
    assert color(run) == expected
    assert not run.warnings


def test_an_entry_that_is_missing_is_told_with_those_that_are_there(tmp_path: Path) -> None:
    with pytest.raises(SoftShadowError, match=r"Menu:gray: .* there are: red, green, more/blue, dark, more/blue"):
        run_script(written(tmp_path, MENUS), keys="Menu:gray")
    path = tmp_path / "glfw_program.py"
    path.write_text(
        "import glfw\nw = glfw.create_window(8, 8, '')\nwhile 1: glfw.swap_buffers(w) or glfw.poll_events()\n"
    )
    with pytest.raises(SoftShadowError, match="Menu:red: the program has no menus of GLUT"):
        run_script(path, keys="Menu:red")


def test_a_click_that_opens_a_menu_is_told(tmp_path: Path) -> None:
    setup = MENUS + "glutMouseFunc(lambda *_: paint(1, 1, 1))\n"
    with pytest.warns(CallsLeftOut, match="the right button opens a menu"):
        run_script(written(tmp_path, setup), clicks=[(3, 3, "right")])
    assert color(run_script(written(tmp_path, setup), clicks=[(3, 3)])) == [255, 255, 255]


@pytest.mark.parametrize(
    ("key", "expected"),
    [("a", "b'a' 0"), ("A", "b'A' 1"), ("Shift+a", "b'A' 1"), ("Ctrl+a", "b'\\x01' 2"), ("Alt+1", "b'1' 4"),
     ("Ctrl+Shift+F2", "2 3"), ("Delete", "b'\\x7f' 0"), ("?", "b'?' 1"), ("Shift+/", "b'?' 1"), ("+", "b'+' 1"),
     ("Ctrl++", "b'+' 3")],
)  # fmt: skip
def test_keys_are_pressed_with_modifiers(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], key: str, expected: str
) -> None:
    setup = """
def pressed(key, x, y):
    if not isinstance(key, int) or key < 100: print(key, glutGetModifiers())
    glutPostRedisplay()
glutKeyboardFunc(pressed)
glutSpecialFunc(pressed)
"""
    run_script(written(tmp_path, setup), keys=key)
    assert capsys.readouterr().out.strip() == expected


def test_the_pointer_is_dragged_turned_and_warped(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    setup = """
def say(name):
    def call(*numbers):
        print(name, *numbers)
        glutPostRedisplay()
    return call
glutMouseFunc(say("mouse"))
glutMotionFunc(say("motion"))
glutPassiveMotionFunc(say("passive"))
glutMouseWheelFunc(say("wheel"))
glutWarpPointer(2, 5)
"""
    run_script(written(tmp_path, setup), keys="WheelUp,WheelDown", drags=[(4, 5, 9, 7, "middle")])
    assert capsys.readouterr().out.splitlines() == [
        "passive 2 5", "wheel 0 1 2 5", "wheel 0 -1 2 5", "passive 4 5", "mouse 1 0 4 5", "motion 9 7", "mouse 1 1 9 7",
    ]  # fmt: skip


def test_a_window_changes_its_size(tmp_path: Path) -> None:
    setup = """
glutKeyboardFunc(lambda *_: glutReshapeWindow(20, 10))
glutReshapeFunc(lambda w, h: paint(w == 20, 0, h == 10))
"""
    path = written(tmp_path, setup)
    assert run_script(path).size == (16, 12)
    run = run_script(path, keys="a")
    assert run.size == (20, 10)
    assert color(run) == [255, 0, 255]
    assert run_script(path, frames=2, keys="a,a", size=(30, 30)).size == (30, 30)


def test_a_window_fills_the_screen_and_gets_its_size_again(tmp_path: Path) -> None:
    setup = """
glutKeyboardFunc(lambda *_: glutFullScreenToggle())
sizes = []
glutReshapeFunc(lambda w, h: sizes.append((w, h)))
"""
    display = "glutSwapBuffers() if frame < 3 else sys.exit(sizes and 'sizes ' + str(sizes))"
    with pytest.warns(CallsLeftOut, match="drew 2 of 3 frames"):
        run = run_script(written(tmp_path, setup, display=display), keys="a,a")
    assert run.size == (16, 12)


WINDOWS = """
glutSetWindowData("first")
second = glutCreateWindow("second")
def paint_second():
    glClearColor(0, 0, 1, 1)
    glClear(GL_COLOR_BUFFER_BIT)
    glutSwapBuffers()
glutDisplayFunc(paint_second)
inner = glutCreateSubWindow(second, 2, 3, 8, 5)
def paint_inner():
    glClearColor(0, 1, 0, 1)
    glClear(GL_COLOR_BUFFER_BIT)
    glutSwapBuffers()
    assert glutGet(GLUT_WINDOW_PARENT) == second and glutGet(GLUT_WINDOW_X) == 2
glutDisplayFunc(paint_inner)
glutSetWindow(1)
assert glutGetWindowData() == "first"
color[:] = 1, 0, 0
"""


@pytest.mark.parametrize(("number", "expected", "size"), [(1, RED, (16, 12)), (2, BLUE, (16, 12)), (3, GREEN, (8, 5))])
def test_one_of_several_windows_is_shown(
    tmp_path: Path, number: int, expected: list[int], size: tuple[int, int]
) -> None:
    with pytest.warns(CallsLeftOut, match="opens window"):
        run = run_script(written(tmp_path, WINDOWS), window=number)
    assert color(run) == expected
    assert run.size == size
    assert [word in told(run) for word in ("window 1,", "window 2,", "window 3,")] == [n != number for n in (1, 2, 3)]


def test_a_window_that_is_not_opened_cannot_be_shown(tmp_path: Path) -> None:
    with pytest.raises(SoftShadowError, match="the program opened no window 2"):
        run_script(written(tmp_path, "sys.exit()"), window=2)
    with pytest.raises(ValueError, match="window=0: expected 1 or more"):
        run_script(written(tmp_path, ""), window=0)


def test_an_animation_that_waits_for_visibility_begins(tmp_path: Path) -> None:
    """As in the demos of GLUT: the idle callback is set when the window becomes visible."""
    setup = (
        "glutVisibilityFunc(lambda state: glutIdleFunc(lambda: paint(frame / 4, 0, 0) if state == GLUT_VISIBLE else 0))"
    )
    assert [color(run_script(written(tmp_path, setup), frames=n))[0] for n in (1, 3)] == [0, 128]


def test_the_main_loop_returns_if_the_program_asks_for_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    setup = (
        "glutCloseFunc(lambda: print('closed'))\nglutKeyboardFunc(lambda *_: (glutLeaveMainLoop(), print('left')))\n"
    )
    option = "glutSetOption(GLUT_ACTION_ON_WINDOW_CLOSE, GLUT_ACTION_GLUTMAINLOOP_RETURNS)\n"
    for added, expected in (("", "left closed"), (option, "left closed after")):
        path = written(tmp_path, setup + added)
        path.write_text(path.read_text() + "print('after')\n")
        with pytest.warns(CallsLeftOut, match="drew 1 of 2 frames"):
            run_script(path, keys="q")
        assert capsys.readouterr().out.split() == expected.split()


def test_destroying_the_window_ends_the_program(tmp_path: Path) -> None:
    setup = "glutKeyboardFunc(lambda *_: glutDestroyWindow(glutGetWindow()))"
    with pytest.warns(CallsLeftOut, match="drew 1 of 3 frames and ended"):
        run_script(written(tmp_path, setup), keys="q,q")


@pytest.mark.parametrize(
    ("setup", "mode", "display", "expected"),
    [
        ("", "GLUT_DOUBLE", "pass", "does not call glutSwapBuffers"),
        ("glEnable(GL_DEPTH_TEST)", "GLUT_DOUBLE", "glutSwapBuffers()", "does not ask for GLUT_DEPTH"),
        ("glEnable(GL_STENCIL_TEST)", "GLUT_SINGLE | GLUT_DEPTH", "glFlush()", "does not ask for GLUT_STENCIL"),
        ("glEnable(GL_BLEND); glBlendFunc(GL_DST_ALPHA, GL_ZERO)", "GLUT_DOUBLE", "glutSwapBuffers()", "GLUT_ALPHA"),
        ("", "GLUT_DOUBLE | GLUT_MULTISAMPLE", "glutSwapBuffers()", "GLUT_MULTISAMPLE: edges are not smoothed"),
        ("glutInitContextVersion(3, 3)", "GLUT_DOUBLE", "glutSwapBuffers()", "asks for OpenGL 3.3"),
        ("glutGetModifiers()", "GLUT_DOUBLE", "glutSwapBuffers()", "outside of a callback"),
        ("glutSetWindow(9)", "GLUT_DOUBLE", "glutSwapBuffers()", "there is no such window"),
        ("glutEstablishOverlay()", "GLUT_DOUBLE", "glutSwapBuffers()", "glutEstablishOverlay \\(1 call\\), missing"),
    ],
)
def test_what_differs_on_a_screen_is_told(tmp_path: Path, setup: str, mode: str, display: str, expected: str) -> None:
    with pytest.warns(CallsLeftOut, match=expected):
        run = run_script(written(tmp_path, setup, mode, display))
    assert len(run.warnings) == 1


def test_a_key_without_glut_post_redisplay_is_told(tmp_path: Path) -> None:
    setup = "glutKeyboardFunc(lambda *_: color.__setitem__(0, 1))"
    with pytest.warns(CallsLeftOut, match="does not call glutPostRedisplay"):
        run = run_script(written(tmp_path, setup), keys="a")
    assert color(run) == RED


def test_what_a_window_has_asked_for_is_no_note(tmp_path: Path) -> None:
    setup = """
glEnable(GL_DEPTH_TEST)
glEnable(GL_STENCIL_TEST)
glutJoystickFunc(display, 10)
glutSetCursor(GLUT_CURSOR_NONE)
"""
    path = written(tmp_path, setup, "GLUT_DOUBLE | GLUT_RGB | GLUT_DEPTH | GLUT_STENCIL")
    assert not run_script(path).warnings
    text = path.read_text().replace(
        "glutInitDisplayMode(", "glutInitDisplayString('rgb double depth>=16 stencil') or ("
    )
    path.write_text(text)
    assert not run_script(path).warnings


def test_a_window_without_a_display_callback_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(SoftShadowError, match="window 1 has no display callback"):
        run_script(written(tmp_path, "glutDisplayFunc(None)"))


def test_numbers_about_the_program_are_those_of_freeglut(tmp_path: Path) -> None:
    setup = """
assert (glutGet(GLUT_WINDOW_WIDTH), glutGet(GLUT_WINDOW_HEIGHT), glutGet(GLUT_INIT_WINDOW_WIDTH)) == (16, 12, 16)
assert (glutGet(GLUT_INIT_STATE), glutGet(GLUT_WINDOW_DOUBLEBUFFER), glutGet(GLUT_WINDOW_NUM_CHILDREN)) == (1, 1, 0)
assert (glutGet(GLUT_WINDOW_DEPTH_SIZE), glutGet(GLUT_WINDOW_CURSOR), glutGet(GLUT_INIT_WINDOW_X)) == (24, 100, -1)
assert (glutDeviceGet(GLUT_HAS_MOUSE), glutDeviceGet(GLUT_HAS_JOYSTICK), glutLayerGet(GLUT_HAS_OVERLAY)) == (1, 0, 0)
glutGameModeString(b"800x600:32")
assert (glutGameModeGet(GLUT_GAME_MODE_WIDTH), glutGameModeGet(GLUT_GAME_MODE_REFRESH_RATE)) == (800, -1)
assert (glutExtensionSupported("GL_ARB_shadow"), glutExtensionSupported("GL_ARB_sha")) == (1, 0)
"""
    assert not run_script(written(tmp_path, setup)).warnings


@pytest.mark.parametrize("library", ["pygame", "glfw"])
def test_pygame_and_glfw_hear_drags_wheels_and_modifiers(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], library: str
) -> None:
    path = tmp_path / "program.py"
    path.write_text({
        "pygame": """
import pygame
from pygame.locals import *
pygame.display.set_mode((16, 12), OPENGL | DOUBLEBUF)
while True:
    for event in pygame.event.get():
        if event.type == KEYDOWN: print("key", event.key == K_a, event.mod & KMOD_SHIFT > 0)
        if event.type == MOUSEWHEEL: print("wheel", event.y)
        if event.type == MOUSEMOTION: print("motion", event.pos, event.rel, event.buttons)
        if event.type == MOUSEBUTTONUP and event.button < 4: print("up", event.pos, event.button)
    pygame.display.flip()
""",
        "glfw": """
import glfw
window = glfw.create_window(16, 12, "", None, None)
glfw.set_key_callback(window, lambda w, key, code, action, mods:
                      action and print("key", key == glfw.KEY_A, mods == glfw.MOD_SHIFT))
glfw.set_scroll_callback(window, lambda w, x, y: print("wheel", int(y)))
glfw.set_cursor_pos_callback(window, lambda w, x, y: x == 5 and print("motion (5, 6) (3, 3) (0, 0, 1)"))
glfw.set_mouse_button_callback(window, lambda w, button, action, mods:
                               action or print("up", tuple(map(int, glfw.get_cursor_pos(w))), {0: 1, 1: 3}[button]))
while True:
    glfw.swap_buffers(window)
    glfw.poll_events()
""",
    }[library])  # fmt: skip
    run_script(path, keys="Shift+a,WheelDown", drags=[(2, 3, 5, 6, "right")], clicks=[(1, 2)])
    assert capsys.readouterr().out.splitlines() == [
        "key True True", "wheel -1", "up (1, 2) 1", "motion (5, 6) (3, 3) (0, 0, 1)", "up (5, 6) 3",
    ]  # fmt: skip
