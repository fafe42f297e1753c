"""Benchmarks: how long programs take on softshadow and on Mesa, and how close that is to the limits of the machine."""
