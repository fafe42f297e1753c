"""Ordinary GL programs, as students and researchers write them, measured on softshadow and on Mesa."""
