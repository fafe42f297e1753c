"""Names of objects: a call returns as many as it was asked for, or GL_OUT_OF_MEMORY."""

import pytest

from softshadow import gl
from softshadow.gl.names import MOST_NAMES

GENERATORS = (
    "glGenLists", "glGenTextures", "glGenBuffers", "glGenQueries", "glGenFramebuffers", "glGenRenderbuffers",
)  # fmt: skip


@pytest.mark.parametrize("name", GENERATORS)
def test_more_names_than_memory_holds_are_refused(name: str) -> None:
    with gl.create_context(4, 4, raise_errors=False):
        before = getattr(gl, name)(1)
        for n in (2**31, MOST_NAMES + 1):
            assert getattr(gl, name)(n) is None
            assert gl.glGetError() == gl.GL_OUT_OF_MEMORY
        assert getattr(gl, name)(1) == before + 1
