"""Counting cards: varied pixels, with the stencil buffer's own numbers as answers."""

import builtins
import warnings

import numpy as np
import pytest
from PIL import Image

import softshadow as ss
from softshadow.report.card_pages import DOTS, HEIGHT, ROWS, WIDTH

SIZE = (160, 120)


@pytest.fixture(scope="module")
def run():
    return ss.run("volume-zpass", "overlapping", SIZE)


@pytest.mark.parametrize("technique", ["volume-zpass", "volume-zfail", "volume-parity"])
def test_the_answers_are_the_counts_of_the_stencil_buffer(technique):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ss.CounterSaturated)  # of the parity
        run = ss.run(technique, "overlapping", SIZE)
    cards = ss.counting_cards(run, n=6)
    assert len(cards) == 6
    for card in cards.cards:
        counts = [card.line.start, *(each.count for each in card.line.crossings)]
        assert counts[-1] == run.stencil[card.y, card.x]
        assert card.result.startswith(f"Stencil value {counts[-1]}: P is drawn ")
        assert len(card.answers) == len(card.line.crossings) == len(card.places)
        assert card.result.endswith("lit.") == (run.stencil[card.y, card.x] == 0)


def test_pixels_are_varied_and_the_seed_chooses_them(run):
    cards = ss.counting_cards(run, n=6)
    kinds = {(len(card.line.crossings), card.line.end) for card in cards.cards}
    assert {0, 1, 2} <= {end for _, end in kinds}
    assert {0, 1, 2} <= {crossings for crossings, _ in kinds}
    pixels = [(card.x, card.y) for card in cards.cards]
    assert len(set(pixels)) == 6
    assert pixels == [(card.x, card.y) for card in ss.counting_cards(run, n=6).cards]
    assert pixels != [(card.x, card.y) for card in ss.counting_cards(run, n=6, seed=1).cards]
    assert f"({cards[0].x}, {cards[0].y})" in repr(cards)


def test_crossings_lie_on_the_line_of_sight_of_the_section(run):
    for card in ss.counting_cards(run, n=6).cards:
        towards = card.section.point - card.section.eye
        for place in card.places:
            off = place - card.section.eye
            assert abs(towards[0] * off[1] - towards[1] * off[0]) < 1e-9 * np.linalg.norm(towards) ** 2


@pytest.mark.slow
def test_a_pdf_has_answers_on_every_second_page_and_is_the_same_each_time(run, tmp_path):
    cards = ss.counting_cards(run, n=4)
    data = cards.save(tmp_path / "a.pdf").read_bytes()
    assert data.count(b"/Type /Page\n") + data.count(b"/Type /Page ") == 4
    assert data == cards.save(tmp_path / "b.pdf").read_bytes()
    cards.save(tmp_path / "a.pdf")  # its own file is overwritten
    (tmp_path / "foreign.pdf").write_bytes(b"%PDF-1.4")
    with pytest.raises(ss.SoftShadowError, match="was not written by softshadow"):
        cards.save(tmp_path / "foreign.pdf")


def test_a_png_has_the_answers_at_the_right(run, tmp_path):
    path = ss.counting_cards(run, n=2).save(tmp_path / "cards.png")
    with Image.open(path) as picture:
        assert picture.size == (round(2 * WIDTH * DOTS), round(2 * HEIGHT / ROWS * DOTS))


def test_lights_at_infinity_and_names_with_signs_are_drawn(tmp_path):
    plain = ss.Scene.named("boxes")
    light = ss.Light((-1, 2, 1, 0), name="$sun_1^2$")
    scene = ss.Scene("$a_1$", plain.camera, [light], plain.objects)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ss.counting_cards(ss.run("volume-zfail", scene, SIZE), n=2).save(tmp_path / "sun.pdf")


def test_mistakes_are_told(run, tmp_path):
    with pytest.raises(ss.StateError, match="'map' counts no faces; expected one of volume-zpass"):
        ss.counting_cards(ss.run("map", "boxes", (32, 24)))
    with pytest.raises(ss.StateError, match="expected fewer cards"):
        ss.counting_cards(ss.run("volume-zpass", "boxes", (8, 6)), n=60)
    with pytest.raises(ValueError, match="n=0"):
        ss.counting_cards(run, n=0)
    with pytest.raises(ValueError, match=r"expected a name that ends in .pdf or .png"):
        ss.counting_cards(run, n=1).save(tmp_path / "cards.svg")


def test_without_matplotlib_the_extra_is_named(run, tmp_path, monkeypatch):
    real = builtins.__import__

    def without(name, *more, **named):
        if name.startswith("matplotlib"):
            raise ImportError(name)
        return real(name, *more, **named)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(ss.SoftShadowError, match=r"pip install 'softshadow\[notebook\]'"):
        ss.counting_cards(run, n=1).save(tmp_path / "cards.pdf")
