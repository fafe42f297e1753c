"""Warnings of runs are shown as Python shows warnings: equal ones once per line."""

import warnings

import pytest

import softshadow as ss

SIZE = (64, 48)


@pytest.fixture
def shown(monkeypatch):
    """Return the texts of the warnings that are shown, with Python's own filters and nothing shown before."""
    texts = []
    monkeypatch.delitem(globals(), "__warningregistry__", raising=False)
    with warnings.catch_warnings():
        warnings.resetwarnings()
        monkeypatch.setattr(warnings, "_showwarnmsg_impl", lambda message: texts.append(str(message.message)))
        yield texts


def test_frames_of_an_animation_show_equal_warnings_once(shown):
    runs = [ss.run("volume-zpass", "eye-in-shadow", SIZE) for _ in range(3)]
    assert len(shown) == 1
    assert [len(run.warnings) for run in runs] == [1, 1, 1]


def test_other_lines_and_other_texts_show_theirs(shown):
    ss.run("volume-zpass", "eye-in-shadow", SIZE)
    ss.run("volume-zpass", "eye-in-shadow", SIZE)
    assert len(shown) == 2
    for name in ("open-tube", "eye-in-shadow", "open-tube"):
        ss.run("volume-zpass", name, SIZE)
    assert len(shown) == 4


@pytest.mark.parametrize(("action", "number"), [("always", 3), ("ignore", 0), ("once", 1), ("module", 1)])
def test_filters_of_the_program_hold(shown, action, number):
    warnings.simplefilter(action)
    for _ in range(3):
        ss.run("volume-zpass", "eye-in-shadow", SIZE)
    assert len(shown) == number


def test_a_filter_that_makes_errors_does_so_every_time(shown):
    ss.run("volume-zpass", "eye-in-shadow", SIZE)
    warnings.simplefilter("error")
    for _ in range(2):
        with pytest.raises(ss.NearClipZPass):
            ss.run("volume-zpass", "eye-in-shadow", SIZE)
