"""What runs and their parts print: short summaries with names, no arrays and no tokens as numbers."""

import pytest
from IPython.core.completer import provisionalcompleter
from IPython.core.interactiveshell import InteractiveShell

import softshadow as ss
from softshadow.inspection import Maps

SIZE = (64, 48)


@pytest.fixture(scope="module")
def run():
    return ss.run("map", "torus", SIZE, map_size=32)


def parts_of(run):
    """Return everything that a run and its parts are made of."""
    step = run[2]
    yield from (run, step, step.state, step.state.stencil, step.state.units[0], step.buffers, run.frame, run.ledger)
    yield from (run.diff(0, 2), run.compare(truth="hard"), run.pixel(30, 35), run.cross_section(30, 35), run.lights)
    yield from (run.maps, step.maps, run.scene, run.scene.objects[1], run.scene.objects[1].mesh.topology)
    yield from (ss.soft_truth(run.scene, (8, 6)), *step.commands[-2:])


def test_nothing_prints_arrays_or_numbers_of_tokens(run):
    for part in parts_of(run):
        text = repr(part)
        assert "array(" not in text
        assert "func=" not in text
        assert " at 0x" not in text
        assert len(text) < 2400, text  # the longest is a state with its matrices


def test_state_and_its_groups_print_as_the_calls_that_set_them(run):
    assert "glStencilFunc(GL_NOTEQUAL, 1, 0x01)" in repr(run[2].state.stencil).splitlines()
    assert repr(run[2].state) == str(run[2].state)
    assert repr(run[2].state.clip_planes) == "# GL's initial state"


def test_titles_complete_keys(run):
    shell = InteractiveShell.instance()
    shell.user_ns["run"] = run
    with provisionalcompleter():
        found = [completion.text for completion in shell.Completer.completions('run["', 5)]
    assert {"draw the depth map from the light", "draw the scene without the light"} <= {f.strip('"]') for f in found}
    assert run.steps._ipython_key_completions_() == run.steps.titles


def test_maps_print_their_sizes_and_ranges(run):
    assert repr(run.maps).splitlines()[0].startswith("ZS  32 x 32 float32, 0.")
    assert repr(Maps()) == "no maps"
    assert run.maps._repr_mimebundle_()[0]["image/png"]
    assert Maps()._repr_mimebundle_()[0] == {"text/plain": "no maps"}
    with pytest.raises(KeyError, match="there is no map 'SZ': did you mean 'ZS'"):
        run.maps["SZ"]
    assert run.maps.get("SZ") is None


def test_sheets_show_the_maps_of_a_step_that_draws_no_window(run):
    from softshadow.inspection.step import shown_buffers

    assert [list(shown_buffers(step)) for step in run] == [["ZS"], *[["colour", "depth", "stencil"]] * 2]
