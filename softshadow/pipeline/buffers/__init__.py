"""Commands that change buffers and objects without drawing primitives."""
