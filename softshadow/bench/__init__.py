"""Benchmarks: how long a program takes here, on Mesa, and against what the machine can do."""
