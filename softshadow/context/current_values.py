"""The part of a context that holds the current values of vertex attributes, and those that wait to become current."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from softshadow import tokens as gl
from softshadow.context.changing_state import ChangingState
from softshadow.context.raster_position import INITIAL_RASTER_POSITION, RasterPosition
from softshadow.state import BLACK, TEXTURE_UNITS

# names of texture coordinates: the texture unit of each
UNIT_OF = {f"texcoord{unit}": unit for unit in range(TEXTURE_UNITS)}
MATERIALS = {side: f"lighting.{side}" for side in ("front", "back")}  # groups of the state


@dataclass
class CurrentVertex:
    """The current attributes of new vertices, and the raster position."""

    color: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)
    normal: tuple[float, float, float] = (0.0, 0.0, 1.0)
    texcoords: list[tuple[float, float, float, float]] = field(
        default_factory=lambda: [(0.0, 0.0, 0.0, 1.0)] * TEXTURE_UNITS
    )
    raster: RasterPosition = INITIAL_RASTER_POSITION
    edge: bool = True  # whether vertices begin an edge that glPolygonMode draws
    secondary: tuple[float, float, float, float] = BLACK
    fog_coordinate: float = 0.0
    index: float = 1.0  # of a colour, which nothing is drawn with

    @property
    def is_plain(self) -> bool:
        """Whether edge flag, secondary colour and fog coordinate have their first values: then no vertex needs them."""
        return self.edge and self.secondary == BLACK and not self.fog_coordinate


class CurrentValues(ChangingState):
    """The current values of a context, by name: those of `CurrentVertex`, "texcoord0", "front.diffuse" ...

    Attributes
    ----------
    touched : int                bits of the attribute groups that calls have marked as changed since the last push
    """

    current: CurrentVertex
    touched: int

    def attribute(self, name: str) -> Any:
        """Return a current value by its name: "color", "normal", "texcoord0", "front.diffuse" ..."""
        current = self.current.__dict__
        if name in current:
            return current[name]
        if name in UNIT_OF:
            return current["texcoords"][UNIT_OF[name]]
        side, _, field = name.partition(".")
        return self._material(side, field)[field]

    def set_attribute(self, name: str, value: Any) -> None:
        """Set a current value by its name, without drawing the collected vertices first."""
        current = self.current.__dict__
        if name in current:
            current[name] = value
        elif name in UNIT_OF:
            current["texcoords"][UNIT_OF[name]] = value
        else:
            side, _, material = name.partition(".")
            self.set_material(side, material, value)

    def set_material(self, side: str, field: str, value: Any) -> None:
        """Set a field of the "front" or "back" material, without drawing the collected vertices first."""
        self._material(side, field)[field] = value
        self.changed.add(self.groups[MATERIALS[side]])

    def _material(self, side: str, field: str) -> dict[str, Any]:
        """Return the fields of the "front" or "back" material, of which `field` has its value.

        Others may still follow a colour. As long as they do, draws that differ in this colour have the same state.
        """
        followed = self.state_groups.followed
        if followed is not None and field in followed[1] and side in followed[0]:
            self._settle()
        return self.groups[MATERIALS[side]].fields

    def follow(self, sides: tuple[str, ...], fields: tuple[str, ...]) -> None:
        """Copy the current colour to fields of the materials that follow it, without drawing the collected vertices."""
        state = self.state_groups
        if state.followed is not None and state.followed[:2] != (sides, fields):
            state.settle()
        if self.pending.before_following is None:
            self.pending.before_following = state.followed or {
                f"{side}.{field}": self._material(side, field)[field] for side in sides for field in fields
            }
        state.followed = sides, fields, self.current.color

    def stop_following(self) -> None:
        """Give the materials the values that they had when the present colour was Mesa's current one."""
        before, self.pending.before_following, self.pending.settled = self.pending.before_following, None, None
        if isinstance(before, tuple):
            self.state_groups.followed = before
        elif before is not None:
            self.state_groups.followed = None
            for name, value in before.items():
                self.set_attribute(name, value)

    def remember_attribute(self, name: str) -> None:
        """Remember the current value of an attribute that is about to be set."""
        pending = self.pending
        if name not in pending.old_values:
            pending.names.add(name)
            pending.old_values[name] = self.attribute(name)
            pending.hidden.pop(name, None)

    def update_current(self) -> None:
        """Make pending attributes current, as queries of current values do (Mesa's FLUSH_CURRENT)."""
        if self.pending.old_values:
            hidden = dict(self.pending.hidden)
            self._make_pending_current()
            self.pending.reset_due, self.ready = True, False
            self.pending.hidden = hidden  # vertices carry it still, so it returns

    def reset_attributes(self) -> None:
        """Make pending attributes current; the vertices that follow do not carry them (Mesa's vbo_reset_all_attr)."""
        self._make_pending_current()
        self.pending.names.clear()
        self.pending.reset_due = self.pending.has_vertices = False

    def _make_pending_current(self) -> None:
        pending = self.pending
        pending.before_following = None
        if pending.hidden:
            self._make_hidden_current()
        old_values = pending.old_values
        if old_values:
            for name, old_value in old_values.items():
                bit = gl.GL_LIGHTING_BIT if "." in name else gl.GL_CURRENT_BIT
                if not self.touched & bit and (old_value != self.attribute(name) or name in pending.never_set):
                    self.touched |= bit
                if name in pending.never_set:
                    pending.never_set -= {name}
            old_values.clear()
            pending.settled = None
            if self.vertex_buffer.paused is not None:  # its next attributes are pending again
                self.vertex_buffer.paused.steady.clear()

    def _make_hidden_current(self) -> None:
        pending, color = self.pending, self.current.color
        follows = self.groups["lighting"].fields["color_material"]
        followed = (self.state_groups.followed or pending.settled) if follows else None
        self._settle()
        for name, value in pending.hidden.items():
            pending.old_values.setdefault(name, self.attribute(name))
            self.set_attribute(name, value)
        if followed is not None and pending.old_values.get("color", color) != color:
            self.state_groups.followed = followed  # a new colour comes after the materials
        pending.hidden.clear()
