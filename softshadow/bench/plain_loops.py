"""The two loops that measure the machine (`limits`)."""

from softshadow.jit import kernel


@kernel
def triad(a, b, c, scale):
    """Write a = b + scale c."""
    for i in range(len(a)):
        a[i] = b[i] + scale * c[i]


@kernel
def stencil_sweeps(depth, stencil, z, sweeps):
    """Count up where z passes under GL_LESS, `sweeps` times over all pixels; z moves, so that no sweep is left out."""
    for sweep in range(sweeps):
        z_now = z[sweep & 1]
        for i in range(len(depth)):
            stencil[i] = stencil[i] + (1 if z_now < depth[i] else 0)
