"""Real-time shadow algorithms on a software rasterizer, step by step.

Names are loaded when they are first used, so that importing the package is fast: it loads neither NumPy nor Numba.
"""

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from softshadow import gl, notebook, testing
    from softshadow.errors import (
        CallsLeftOut,
        CoarseDepth,
        CounterSaturated,
        DegenerateFaces,
        DrawsLeftOut,
        EdgeNearLight,
        FarFromOrigin,
        HistoryCut,
        InsideOutMesh,
        LightInsideCaster,
        MeshError,
        MisorientedMesh,
        NearClipZPass,
        NonManifoldMesh,
        OpenMesh,
        OutsideLightFrustum,
        PartlyReadFile,
        SceneError,
        SoftShadowError,
        StateError,
        TJunction,
        TraceError,
        UnweldedMesh,
        Warning,
    )
    from softshadow.gallery import GALLERY as failures
    from softshadow.inspection.pictures import stencil_palette
    from softshadow.inspection.soft_truth import SoftTruth, soft_truth
    from softshadow.pipeline import explain_paths, set_threads, use_short_cuts
    from softshadow.recordings import Recording, record, replay
    from softshadow.report import counting_cards, cross_section, slides
    from softshadow.runs import Run, load_run, run
    from softshadow.scene import (
        Camera,
        Disc,
        Light,
        Material,
        Mesh,
        Rectangle,
        Scene,
        SceneObject,
        Segment,
        Sphere,
        scene_names,
        shapes,
    )
    from softshadow.scene.light_samples import light_samples
    from softshadow.scene.placement import placement
    from softshadow.space import shadow_geometry
    from softshadow.sweeps import Film, SweepTable, animate, load_sweep, sweep
    from softshadow.techniques import Option, Range, Technique, describe, register
    from softshadow.techniques import names as technique_names

__version__ = "0.1.0"

__all__ = [
    "CallsLeftOut",
    "Camera",
    "CoarseDepth",
    "CounterSaturated",
    "DegenerateFaces",
    "Disc",
    "DrawsLeftOut",
    "EdgeNearLight",
    "FarFromOrigin",
    "Film",
    "HistoryCut",
    "InsideOutMesh",
    "Light",
    "LightInsideCaster",
    "Material",
    "Mesh",
    "MeshError",
    "MisorientedMesh",
    "NearClipZPass",
    "NonManifoldMesh",
    "OpenMesh",
    "Option",
    "OutsideLightFrustum",
    "PartlyReadFile",
    "Range",
    "Recording",
    "Rectangle",
    "Run",
    "Scene",
    "SceneError",
    "SceneObject",
    "Segment",
    "SoftShadowError",
    "SoftTruth",
    "Sphere",
    "StateError",
    "SweepTable",
    "TJunction",
    "Technique",
    "TraceError",
    "UnweldedMesh",
    "Warning",
    "animate",
    "counting_cards",
    "cross_section",
    "describe",
    "explain_paths",
    "failures",
    "gl",
    "light_samples",
    "load_run",
    "load_sweep",
    "notebook",
    "placement",
    "record",
    "register",
    "replay",
    "run",
    "scene_names",
    "set_threads",
    "shadow_geometry",
    "shapes",
    "slides",
    "soft_truth",
    "stencil_palette",
    "sweep",
    "technique_names",
    "testing",
    "use_short_cuts",
]

_MODULES = {
    "gl": "softshadow.gl",
    "notebook": "softshadow.notebook",
    "shapes": "softshadow.scene.shapes",
    "testing": "softshadow.testing",
}
_RENAMED = {"failures": ("softshadow.gallery", "GALLERY"), "technique_names": ("softshadow.techniques", "names")}
_HOMES = {
    "softshadow.errors": (
        "CallsLeftOut", "CoarseDepth", "CounterSaturated", "DegenerateFaces", "DrawsLeftOut", "EdgeNearLight",
        "FarFromOrigin", "HistoryCut", "InsideOutMesh", "LightInsideCaster", "MeshError", "MisorientedMesh",
        "NearClipZPass", "NonManifoldMesh", "OpenMesh", "OutsideLightFrustum", "PartlyReadFile", "SceneError",
        "SoftShadowError", "StateError", "TJunction", "TraceError", "UnweldedMesh", "Warning",
    ),
    "softshadow.inspection.pictures": ("stencil_palette",),
    "softshadow.inspection.soft_truth": ("SoftTruth", "soft_truth"),
    "softshadow.pipeline": ("explain_paths", "set_threads", "use_short_cuts"),
    "softshadow.recordings": ("Recording", "record", "replay"),
    "softshadow.report": ("counting_cards", "cross_section", "slides"),
    "softshadow.runs": ("Run", "load_run", "run"),
    "softshadow.scene": (
        "Camera", "Disc", "Light", "Material", "Mesh", "Rectangle", "Scene", "SceneObject", "Segment", "Sphere",
        "scene_names",
    ),
    "softshadow.scene.light_samples": ("light_samples",),
    "softshadow.scene.placement": ("placement",),
    "softshadow.techniques": ("Option", "Range", "Technique", "describe", "register"),
    "softshadow.space": ("shadow_geometry",),
    "softshadow.sweeps": ("Film", "SweepTable", "animate", "load_sweep", "sweep"),
}  # fmt: skip
_HOME = {name: (module, name) for module, names in _HOMES.items() for name in names} | _RENAMED


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        return importlib.import_module(_MODULES[name])
    if name not in _HOME:
        raise AttributeError(f"module 'softshadow' has no attribute {name!r}")
    module, name_there = _HOME[name]
    value = getattr(importlib.import_module(module), name_there)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
