"""Fixed-function lighting: GL's equation by example, and the bits of Mesa's vertex program under all its settings."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mesa_points import load, same_bits, vertices_on_mesa
from softshadow import tokens as gl
from softshadow.programs import VertexInputs
from softshadow.programs.lighting import light_vertices
from softshadow.state import INITIAL_LIGHTS, Lighting, LightState, MaterialState

COUNT = 200
IDENTITY = np.eye(4, dtype=np.float32)
MATERIAL = MaterialState(
    (0.3, 0.4, 0.5, 1.0), (0.7, 0.6, 0.5, 0.8), (0.9, 0.8, 0.7, 1.0), (0.05, 0.02, 0.01, 1.0), 20.0
)
COLORS = {"ambient": (0.1, 0.2, 0.05, 1.0), "diffuse": (0.5, 0.4, 0.6, 1.0), "specular": (0.3, 0.5, 0.4, 1.0)}
LIGHTS = {
    "directional": LightState(True, **COLORS, position=(1.0, 2.0, 3.0, 0.0)),
    "positional": LightState(True, **COLORS, position=(1.0, 2.0, 3.0, 2.0)),
    "attenuated": LightState(
        True, **COLORS, position=(1.0, 2.0, 3.0, 2.0),
        constant_attenuation=0.5, linear_attenuation=0.1, quadratic_attenuation=0.05,
    ),
    "spot": LightState(
        True, **COLORS, position=(1.0, 2.0, 3.0, 1.0),
        spot_direction=(-0.3, -0.6, -0.9), spot_exponent=3.0, spot_cutoff=70.0, linear_attenuation=0.2,
    ),
}  # fmt: skip


def with_lights(*lights: LightState, **settings: Any) -> Lighting:
    settings.setdefault("front", MATERIAL)
    return Lighting(enabled=True, lights=(*lights, *INITIAL_LIGHTS[len(lights) :]), **settings)


def vertices(modelview: np.ndarray = IDENTITY, seed: int = 31) -> VertexInputs:
    rng = np.random.default_rng(seed)
    position = rng.normal(0, 2, (COUNT, 4)).astype(np.float32)
    position[:, 3] = 1
    normal = rng.normal(size=(COUNT, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    color = rng.random((COUNT, 4), np.float32)
    return VertexInputs(position, color, normal.astype(np.float32), (), modelview, IDENTITY, (), {})


def towards(lighting: Lighting, normal: tuple[float, float, float], position=(0, 0, 0, 1)) -> np.ndarray:
    """Return the colour (4,) of one vertex."""
    one = VertexInputs(
        np.float32([position]), np.float32([[0.2, 0.4, 0.6, 0.8]]), np.float32([normal]), (), IDENTITY, IDENTITY, (), {}
    )
    return light_vertices(lighting, one)[0].primary[0]


def test_a_facing_surface_gets_ambient_and_full_diffuse():
    light = LightState(True, (0.1, 0.1, 0.1, 1), (0.5, 0.5, 0.5, 1), (0, 0, 0, 1), (0, 0, 1, 0))
    lighting = with_lights(light, front=MaterialState((0.5, 0.5, 0.5, 1), (0.8, 0.4, 0.2, 0.7)))
    # ambient 0.2 * 0.5 + 0.1 * 0.5, diffuse 0.5 * (0.8, 0.4, 0.2); alpha is the material's diffuse alpha
    assert np.allclose(towards(lighting, (0, 0, 1)), (0.55, 0.35, 0.25, 0.7))
    assert np.allclose(towards(lighting, (0, 0, -1)), (0.15, 0.15, 0.15, 0.7))


def test_colour_material_takes_the_current_colour():
    light = replace(LIGHTS["directional"], ambient=(0, 0, 0, 1), specular=(0, 0, 0, 1), position=(0, 0, 1, 0))
    lighting = with_lights(
        light, model_ambient=(0, 0, 0, 1), color_material=True, color_material_mode=gl.GL_DIFFUSE,
        front=replace(MATERIAL, emission=(0, 0, 0, 1)),
    )  # fmt: skip
    assert np.allclose(towards(lighting, (0, 0, 1)), (0.5 * 0.2, 0.4 * 0.4, 0.6 * 0.6, 0.8))


def test_distance_divides_a_positional_light():
    light = LightState(True, (0, 0, 0, 1), (1, 1, 1, 1), (0, 0, 0, 1), (0, 0, 2, 1), quadratic_attenuation=1.0)
    lighting = with_lights(light, model_ambient=(0, 0, 0, 1), front=MaterialState(diffuse=(1, 1, 1, 1)))
    assert np.allclose(towards(lighting, (0, 0, 1))[:3], 1 / (1 + 4))


def test_outside_the_cone_of_a_spot_light_it_is_dark():
    light = LightState(
        True, (0, 0, 0, 1), (1, 1, 1, 1), (0, 0, 0, 1), (0, 0, 2, 1), spot_direction=(0, 0, -1), spot_cutoff=30.0
    )
    lighting = with_lights(light, model_ambient=(0, 0, 0, 1), front=MaterialState(diffuse=(1, 1, 1, 1)))
    assert towards(lighting, (0, 0, 1))[0] == 1
    assert towards(lighting, (0, 0, 1), (2, 0, 0, 1))[0] == 0


def test_the_back_side_is_lit_with_the_opposite_normal():
    lighting = with_lights(*LIGHTS.values(), two_side=True, back=MATERIAL)
    inputs = vertices()
    _, back = light_vertices(lighting, inputs)
    turned, _ = light_vertices(lighting, replace(inputs, normal=-inputs.normal))
    assert back is not None
    assert same_bits(back.primary, turned.primary)


def test_a_separate_highlight_is_what_the_single_colour_has_more():
    settings = {"front": replace(MATERIAL, emission=(0, 0, 0, 1))}
    single, _ = light_vertices(with_lights(LIGHTS["positional"], **settings), vertices())
    apart, _ = light_vertices(
        with_lights(LIGHTS["positional"], color_control=gl.GL_SEPARATE_SPECULAR_COLOR, **settings), vertices()
    )
    assert apart.secondary is not None
    # one rounding more or less, and both sums are clamped
    assert np.allclose(np.minimum(apart.primary[:, :3] + apart.secondary, 1), single.primary[:, :3], atol=1e-6)


def lit_on_mesa(lighting: Lighting, inputs: VertexInputs) -> np.ndarray:
    """Return the primary colours (V, 4) of Mesa's vertex program; light positions are in eye space."""

    def setup(on: Any) -> None:
        load(on, on.GL_MODELVIEW, IDENTITY)
        on.glEnable(on.GL_LIGHTING)
        for index, light in enumerate(lighting.lights):
            if light.enabled:
                set_light(on, getattr(on, f"GL_LIGHT{index}"), light)
        set_material(on, on.GL_FRONT, lighting.front)
        set_material(on, on.GL_BACK, lighting.back)
        on.glLightModelfv(on.GL_LIGHT_MODEL_AMBIENT, lighting.model_ambient)
        on.glLightModeli(on.GL_LIGHT_MODEL_LOCAL_VIEWER, int(lighting.local_viewer))
        on.glLightModeli(on.GL_LIGHT_MODEL_TWO_SIDE, int(lighting.two_side))
        on.glLightModeli(on.GL_LIGHT_MODEL_COLOR_CONTROL, lighting.color_control)
        for capability, enabled in (
            (on.GL_NORMALIZE, lighting.normalize),
            (on.GL_RESCALE_NORMAL, lighting.rescale_normal),
            (on.GL_COLOR_MATERIAL, lighting.color_material),
        ):
            if enabled:
                on.glColorMaterial(lighting.color_material_face, lighting.color_material_mode)
                on.glEnable(capability)

    arrays = {"vertex": inputs.position, "color": inputs.color, "normal": inputs.normal}
    return vertices_on_mesa(setup, arrays, inputs.modelview)[0]


