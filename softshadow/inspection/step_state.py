"""The GL state of a step with all that draws depend on: matrices, generated coordinates, bound textures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields

import numpy as np

from softshadow import tokens as gl
from softshadow.pipeline.commands import Clear, Command, Draw, SetSampler
from softshadow.state import State
from softshadow.texture import Sampler, initial_sampler, stored_name
from softshadow.tokens import token_name

FILTERS = ("GL_NEAREST", "GL_LINEAR", "GL_NEAREST_MIPMAP_NEAREST", "GL_LINEAR_MIPMAP_NEAREST",
           "GL_NEAREST_MIPMAP_LINEAR", "GL_LINEAR_MIPMAP_LINEAR")  # fmt: skip
PARAMETERS = {
    "min_filter": FILTERS,
    "mag_filter": FILTERS,
    "wrap_s": ("GL_REPEAT", "GL_CLAMP", "GL_CLAMP_TO_EDGE", "GL_CLAMP_TO_BORDER", "GL_MIRRORED_REPEAT"),
    "wrap_t": ("GL_REPEAT", "GL_CLAMP", "GL_CLAMP_TO_EDGE", "GL_CLAMP_TO_BORDER", "GL_MIRRORED_REPEAT"),
    "wrap_r": ("GL_REPEAT", "GL_CLAMP", "GL_CLAMP_TO_EDGE", "GL_CLAMP_TO_BORDER", "GL_MIRRORED_REPEAT"),
    "compare_mode": ("GL_NONE", "GL_COMPARE_R_TO_TEXTURE"),
    "compare_func": ("GL_NEVER", "GL_LESS", "GL_EQUAL", "GL_LEQUAL", "GL_GREATER", "GL_NOTEQUAL", "GL_GEQUAL",
                     "GL_ALWAYS"),
    "depth_mode": ("GL_LUMINANCE", "GL_INTENSITY", "GL_ALPHA", "GL_RED"),
}  # fmt: skip
TARGET_NAMES = ("GL_TEXTURE_1D", "GL_TEXTURE_2D", "GL_TEXTURE_3D", "GL_TEXTURE_RECTANGLE", "GL_TEXTURE_CUBE_MAP")
NAMES = {"compare_mode": "GL_TEXTURE_COMPARE_MODE", "compare_func": "GL_TEXTURE_COMPARE_FUNC",
         "depth_mode": "GL_DEPTH_TEXTURE_MODE"}  # fmt: skip


@dataclass(frozen=True, eq=False)
class StepState(State):
    """The state of a draw or a clear, printed as the GL calls that set it.

    Besides the groups of `State`: the matrices (4, 4), for column vectors; the samplers of the textures that units in
    use have bound, by (target, name); and the uniforms of the program in use.
    """

    modelview: np.ndarray = field(default_factory=lambda: np.eye(4))
    projection: np.ndarray = field(default_factory=lambda: np.eye(4))
    texture_matrices: tuple[np.ndarray, ...] = ()
    samplers: Mapping[tuple[int, int], Sampler] = field(default_factory=dict)
    uniforms: Mapping[str, object] = field(default_factory=dict)

    def calls(self) -> list[str]:
        """Return the GL calls that set what differs from GL's initial state."""
        group_names = [group.name for group in fields(State)]
        calls = State(**{name: getattr(self, name) for name in group_names}).calls()
        for target, name in self.samplers:
            calls += sampler_calls(target, name, self.samplers[target, name])
        calls += [f"# uniform {name} = {value}" for name, value in self.uniforms.items()]
        calls += matrix_calls("GL_PROJECTION", self.projection) + matrix_calls("GL_MODELVIEW", self.modelview)
        for unit, matrix in enumerate(self.texture_matrices):
            matrix_call = matrix_calls("GL_TEXTURE", matrix)
            calls += [f"glActiveTexture(GL_TEXTURE{unit})", *matrix_call] if matrix_call and unit else matrix_call
        return calls

    def __str__(self) -> str:
        return "\n".join(self.calls()) or "# GL's initial state"

    __repr__ = __str__


def step_state(command: Draw | Clear, earlier: Sequence[Command]) -> StepState:
    """Return the state of a command; samplers are those that the earlier commands have set."""
    groups = {group.name: getattr(command.state, group.name) for group in fields(State)}
    if isinstance(command, Clear):
        return StepState(**groups)
    last = {each.texture: each.sampler for each in earlier if isinstance(each, SetSampler)}
    samplers = {}
    for unit in command.state.units:
        for target in unit.sampled_targets if command.program_name else unit.targets:
            name = unit.bound(target)
            if name:
                samplers[target, name] = last.get(stored_name(target, name), initial_sampler(target))
    return StepState(
        **groups,
        modelview=command.modelview,
        projection=command.projection,
        texture_matrices=command.texture_matrices,
        samplers=samplers,
        uniforms=dict(command.uniforms),
    )


def matrix_calls(mode: str, matrix: np.ndarray) -> list[str]:
    """Return the calls that load a matrix, none for the identity; glLoadMatrix takes it column by column."""
    if np.array_equal(matrix, np.eye(4)):
        return []
    columns = (", ".join(f"{value:g}" for value in column) for column in np.asarray(matrix).T)
    return [f"glMatrixMode({mode})", f"glLoadMatrixf(({',  '.join(columns)}))"]


def sampler_calls(target: int, name: int, sampler: Sampler) -> list[str]:
    """Return the calls that set the parameters of a texture which differ from their initial values."""
    token, initial = token_name(target, TARGET_NAMES), initial_sampler(target)
    calls = [
        f"glTexParameteri({token}, {NAMES.get(key, f'GL_TEXTURE_{key.upper()}')}, {token_name(value, among)})"
        for key, among in PARAMETERS.items()
        if (value := getattr(sampler, key)) != getattr(initial, key)
    ]
    if gl.GL_CLAMP_TO_BORDER in (sampler.wrap_s, sampler.wrap_t, sampler.wrap_r):
        color = ", ".join(f"{channel:g}" for channel in sampler.border_color)
        calls.append(f"glTexParameterfv({token}, GL_TEXTURE_BORDER_COLOR, ({color}))")
    return [f"glBindTexture({token}, {name})", *calls]
