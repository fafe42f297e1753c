"""Visibility of an area light by one shadow map: the share of lit comparisons in a region as wide as the penumbra.

The width of a penumbra follows from three distances along the light's view: light to blocker, light to receiver, and
the light's own size. "soft-visibility" finds the blocker first, as the mean distance of all texels nearer than the
receiver in the region of the map through which the light can be seen, and then compares at points of a region of that
width.

The n² points of a region are those of a grid, each moved within its cell so that no two have the same s or t: by the
number of its row along s, and of its column along t, in steps of `stride` (Chiu, Shirley & Wang 1994, "Multi-jittered
sampling", without the jitter). So edges of all directions give more than n steps.

All comparisons are with the plane of the receiver, which `dFdx` and `dFdy` give: window depth is an affine function of
the place in the map, so a flat receiver does not shadow itself in a region of any width. A side that is turned away
from the light is compared by its depth alone, because the light sees other surfaces there.

References: Fernando 2005, "Percentage-closer soft shadows"; Isidoro 2006, "Shadow mapping: GPU-based tips and
techniques" (receiver plane depth bias).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from softshadow.programs.map_visibility import VERTEX, vertex
from softshadow.programs.program import Program
from softshadow.programs.reads import note_depths
from softshadow.programs.sampling import divide, sample

STEEPEST = 1e6  # of a receiver's plane, in window depths per side of the map; seen edge-on it would be infinite

FRAGMENT = """#version 120
uniform sampler2D shadowMap;
uniform vec3 lightU;   // half axes of the light, along right, up and view of its camera;
uniform vec3 lightV;   // at distance 1 the side of the map has length 1
uniform int disc;      // 1: only points within the ellipse of the half axes
uniform float size;    // width of the light in world units
uniform float near;    // planes of the light's camera
uniform float far;
uniform int parallel;  // 1: orthographic
uniform int search;    // points on a side of the region of the blockers
uniform int taps;      // and of the region that is as wide as the penumbra
uniform int searchStride;
uniform int tapsStride;
uniform float bias;
uniform float behind;  // visibility behind the light
uniform float cone;    // squared radius of a spot light's disc in the map
varying vec4 texCoord;

float distanceAt(float depth)
{
    float range = far - near;
    return parallel == 1 ? near + depth * range : near * far / (far - depth * range);
}

float onLight(int i, int j, int n, int stride)  // from -1 to 1: in part i of n, at one of its n places
{
    float place = (mod(float(j * stride), float(n)) + 0.5) / float(n);
    return 2.0 * (float(i) + place) / float(n) - 1.0;
}