def set_light(on: Any, name: int, light: LightState) -> None:
    on.glEnable(name)
    for parameter in ("ambient", "diffuse", "specular", "position", "spot_direction"):
        on.glLightfv(name, getattr(on, f"GL_{parameter.upper()}"), getattr(light, parameter))
    for parameter in ("spot_exponent", "spot_cutoff"):
        on.glLightf(name, getattr(on, f"GL_{parameter.upper()}"), getattr(light, parameter))
    for kind in ("constant", "linear", "quadratic"):
        on.glLightf(name, getattr(on, f"GL_{kind.upper()}_ATTENUATION"), getattr(light, f"{kind}_attenuation"))


def set_material(on: Any, face: int, material: MaterialState) -> None:
    for parameter in ("ambient", "diffuse", "specular", "emission"):
        on.glMaterialfv(face, getattr(on, f"GL_{parameter.upper()}"), getattr(material, parameter))
    on.glMaterialf(face, on.GL_SHININESS, material.shininess)


def rotation_with(scale: tuple[float, float, float]) -> np.ndarray:
    q, _ = np.linalg.qr(np.random.default_rng(33).normal(size=(3, 3)))
    matrix = np.eye(4)
    matrix[:3, :3] = q * np.sign(np.linalg.det(q)) * scale
    matrix[:3, 3] = (0.3, -0.2, -3)
    return matrix.astype(np.float32)


MODELVIEWS = {
    "identity": IDENTITY,
    "rotated": rotation_with((1, 1, 1)),
    "scaled": rotation_with((1.5, 0.5, 2)),
}
VARIANTS: dict[str, Callable[..., Lighting]] = {
    "plain": with_lights,
    "dull": lambda *lights: with_lights(*lights, front=replace(MATERIAL, shininess=0.0)),
    "normalized, local viewer": lambda *lights: with_lights(*lights, normalize=True, local_viewer=True),
    "rescaled": lambda *lights: with_lights(*lights, rescale_normal=True),
    "colour material": lambda *lights: with_lights(*lights, color_material=True),
    "emission tracked": lambda *lights: with_lights(
        *lights, color_material=True, color_material_face=gl.GL_FRONT, color_material_mode=gl.GL_EMISSION
    ),
    "separate highlight": lambda *lights: with_lights(*lights, color_control=gl.GL_SEPARATE_SPECULAR_COLOR),
    "two-sided": lambda *lights: with_lights(*lights, two_side=True, back=replace(MATERIAL, shininess=3.0)),
}


@pytest.mark.thin(5)
@pytest.mark.mesa
@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("kind", MODELVIEWS)
def test_lighting_is_mesas(kind, variant):
    inputs = vertices(MODELVIEWS[kind])
    for lights in ([light] for light in LIGHTS.values()):
        lighting = VARIANTS[variant](*lights)
        assert same_bits(light_vertices(lighting, inputs)[0].primary, lit_on_mesa(lighting, inputs)), lights
    lighting = VARIANTS[variant](*LIGHTS.values())
    assert same_bits(light_vertices(lighting, inputs)[0].primary, lit_on_mesa(lighting, inputs))
