"""The errors of a run against ray casting, and the figures of its buffers and of its work."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from softshadow.inspection.soft_truth import SoftTruth, soft_truth
from softshadow.runs import Run
from softshadow.scene import Scene
from softshadow.space.shadow_parts import scene_of
from softshadow.testing import Truth, agreement, cast_truth

TRUTHS = 8  # kept in memory: neighbouring points of a sweep have the same scene and size
_truths: dict[tuple[Any, ...], Any] = {}


def remembered(kind: str, drawn: Run, compute: Callable[[], Any]) -> Any:
    """Return the truth of a run's scene and size, from memory if it was computed for an equal scene before."""
    key = (kind, drawn.size, fingerprint(scene_of(drawn)))
    if key not in _truths:
        while len(_truths) >= TRUTHS:
            del _truths[next(iter(_truths))]
        _truths[key] = compute()
    return _truths[key]


def fingerprint(scene: Scene) -> str:
    """Return a digest of what rays depend on: meshes and their places, camera, lights."""
    digest = hashlib.sha256(repr((scene.camera, scene.lights)).encode())
    for thing in scene.objects:
        digest.update(repr((thing.casts, thing.receives)).encode())
        digest.update(np.ascontiguousarray(thing.world_positions).tobytes())
        digest.update(np.ascontiguousarray(thing.mesh.triangles).tobytes())
    return digest.hexdigest()


def hard_errors(drawn: Run) -> dict[str, Any]:
    """Return how many pixels differ from ray casting, in all and away from edges, and the error of their visibility.

    `hard_rms` is the root of the mean square over all lights and compared pixels of visibility, 0 to 1, minus ray
    casting, 0 or 1. For a technique without half tones it is the root of the share of wrong pixels.
    """
    scene = scene_of(drawn)
    truth: Truth = remembered("hard", drawn, lambda: cast_truth(scene, drawn.size))
    seen = agreement(drawn, replace(truth, scene=scene))
    differences = [
        (light.visibility.astype(np.float64) - truth.lit(index))[seen[index].compared]
        for index, light in enumerate(drawn.lights)
    ]
    squares = np.square(np.concatenate(differences))
    return {
        "hard_compared_px": sum(int(each.compared.sum()) for each in seen),
        "hard_wrong_px": sum(int(each.wrong.sum()) for each in seen),
        "hard_wrong_off_band_px": sum(each.off_band for each in seen),
        "hard_rms": float(np.sqrt(squares.mean())) if squares.size else None,
    }


def soft_errors(drawn: Run) -> dict[str, Any]:
    """Return the error of the visible share of all lights, 0 to 1."""
    scene = scene_of(drawn)
    truth: SoftTruth = remembered("soft", drawn, lambda: soft_truth(scene, drawn.size))
    compared = drawn.compare(truth=truth)
    return {
        "soft_rms": float(compared.parts["all"].rms),
        "soft_penumbra_rms": float(compared.parts["penumbra"].rms),
        "soft_max": float(compared.parts["all"].max),
    }


def counts(drawn: Run) -> dict[str, Any]:
    """Return figures of the stencil buffer and of the work."""
    total = drawn.ledger.total
    return {
        "stencil_max": int(drawn.stencil.max()),
        "stencil_nonzero_px": int(np.count_nonzero(drawn.stencil)),
        "shadow_px": int(drawn.shadow_mask.sum()) if "visibility" in drawn.maps else None,
        "steps": len(drawn.steps),
        "draws": total.draws,
        "triangles": total.triangles,
        "fragments": total.all_fragments,
        "stencil_updates": total.stencil_updates,
    }
