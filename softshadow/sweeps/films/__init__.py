"""Films: a technique drawn again and again while a light, the camera or an option changes."""
