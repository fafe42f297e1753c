"""The two loops that measure the limits of the machine (`limits`)."""

from softshadow.jit import kernel


@kernel
def triad(a, b, c, scale):
    """Write a = b + scale c."""
    for i in range(len(a)):
        a[i] = b[i] + scale * c[i]


@kernel
def stencil_sweeps(depth, stencil, z, sweeps):
    """Increment stencil values where z passes GL_LESS, in several sweeps; z changes, so no sweep is optimised away."""
    for sweep in range(sweeps):
        z_now = z[sweep & 1]
        for i in range(len(depth)):
            stencil[i] = stencil[i] + (1 if z_now < depth[i] else 0)
