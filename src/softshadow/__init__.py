"""Real-time shadow algorithms on a software rasterizer, step by step."""

__version__ = "0.1.0"
