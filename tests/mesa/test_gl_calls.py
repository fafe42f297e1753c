"""Programs as data are replayed, printed and shrunk."""

import numpy as np

from mesa.gl_calls import as_code, replay, shrink

TRIANGLE = [("glBegin", ("GL_TRIANGLES",)), ("glVertex2f", (0.5, 1.0)), ("glEnd", ())]


class Recorder:
    """A namespace whose functions return their first argument and whose tokens are their own names."""

    def __init__(self):
        self.calls = []

    def __getattr__(self, name):
        if name.startswith("GL_"):
            return name.lower()

        def function(*arguments):
            self.calls.append((name, *arguments))
            return 7 if name.startswith("glGen") else next(iter(arguments), None)

        return function


def test_tokens_are_looked_up_and_objects_made_once():
    recorder = Recorder()
    bind = ("glBindTexture", ("GL_TEXTURE_2D", "texture 0"))
    replay(recorder, [bind, bind])
    assert recorder.calls == [("glGenTextures", 1), *[("glBindTexture", "gl_texture_2d", 7)] * 2]


def test_only_reading_calls_answer():
    answers = replay(Recorder(), [("glGetFloatv", (3,)), ("glClear", (4,)), ("glReadPixels", (5,))])
    assert [int(answer) for answer in answers] == [3, 5]


def test_printed_code_makes_the_same_calls():
    calls = [
        *TRIANGLE,
        ("glBindTexture", ("GL_TEXTURE_2D", "texture 1")),
        ("glVertexPointer", (2, "GL_FLOAT", 0, np.array([[0.1, 2]], np.float32))),
    ]
    namespace = {"np": np}
    exec(as_code(calls), namespace)
    printed, replayed = Recorder(), Recorder()
    namespace["program"](printed)
    replay(replayed, calls)
    assert str(sorted(printed.calls, key=str)) == str(sorted(replayed.calls, key=str))


def test_shrinking_leaves_the_calls_that_matter():
    noise = [("glEnable", (number,)) for number in range(40)]
    needed = {("glEnable", (11,)), ("glEnable", (33,))}
    assert set(shrink(noise, lambda calls: needed <= set(calls))) == needed


def test_shrinking_stops_after_its_attempts():
    noise = [("glEnable", (number,)) for number in range(40)]
    assert shrink(noise, lambda calls: False, attempts=3) == noise
    assert shrink(noise, lambda calls: True, seconds=0) == noise
