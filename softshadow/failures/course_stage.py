"""The course's listings as techniques: what a slide prints, run and recorded, on the listings' stage."""

from __future__ import annotations

from typing import Any

from softshadow.failures.failure import Setting
from softshadow.listings import get
from softshadow.listings.stage import AMBIENT, FAR, FIELD_OF_VIEW, NEAR, Stage
from softshadow.scene import Camera, Light, Material, Scene, SceneObject
from softshadow.techniques import Steps, Technique


def scene_of(stage: Stage, name: str) -> Scene:
    """Return the scene that a stage is: its receivers do not cast."""
    things = [(thing, thing in stage.occluder) for thing in stage.scene]
    return Scene(
        name,
        Camera(stage.eye, stage.target, fov_y=FIELD_OF_VIEW, near=NEAR, far=FAR),
        (Light(stage.light),),
        [
            SceneObject(thing.mesh, material=Material(thing.color), casts=casts, receives=not casts)
            for thing, casts in things
        ],
        ambient=(AMBIENT, AMBIENT, AMBIENT),
        background=(0, 0, 0),
    )


def as_listed(name: str, without: str = "", **given: Any) -> Setting:
    """Return a listing as a setting of a failure: corrected, but for one correction.

    Parameters
    ----------
    name : str                   of the listing
    without : str                the number of the correction that is left out, as in "E38"; none is by default
    given                        what the listing's function takes, as its stage
    """
    listing = get(name)
    program = listing.without(without) if without else listing.corrected

    def steps(gl: Any, scene: Scene, *, size: tuple[int, int]) -> Steps:
        program(gl, **given)
        yield listing.title

    return Setting(Technique(f"listing {name}", listing.title, listing.family, listing.slide, steps, {}))
