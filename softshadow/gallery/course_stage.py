"""The course's listings as techniques, drawn and recorded on the stage that the listings share."""

from __future__ import annotations

from typing import Any

from softshadow.gallery.failure import Setting
from softshadow.listings import get
from softshadow.listings.stage import AMBIENT, FAR, FIELD_OF_VIEW, NEAR, Stage
from softshadow.scene import Camera, Light, Material, Scene, SceneObject
from softshadow.techniques import Steps, Technique


def scene_of(stage: Stage, name: str) -> Scene:
    """Return a stage as a scene; its receivers cast no shadows."""
    items = [(item, item in stage.occluder) for item in stage.scene]
    return Scene(
        name,
        Camera(stage.eye, stage.target, fov_y=FIELD_OF_VIEW, near=NEAR, far=FAR),
        (Light(stage.light),),
        [
            SceneObject(item.mesh, material=Material(item.color), casts=casts, receives=not casts)
            for item, casts in items
        ],
        ambient=(AMBIENT, AMBIENT, AMBIENT),
        background=(0, 0, 0),
    )


def as_listed(name: str, without: str = "", **arguments: Any) -> Setting:
    """Return a corrected listing as a setting of a failure, with one correction left out if wanted.

    Parameters
    ----------
    name : str                   of the listing
    without : str                the number of the correction to leave out, like "E38"; by default none
    arguments                    of the listing's function, like its stage
    """
    listing = get(name)
    program = listing.without(without) if without else listing.corrected

    def steps(gl: Any, scene: Scene, *, size: tuple[int, int]) -> Steps:
        program(gl, **arguments)
        yield listing.title

    return Setting(Technique(f"listing {name}", listing.title, listing.family, listing.slide, steps, {}))
