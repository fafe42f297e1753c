"""From a draw command to triangles in the window."""
