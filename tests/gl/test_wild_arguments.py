"""Whatever the arguments are, a call ends in GL's error, or in a TypeError or ValueError that names it."""

import numpy as np
import pytest

from gl.facade_calls import prepare
from gl.wild_arguments import wild_calls
from softshadow import gl
from softshadow.errors import SoftShadowError
from softshadow.pipeline import execute
from softshadow.pipeline.commands import Clear

QUICK, PARTS, LONG = 16, 4, 1000  # sequences


def names_of(call: object) -> list[str]:
    """Return the names under which the package has a call."""
    return [name for name in dir(gl) if getattr(gl, name) is call]


def unnamed_errors(seed: int) -> list[str]:
    """Make the calls of a sequence; return the errors that name neither the call nor a rule of GL."""
    found = []
    with gl.create_context(8, 8, raise_errors=bool(seed % 2)):
        for name, arguments in [*wild_calls(gl, prepare(gl), seed), ("glFinish", [])]:
            call = getattr(gl, name)
            try:
                call(*arguments)
            except SoftShadowError:
                pass
            except (TypeError, ValueError) as error:
                if not any(str(error).startswith((f"{each}(", f"{each}:")) for each in names_of(call)):
                    found.append(f"seed {seed}: {name}{arguments}: {error!r}")
            except Exception as error:
                found.append(f"seed {seed}: {name}{arguments}: {error!r}")
    return found


@pytest.mark.interpreted
@pytest.mark.filterwarnings("ignore")  # NumPy's, about NaN and text in arrays
def test_wild_arguments_end_in_errors_that_name_the_call():
    assert [error for seed in range(QUICK) for error in unnamed_errors(seed)] == []


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("part", range(PARTS))
def test_wild_arguments_of_many_sequences_end_in_errors_that_name_the_call(part):
    seeds = range(QUICK + part * LONG, QUICK + (part + 1) * LONG)
    assert [error for seed in seeds for error in unnamed_errors(seed)] == []


@pytest.mark.parametrize(
    ("name", "arguments", "kind", "said"),
    [
        ("glVertex3f", ("a", 0, 0), TypeError, "glVertex3f(x='a'): expected a number"),
        ("glVertex2d", (0, None), TypeError, "glVertex2f(y=None): expected a number"),
        ("glVertex4i", (1, 2, np.zeros((2, 2)), 1), TypeError, "glVertex4f(z=array of 2 x 2 float64): expected a num"),
        ("glTranslatef", (1, 2, "b"), TypeError, "glTranslatef(z='b'): expected a number"),
        ("glColor3f", (0, 1j, 0), TypeError, "glColor3f(green=1j): expected a number"),
        ("glColor4ub", (0, 1, float("inf"), 3), ValueError, "glColor4ub(blue=inf): expected an integer"),
        ("glDrawArrays", (4, 0, float("nan")), ValueError, "glDrawArrays(count=nan): expected an integer"),
        ("glClearDepth", (10**400,), ValueError, "glClearDepth(depth=a whole number of 1329 bits): expected a number"),
        ("glEnable", ([],), TypeError, "glEnable(cap=[]): expected an integer"),
        ("glViewport", (0, 0, 8), TypeError, "glViewport() missing 1 required positional argument: 'height'"),
        ("glLightfv", (0x4000, 0x1200, [1, 2]), ValueError, "glLightfv(light=16384, pname=4608, params=[1, 2]): "),
    ],
)  # fmt: skip
def test_a_wrong_argument_is_named_at_the_call(name, arguments, kind, said):
    with gl.create_context(8, 8):
        gl.glBegin(gl.GL_TRIANGLES) if name.startswith("glVertex") else None
        with pytest.raises(kind) as raised:
            getattr(gl, name)(*arguments)
    assert str(raised.value).startswith(said)


def test_a_display_list_refuses_a_wrong_argument_when_it_is_compiled():
    with gl.create_context(8, 8):
        gl.glNewList(1, gl.GL_COMPILE)
        gl.glBegin(gl.GL_TRIANGLES)
        with pytest.raises(TypeError, match=r"glVertex3f\(x='a'\): expected a number"):
            gl.glVertex3f("a", 0, 0)


def test_an_error_while_something_is_drawn_keeps_its_kind(monkeypatch):
    """Defects of the pipeline are not taken for wrong arguments."""

    def fail(*_):
        raise IndexError("a defect")

    monkeypatch.setitem(execute.EXECUTORS, Clear, fail)
    with gl.create_context(8, 8), pytest.raises(IndexError, match="a defect"):
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
