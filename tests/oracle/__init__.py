"""Oracles: slow, plain reimplementations that share no code with the package."""
