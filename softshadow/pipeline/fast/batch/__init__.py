"""The geometry of many draws at once: vertices, lighting and assembly of a run of draws in two calls of kernels."""
