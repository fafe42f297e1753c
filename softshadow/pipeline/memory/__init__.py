"""Scratch arrays and threads."""
