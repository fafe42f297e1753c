"""From visible fragments to colours in the buffers."""
