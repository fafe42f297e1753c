"""The errors and warnings of softshadow. A message says what was wrong, where, and what was expected."""

import builtins
import difflib
from collections.abc import Iterable


class SoftShadowError(Exception):
    """Base of all errors that a user's input can cause."""


class SceneError(SoftShadowError):
    """A scene or scene file is wrong: names the file, the key and what was expected."""


class MeshError(SceneError):
    """A model file or mesh is not usable: names the file and what was expected."""


class StateError(SoftShadowError):
    """The operation is not possible in the current GL state or with this buffer."""


class TraceError(SoftShadowError):
    """A trace file is damaged or incomplete: names the place in the file and the last call that was read."""


class Warning(builtins.UserWarning):
    """Base of all warnings: input that is legal but will look wrong."""


class OpenMesh(Warning):
    """A caster has boundary edges: every face casts, turned towards the light."""


class TJunction(Warning):
    """Vertices of a caster lie within boundary edges: single pixels along these edges may leak light or shadow."""


class UnweldedMesh(Warning):
    """Boundary vertices of a caster nearly coincide: the mesh is open only because their positions differ slightly."""


class NonManifoldMesh(Warning):
    """More than two faces of a caster share an edge."""


class MisorientedMesh(Warning):
    """Neighbouring faces of a caster disagree about the outside: every face casts, turned towards the light."""


class DegenerateFaces(Warning):
    """A caster has triangles without area: they are not drawn and cast nothing."""


class FarFromOrigin(Warning):
    """The coordinates of a caster are much larger than the caster: float32 keeps few digits of its shape."""


class LightInsideCaster(Warning):
    """A light is inside a closed caster: volumes let its light out, shadow maps and rays keep it in."""


class InsideOutMesh(Warning):
    """The triangles of a closed caster are clockwise seen from outside."""


class PartlyReadFile(Warning):
    """Parts of a model file were left out: says which and why."""


class NearClipZPass(Warning):
    """The near rectangle lies in a shadow volume or cuts one: z-pass starts counting from a wrong value there."""


class OutsideLightFrustum(Warning):
    """A point light stands among its casters: whatever its single shadow map does not cover counts as lit."""


class EdgeNearLight(Warning):
    """An area light is so near to the line of a silhouette edge that the edge's penumbra wedge is all of space."""


class CounterSaturated(Warning):
    """A stencil count reached its largest value, or wrapped round to 0: larger counts are lost."""


class CoarseDepth(Warning):
    """The camera's near plane is so close that the depth buffer cannot tell the surfaces of the scene apart."""


class DrawsLeftOut(Warning):
    """The picture of a replayed program lacks draws: says which, and why."""


class CallsLeftOut(Warning):
    """A program's calls could not be carried out, or would show something else on a screen: says which, and why."""


class HistoryCut(Warning):
    """A recording has been bounded and has dropped its earliest commands: answers begin after them."""


def nearest(name: str, choices: Iterable[str]) -> str:
    """Return the end of an "unknown name" message: the nearest choice, ignoring case, and the list of choices.

    Examples
    --------
    >>> nearest("volume-zfial", ["planar", "volume-zfail"])
    "did you mean 'volume-zfail'? (there are: planar, volume-zfail)"
    >>> nearest("teapot", ["planar", "volume-zfail"])
    'expected one of planar, volume-zfail'
    """
    names = list(choices)
    listed = ", ".join(names)
    spelled = {each.lower(): each for each in names}
    close = difflib.get_close_matches(name.lower(), spelled, n=1, cutoff=0.5)
    return f"did you mean {spelled[close[0]]!r}? (there are: {listed})" if close else f"expected one of {listed}"
