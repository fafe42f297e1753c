"""Recorded programs: apitrace's file format, read call by call. Nothing here knows what a call does."""

from softshadow.traces.reader import Call, Trace

__all__ = ["Call", "Trace"]
