"""The state of colour index buffers, which nothing is drawn to."""

from __future__ import annotations

from dataclasses import dataclass

ALL_BITS = 0xFFFFFFFF


@dataclass(frozen=True)
class ColorIndices:
    """Clear value and write mask, unsigned integers of 32 bits, and whether GL_INDEX_LOGIC_OP is enabled."""

    clear: int = 0
    write_mask: int = ALL_BITS
    logic_enabled: bool = False
