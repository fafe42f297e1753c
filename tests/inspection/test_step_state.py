"""The state of a step: with matrices, generated coordinates, texture comparison and uniforms."""

import numpy as np

import softshadow as ss

SIZE = (48, 36)


def test_state_of_a_map_has_the_comparison_of_its_texture_and_all_matrices():
    run = ss.run("map", "boxes", size=SIZE)
    state, text = run[-1].state, str(run[-1].state)
    assert "glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_R_TO_TEXTURE)" in text
    assert "glTexParameteri(GL_TEXTURE_2D, GL_DEPTH_TEXTURE_MODE, GL_ALPHA)" in text
    for mode in ("GL_PROJECTION", "GL_MODELVIEW", "GL_TEXTURE"):
        assert f"glMatrixMode({mode})\nglLoadMatrixf((" in text
    assert np.allclose(state.modelview[:3, :3] @ state.modelview[:3, :3].T, np.eye(3), atol=1e-6)
    assert state.alpha.enabled
    assert repr(state) == text


def test_state_of_a_program_has_its_uniforms():
    run = ss.run("map-pcf", "boxes", size=SIZE, bias=0.25)
    with_program = next(c.state for c in run.frame.commands if getattr(c, "program_name", ""))
    assert with_program.program
    assert run["draw the scene without the light"].state.uniforms == {}


def test_generated_coordinates_are_printed():
    def steps(gl, scene, *, size):
        gl.glEnable(gl.GL_TEXTURE_GEN_S)
        gl.glTexGeni(gl.GL_S, gl.GL_TEXTURE_GEN_MODE, gl.GL_EYE_LINEAR)
        gl.glTexGenfv(gl.GL_S, gl.GL_EYE_PLANE, (0.0, 0.0, 1.0, 0.5))
        gl.glRectf(-1, -1, 1, 1)
        yield "draw"

    run = ss.run(ss.techniques.Technique("mine", "Mine", "map", "none", steps), "boxes", size=SIZE)
    assert "glTexGenfv(GL_S, GL_EYE_PLANE, (0, 0, 1, 0.5))" in str(run[0].state)
