"""Compressed textures: how blocks of 4 x 4 texels become colours, bit for bit as llvmpipe samples them, and back."""

from softshadow.compression.formats import (
    COMPRESSED,
    FOR_ANY_IMAGE,
    UNCOMPRESSED,
    CompressedFormat,
    chosen_format,
    decoded,
    encoded,
    read_back,
)

__all__ = [
    "COMPRESSED",
    "FOR_ANY_IMAGE",
    "UNCOMPRESSED",
    "CompressedFormat",
    "chosen_format",
    "decoded",
    "encoded",
    "read_back",
]