void main()
{
    vec3 projected = texCoord.stp / texCoord.q;
    float depth = min(projected.p - bias, 1.0);  // beyond the far plane as on it
    float own = parallel == 1 ? near + projected.p * (far - near) : texCoord.q;

    vec3 x = dFdx(projected);
    vec3 y = dFdy(projected);
    float area = x.s * y.t - x.t * y.s;
    vec2 slope = vec2(0.0);
    if (area > 0.0) {  // the camera sees the side that the light sees
        slope.s = clamp((x.p * y.t - x.t * y.p) / area, -STEEPEST, STEEPEST);
        slope.t = clamp((x.s * y.p - x.p * y.s) / area, -STEEPEST, STEEPEST);
    }

    float blockers = 0.0;
    float sum = 0.0;
    float reach = max(1.0 / near - 1.0 / own, 0.0);
    for (int j = 0; j < search; j++)
        for (int i = 0; i < search; i++) {
            float a = onLight(i, j, search, searchStride);
            float b = onLight(j, i, search, searchStride);
            vec2 off = (a * lightU.st + b * lightV.st) * reach;
            float stored = texture2D(shadowMap, projected.st + off).r;
            bool lit = min(depth + off.s * slope.s + off.t * slope.t, 1.0) <= stored;
            if (!lit && (disc == 0 || a * a + b * b <= 1.0)) {
                blockers += 1.0;
                sum += distanceAt(stored);
            }
        }

    float blocker = 0.0;
    float width = 0.0;
    float visible = 1.0;
    if (blockers > 0.0) {
        blocker = sum / blockers;
        width = size * (max(own - blocker, 0.0) / blocker);
        reach = max(1.0 / blocker - 1.0 / own, 0.0);
        float compared = 0.0;
        float passed = 0.0;
        for (int j = 0; j < taps; j++)
            for (int i = 0; i < taps; i++) {
                float a = onLight(i, j, taps, tapsStride);
                float b = onLight(j, i, taps, tapsStride);
                vec2 off = (a * lightU.st + b * lightV.st) * reach;
                float stored = texture2D(shadowMap, projected.st + off).r;
                bool lit = min(depth + off.s * slope.s + off.t * slope.t, 1.0) <= stored;
                if (disc == 0 || a * a + b * b <= 1.0) {
                    compared += 1.0;
                    passed += lit ? 1.0 : 0.0;
                }
            }
        visible = passed / compared;
    }

    vec2 off = projected.st - 0.5;
    if (off.s * off.s + off.t * off.t > cone)
        visible = 0.0;
    gl_FragColor = texCoord.q > 0.0 ? vec4(blocker, width, blockers, visible) : vec4(0.0, 0.0, 0.0, behind);
}
""".replace("STEEPEST", f"{STEEPEST:.1f}")


def shade(inputs: np.ndarray, uniforms: Mapping[str, Any], out: np.ndarray) -> None:
    """Fill `out` (N, 4): mean distance of the blockers, width of the penumbra, number of blockers, visibility."""
    real = inputs.dtype.type
    one, zero = real(1), real(0)
    with np.errstate(all="ignore"):  # q = 0 gives infinities, as in GL
        projected = divide(inputs)
        distance_at = distances(uniforms, real)
        own = distance_at(projected[:, 2]) if uniforms["parallel"] else inputs[:, 3]
        plane = np.empty((len(inputs), 5), inputs.dtype, order="F")  # s and t; depth there and its slopes
        plane[:, :2] = projected[:, :2]
        plane[:, 2] = np.minimum(projected[:, 2] - real(uniforms["bias"]), one)
        plane[:, 3:] = plane_slopes(projected)

        blockers, total = np.zeros_like(own), np.zeros_like(own)
        reach = np.maximum(one / real(uniforms["near"]) - one / own, zero)
        for lit, stored in comparisons(plane, reach, uniforms, "search", None):
            blockers += ~lit
            total += np.where(lit, zero, distance_at(stored))

        shadowed = np.flatnonzero(blockers)
        own, blocker = own[shadowed], total[shadowed] / blockers[shadowed]
        reach = np.maximum(one / blocker - one / own, zero)
        compared, passed = 0, np.zeros_like(own)
        for lit, _ in comparisons(plane[shadowed], reach, uniforms, "taps", shadowed):
            compared += 1
            passed += lit

        out[:, 0], out[:, 1], out[:, 2], out[:, 3] = 0, 0, blockers, 1
        out[shadowed, 0] = blocker
        out[shadowed, 1] = real(uniforms["size"]) * (np.maximum(own - blocker, zero) / blocker)
        out[shadowed, 3] = passed / real(max(compared, 1))
        off = projected[:, :2] - real(0.5)
        out[off[:, 0] * off[:, 0] + off[:, 1] * off[:, 1] > real(uniforms["cone"]), 3] = 0
        out[~(inputs[:, 3] > 0)] = (0, 0, 0, uniforms["behind"])


def distances(uniforms: Mapping[str, Any], real: Any) -> Callable[[np.ndarray], np.ndarray]:
    """Return the function from window depth in the map to distance along the view of the light's camera."""
    near, far = real(uniforms["near"]), real(uniforms["far"])
    if uniforms["parallel"]:
        return lambda depth: near + depth * (far - near)
    return lambda depth: near * far / (far - depth * (far - near))


