"""Shared by the groups of the state: colours, and how a group is printed as GL calls."""

from typing import Any

Color = tuple[float, float, float, float]
BLACK: Color = (0.0, 0.0, 0.0, 1.0)
WHITE: Color = (1.0, 1.0, 1.0, 1.0)


def switch(capability: str, on: bool) -> str:
    """Return the call that enables or disables a capability."""
    return f"{'glEnable' if on else 'glDisable'}({capability})"


def numbers(*values: float) -> str:
    """Return numbers as the arguments of a call."""
    return ", ".join(f"{v:g}" for v in values)


def printed_calls(group: Any) -> str:
    """Return the calls of a state or group, one per line: its `__repr__`, with names in place of tokens."""
    return "\n".join(group.calls()) or "# GL's initial state"


def in_full(*groups: Any) -> str:
    """Return all fields of groups as text: equal for numbers with the same bits only, unlike their `__repr__`."""
    return repr([vars(group) for group in groups])
