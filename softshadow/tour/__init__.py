"""The tour: every technique on one scene, as a folder of pictures and buffers with a page to read.

The modules are imported one by one, because `compilation` must start its process before the others are loaded.
"""
