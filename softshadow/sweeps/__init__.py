"""Sweeps: many runs over techniques, options and scenes; and films, whose frames are such runs."""