def plane_slopes(projected: np.ndarray) -> np.ndarray:
    """Return (N, 2) how window depth changes with s and t on the plane of each pixel; N is that of 2x2 blocks.

    The columns of `projected` are s, t and depth. Derivatives are differences in the row and the column of a block. The
    slopes are 0 where the map's picture of the plane is mirrored in the window: the light sees its other side.
    """
    blocks = projected.reshape(-1, 2, 2, 3)
    x = np.broadcast_to(blocks[:, :, 1:] - blocks[:, :, :1], blocks.shape).reshape(-1, 3).T
    y = np.broadcast_to(blocks[:, 1:] - blocks[:, :1], blocks.shape).reshape(-1, 3).T
    area = x[0] * y[1] - x[1] * y[0]
    slopes = np.stack([(x[2] * y[1] - x[1] * y[2]) / area, (x[0] * y[2] - x[2] * y[0]) / area], axis=1)
    steepest = projected.dtype.type(STEEPEST)
    limited: np.ndarray = np.where(area[:, None] > 0, np.clip(slopes, -steepest, steepest), 0)
    return limited


def comparisons(
    plane: np.ndarray, reach: np.ndarray, uniforms: Mapping[str, Any], region: str, rows: np.ndarray | None
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield for each point of a region whether it is lit (N,), and the depth stored there (N,).

    Parameters
    ----------
    plane : (N, 5)               s, t, depth, and the slopes of depth in s and t
    reach : (N,)                 the region's size, in that of the light
    region : str                 the uniform that has the number of points on a side: "search" or "taps"
    rows : (N,) or None          which fragments they are; None for all
    """
    real, side, stride = plane.dtype.type, uniforms[region], uniforms[f"{region}Stride"]
    s, t, depth, s_slope, t_slope = plane.T
    u, v = (np.array(uniforms[name][:2], plane.dtype) for name in ("lightU", "lightV"))
    place, stored = np.zeros((len(plane), 3), plane.dtype, order="F"), np.empty((len(plane), 1), plane.dtype)
    for j in range(side):
        for i in range(side):
            a, b = real(on_light(i, j, side, stride)), real(on_light(j, i, side, stride))
            if uniforms["disc"] and a * a + b * b > 1:
                continue
            s_off, t_off = (a * u[0] + b * v[0]) * reach, (a * u[1] + b * v[1]) * reach
            place[:, 0], place[:, 1] = s + s_off, t + t_off
            own = np.minimum(depth + s_off * s_slope + t_off * t_slope, real(1))
            note_depths(uniforms["shadowMap"], own, uniforms["bias"], rows=rows, purpose=region)
            sample(uniforms["shadowMap"], place, stored)
            yield own <= stored[:, 0], stored[:, 0]


def on_light(i: int, j: int, n: int, stride: int) -> np.float32:
    """Return a coordinate from -1 to 1: in part i of n equal parts, at one of its n places, which depends on j."""
    place = np.float32(j * stride % n + 0.5) / np.float32(n)
    return np.float32(2) * (np.float32(i) + place) / np.float32(n) - np.float32(1)


SOFT_VISIBILITY = Program(
    "soft-visibility",
    vertex,
    shade,
    uniforms={
        "shadowMap": 0,
        "lightU": (0.0, 0.0, 0.0),
        "lightV": (0.0, 0.0, 0.0),
        "disc": 0,
        "size": 0.0,
        "near": 1.0,
        "far": 2.0,
        "parallel": 0,
        "search": 1,
        "taps": 1,
        "searchStride": 1,
        "tapsStride": 1,
        "bias": 0.0,
        "behind": 1.0,
        "cone": float("inf"),
    },
    samplers=("shadowMap",),
    blocks=True,
    glsl_vertex=VERTEX,
    glsl_fragment=FRAGMENT,
)
