"""The course's listings as techniques, drawn and recorded on the stage that the listings share."""

from __future__ import annotations

import inspect
from collections.abc import Iterable
from typing import Any

from softshadow.gallery.failure import Setting
from softshadow.listings import Listing, get
from softshadow.listings.stage import AMBIENT, FAR, FIELD_OF_VIEW, NEAR, STAGE, Stage
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


def listing_scene(listing: Listing) -> Scene:
    """Return the stage that a listing draws by default as a scene."""
    stage = inspect.signature(listing.calls).parameters.get("stage")
    return scene_of(STAGE if stage is None else stage.default, f"stage of {listing.name}")


def listing_technique(listing: Listing, corrected: Iterable[str], **arguments: Any) -> Technique:
    """Return a listing as a technique, with some of its corrections; its steps are those of the listing.

    Parameters
    ----------
    arguments                    of the listing's function, like its stage
    """

    def steps(gl: Any, scene: Scene, *, size: tuple[int, int]) -> Steps:
        yield from listing.steps(gl, corrected, **arguments)

    return Technique(f"listing {listing.name}", listing.title, listing.family, listing.slide, steps, {})


def as_listed(name: str, without: str = "", **arguments: Any) -> Setting:
    """Return a corrected listing as a setting of a failure, with one correction left out if wanted.

    Parameters
    ----------
    name : str                   of the listing
    without : str                the number of the correction to leave out, like "E38"; by default none
    arguments                    of the listing's function, like its stage
    """
    listing = get(name)
    corrected = [number for number in listing.corrections if number != without]
    return Setting(listing_technique(listing, corrected, **arguments))
