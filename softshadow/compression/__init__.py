"""Compressed textures: how blocks of 4 x 4 texels become colours, bit for bit as llvmpipe samples them."""

from softshadow.compression.formats import COMPRESSED, FOR_ANY_IMAGE, CompressedFormat, decoded, read_back

__all__ = ["COMPRESSED", "FOR_ANY_IMAGE", "CompressedFormat", "decoded", "read_back"]
