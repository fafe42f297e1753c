"""Visibility of a light by a filtered map: what the mean around a place tells about the depths it was made of.

"variance-visibility" has the mean of depths and of squared depths, hence the variance, and returns an upper bound of
the share of texels that are at least as far as the receiver (Chebyshev's inequality, one-sided).
"exponential-visibility" has the mean of powers, which the farthest texels dominate; divided by the receiver's own power
it is their share, if no texel is farther than the receiver.

References: Donnelly & Lauritzen 2006, "Variance shadow maps", eq. 5; Annen et al. 2008, "Exponential shadow maps".
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from softshadow.programs.fog import exp2
from softshadow.programs.map_visibility import VERTEX, vertex
from softshadow.programs.program import Program
from softshadow.programs.reads import note_depths
from softshadow.programs.sampling import sample

# texture coordinates (N, 4), texels (N, 4), depths (N,), uniforms -> three channels: two for inspection, the visibility
Lookup = Callable[[np.ndarray, np.ndarray, Mapping[str, Any]], tuple[Any, Any, np.ndarray]]

FRAGMENT = """#version 120
uniform sampler2D shadowMap;
uniform float bias;
uniform float behind;  // visibility behind the light
uniform float cone;    // squared radius of a spot light's disc in the map
UNIFORMS
varying vec4 texCoord;

void main()
{
    vec2 place = texCoord.st / texCoord.q;
    vec4 texel = texture2D(shadowMap, place);
    float depth = min(texCoord.p - bias, 1.0);  // beyond the far plane as on it
    BODY
    vec2 off = place - 0.5;
    if (off.s * off.s + off.t * off.t > cone)
        visible = 0.0;
    gl_FragColor = texCoord.q > 0.0 ? vec4(SHOWN, 0.0, visible) : vec4(0.0, 0.0, 0.0, behind);
}
"""

VARIANCE = """
    float mean = texel.r;
    float variance = max(texel.g - mean * mean, leastVariance);
    float beyond = depth - mean;
    float bound = variance / (variance + beyond * beyond);
    float reduced = clamp((bound - bleed) / (1.0 - bleed), 0.0, 1.0);
    float visible = beyond > 0.0 ? reduced : 1.0;"""

EXPONENTIAL = """
    float share = texel.r * exp2(-(steepness * depth));
    float visible = clamp(share, 0.0, 1.0);"""


def visibility_by(look_up: Lookup) -> Callable[[np.ndarray, Mapping[str, Any], np.ndarray], None]:
    """Return a fragment stage that fills `out` (N, 4) with two channels to look at, 0, and the visibility."""

    def shade(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
        real = inputs.dtype.type
        place, texels = np.zeros((len(inputs), 3), inputs.dtype, order="F"), np.empty_like(out, order="F")
        with np.errstate(all="ignore"):  # q = 0 gives infinities, as in GL
            np.divide(inputs[:, :2], inputs[:, 3:], out=place[:, :2])
            depth = np.minimum(inputs[:, 2] - real(uniforms["bias"]), real(1))
            note_depths(uniforms["shadowMap"], depth, uniforms["bias"])
            sample(uniforms["shadowMap"], place, texels)
            out[:, 0], out[:, 1], visible = look_up(texels, depth, uniforms)
            off = place[:, :2] - real(0.5)
            visible[off[:, 0] * off[:, 0] + off[:, 1] * off[:, 1] > real(uniforms["cone"])] = 0
        out[:, 2], out[:, 3] = 0, visible
        out[~(inputs[:, 3] > 0)] = (0, 0, 0, uniforms["behind"])

    return shade


def by_variance(
    texels: np.ndarray, depth: np.ndarray, uniforms: Mapping[str, Any]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return mean, variance and bound (N,) by the moments around each place."""
    real, mean = depth.dtype.type, texels[:, 0]
    variance = np.maximum(texels[:, 1] - mean * mean, real(uniforms["leastVariance"]))
    beyond, bleed = depth - mean, real(uniforms["bleed"])
    bound = variance / (variance + beyond * beyond)
    reduced = np.clip((bound - bleed) / (real(1) - bleed), real(0), real(1))
    return mean, variance, np.where(beyond > 0, reduced, real(1))


def by_exponential(
    texels: np.ndarray, depth: np.ndarray, uniforms: Mapping[str, Any]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the mean power, its quotient with the receiver's, and that within [0, 1]; each (N,)."""
    real = depth.dtype.type
    share = texels[:, 0] * exp2(-(real(uniforms["steepness"]) * depth))
    return texels[:, 0], share, np.clip(share, real(0), real(1))


def _program(name: str, look_up: Lookup, body: str, shown: str, **own: float) -> Program:
    declarations = "\n".join(f"uniform float {uniform};" for uniform in own)
    return Program(
        name,
        vertex,
        visibility_by(look_up),
        uniforms={"shadowMap": 0, "bias": 0.0, "behind": 1.0, "cone": float("inf"), **own},
        samplers=("shadowMap",),
        glsl_vertex=VERTEX,
        glsl_fragment=(
            FRAGMENT.replace("UNIFORMS", declarations).replace("BODY", body.strip()).replace("SHOWN", shown)
        ),
    )


VARIANCE_VISIBILITY = _program(
    "variance-visibility", by_variance, VARIANCE, "mean, variance", leastVariance=0.0, bleed=0.0
)
EXPONENTIAL_VISIBILITY = _program(
    "exponential-visibility", by_exponential, EXPONENTIAL, "texel.r, share", steepness=1.0
)
