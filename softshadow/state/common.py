"""What the groups of the state share: colours, and how they print as GL calls."""

Color = tuple[float, float, float, float]
BLACK: Color = (0.0, 0.0, 0.0, 1.0)
WHITE: Color = (1.0, 1.0, 1.0, 1.0)


def switch(capability: str, on: bool) -> str:
    """Return the call that switches a capability on or off."""
    return f"{'glEnable' if on else 'glDisable'}({capability})"


def numbers(*values: float) -> str:
    """Return the arguments of a call."""
    return ", ".join(f"{v:g}" for v in values)
