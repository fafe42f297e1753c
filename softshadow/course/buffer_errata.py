"""Errors in the slides on stencil buffer, depth buffer and polygon offset."""

from softshadow.course.erratum import Erratum

ERRATA = (
    Erratum(
        "E4", "RO1:266", "GL_KEEP, not KEEP",
        "`glStencilOp(GL_KEEP, GL_KEEP, KEEP);`",
        "OpenGL has no such name.",
        "`GL_KEEP`.",
        ("program:names-of-gl",),
    ),
    Erratum(
        "E30", "CA:110, CA:124", "units are multiplied by r",
        "z' = z + 1/r · units on one slide, z' = z + ∂z · factor + r · units on the next",
        "Divided by the smallest step, one unit is larger than the whole depth range.",
        "Multiplied: factor · m + r · units.",
        ("listing:offset-formula",),
    ),
    Erratum(
        "E31", "CA:128", "the slope is an absolute value",
        "∂z = max(∂z/∂x, ∂z/∂y)",
        "On a surface whose z decreases to the right and upwards the offset would have the wrong sign.",
        "max(|∂z/∂x|, |∂z/∂y|), an approximation of the gradient's length that GL allows.",
        ("listing:offset-formula",),
    ),
    Erratum(
        "E32", "CA:114, CA:130", "r is the smallest resolvable step",
        "“r = valor més petit tal que garantitza un offset > 0”",
        "r is the smallest difference that is sure to stay a difference after rasterization. For 24-bit depth it may "
        "be more than one step of the buffer; for floating-point depth it depends on z.",
        "Mesa takes two steps for a unit.",
        ("program:steps-of-a-unit",),
    ),
    Erratum(
        "E42", "CA:239-242", "wrapping operations; REPLACE writes all bits",
        "the list ends with `GL_REPLACE (usa valor refèrència)`",
        "GL_INCR_WRAP and GL_DECR_WRAP are missing. And GL_REPLACE does not apply the mask of glStencilFunc.",
        "REPLACE writes the whole reference; only glStencilMask limits it.",
        ("program:replaced-value",),
    ),
    Erratum(
        "E43", "CA:238-239", "a disabled depth test counts as zpass",
        "“zpass -> op. a fer quan passa stencil i passa z-buffer”",
        "Without depth test every fragment counts as passed; and it writes no depth.",
        "To keep the depth buffer, use glDepthMask, and leave the test enabled.",
        ("failure:depth-test-off-while-counting",),
    ),
    Erratum(
        "E44", "CA:669-674", "REPLACE writes the reference of glStencilFunc",
        "option d, “determinar els valors a escriure al stencil buffer”, is crossed out: “glStencilOp”",
        "The second argument of glStencilFunc is the value that GL_REPLACE writes.",
        "(a) is the best answer, but (d) is not quite wrong.",
        ("program:reference-is-written",),
    ),
    Erratum(
        "E45", "CA:694-697", "without depth test, the skeleton is drawn last",
        "`glDisable(GL_DEPTH_TEST)` is crossed out",
        "As a call on its own it does not help, but if the skeleton is drawn last, it is seen.",
        "The split depth range sorts the skeleton's own faces as well.",
        ("listing:skeleton-depth-test",),
    ),
    Erratum(
        "E57", "CA:219-221", "QSurfaceFormat asks for stencil bits",
        "`QOpenGLformat f; f.setStencil(true);`",
        "Qt has no such class.",
        "`QSurfaceFormat` with `setStencilBufferSize(8)`; then query GL_STENCIL_BITS, as the slide does.",
        ("program:stencil-bits",),
    ),
    Erratum(
        "E59", "CA:190-199", "stencil before depth is what matters",
        "a fixed list of operations, with the alpha test",
        "Right up to OpenGL 2.1. Core profiles have no alpha test; multisample coverage is not listed.",
        "The order to remember: a fragment that fails the stencil test is not tested for depth.",
        ("program:stencil-before-depth",),
        stands=True,
    ),
    Erratum(
        "E64", "RO1:181", "stencil writing is not disabled by default",
        "“dezactiveaza scrierea in stencil-buffer; //implicite”",
        "By default the write mask is all ones. What is off is the stencil test.",
        "`glStencilMask(0)` disables writing.",
        ("program:stencil-write-mask",),
    ),
    Erratum(
        "E65", "RO1:204, RO1:308", "glStencilFunc activates nothing",
        "`glStencilFunc(GL_ALWAYS, 0x0, 0xff); // se activeaza scrierea in stencil buffer`",
        "glStencilFunc sets the comparison. Writing takes place while the test is enabled.",
        "`glEnable(GL_STENCIL_TEST)`.",
        ("program:function-without-test",),
    ),
)  # fmt: skip
