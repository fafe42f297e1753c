"""GLSL programs on Mesa: the other side of `softshadow.programs`."""

from OpenGL import GL


def link_program(name: str, vertex_source: str, fragment_source: str) -> int:
    """Return a linked GL program; ValueError with the compiler's log if a source does not compile."""
    program = GL.glCreateProgram()
    for kind, label, source in (
        (GL.GL_VERTEX_SHADER, "vertex", vertex_source),
        (GL.GL_FRAGMENT_SHADER, "fragment", fragment_source),
    ):
        shader = GL.glCreateShader(kind)
        GL.glShaderSource(shader, source)
        GL.glCompileShader(shader)
        if not GL.glGetShaderiv(shader, GL.GL_COMPILE_STATUS):
            raise ValueError(f"program {name!r}, {label} shader:\n{_text(GL.glGetShaderInfoLog(shader))}")
        GL.glAttachShader(program, shader)
    GL.glLinkProgram(program)
    if not GL.glGetProgramiv(program, GL.GL_LINK_STATUS):
        raise ValueError(f"program {name!r} does not link:\n{_text(GL.glGetProgramInfoLog(program))}")
    return int(program)


def _text(log: bytes | str) -> str:
    return log.decode(errors="replace") if isinstance(log, bytes) else log
