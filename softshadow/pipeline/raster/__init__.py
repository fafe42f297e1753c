"""From triangles to fragments: coverage, depth, and the per-fragment operations."""
