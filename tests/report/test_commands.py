"""Commands on pages ask for the same run again."""

from dataclasses import replace

import softshadow as ss
from softshadow.report.commands import options_spelled, scene_spelled


def test_built_in_scene_is_named_and_others_are_a_placeholder() -> None:
    torus = ss.Scene.named("torus")
    assert scene_spelled(torus, (64, 48)) == "--scene torus --size 64x48"
    relit = replace(torus, lights=(ss.Light((1, 9, 1)),))
    assert scene_spelled(relit, (64, 48)) == "--scene FILE --size 64x48"
    assert scene_spelled(replace(torus, name="mine"), (64, 48)) == "--scene FILE --size 64x48"


def test_options_are_those_that_were_changed() -> None:
    assert options_spelled("map", ss.run("map", "boxes", (8, 6)).options) == ""
    changed = ss.run("map", "boxes", (8, 6), map_size=64, cull="front")
    assert options_spelled("map", changed.options) == " -O map_size=64 -O cull=front"
