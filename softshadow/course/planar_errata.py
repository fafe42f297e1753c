"""Errors in the slides on planar shadows."""

from softshadow.course.erratum import Erratum

ERRATA = (
    Erratum(
        "E15", "RO1:64-68", "shadow polygons are drawn with GL_LEQUAL and an offset",
        "after the whole scene `glDisable(GL_DEPTH_TEST)`, then all shadow polygons",
        "Without the depth test they are painted over nearer objects.",
        "`GL_LEQUAL` and a polygon offset of (−1, −1), or a stencil mark for each face.",
        ("listing:planar-polygons", "failure:painting-over-nearer", "failure:z-fighting"),
    ),
    Erratum(
        "E16", "RO1:43", "a projection ends where its receiver does",
        "“Umbrele purtate se pot determina proiectând în scenă … toate poligoanele”",
        "Faces behind the receiver would cast on it, and shadows would extend beyond its edge.",
        "Project the part on the light's side of the receiver, and clip the projection to the receiver.",
        ("listing:planar-faces", "listing:planar-polygons", "failure:shadow-outside-receiver"),
    ),
    Erratum(
        "E21", "SK:175-180", "0 < t < 1 is wrong as well",
        "anti-shadow “ak t < 0”",
        "Only t ≥ 1 is valid. With t < 0 the caster is behind the light, with 0 < t < 1 behind the receiver.",
        "GL's clipping removes t < 0 if w has the right sign; 0 < t < 1 needs a clip plane at the receiver.",
        ("listing:planar-rays", "failure:anti-shadow", "failure:false-shadow", "failure:cpu-division"),
    ),
    Erratum(
        "E22", "SK:139", "the plane is the receiver",
        "“Tieňene teleso je xz rovina; y=0”",
        "“Tieňové teleso” is SK's word for the caster (SK:58).",
        "The plane y = 0 receives the shadow: the matrix maps every vertex of a caster to y = 0.",
        ("program:vertices-on-the-plane",),
    ),
    Erratum(
        "E23", "SK:78", "dot products are clamped at 0",
        "k_d O_d (L · N) + k_s O_s (R_i · V)^n, without limits and with an L without index",
        "A face turned away from light i would get negative light, which darkens the ambient light, too.",
        "max(0, L_i · N) and max(0, R_i · V)^n; S_i multiplies the direct term only.",
        ("program:unclamped-light",),
    ),
    Erratum(
        "E33", "CA:83-88", "a stencil mark keeps the shadow on the receiver",
        "the flattened caster is drawn after `glDisable(GL_DEPTH_TEST)`",
        "That works only while nothing but the receiver has been drawn, and it paints beyond the receiver's outline.",
        "Mark the receiver in the stencil buffer, and draw the shadow where the mark is.",
        ("listing:planar", "failure:shadow-outside-receiver"),
    ),
    Erratum(
        "E34", "CA:95", "the occluder is drawn last",
        "`// 3. Dibuixar oclusor … dibuixa (emissor);`",
        "The emitter is the lamp.",
        "`dibuixa(oclusor)`.",
        ("listing:planar",),
    ),
    Erratum(
        "E35", "CA:369, CA:383", "turn the plane so that w > 0",
        "the matrices of a light at the origin and at a point, without a rule for the sign of (a, b, c, d)",
        "With the light on the positive side of the plane, w is negative for casters, and GL clips all of them.",
        "Turn the plane so that a x + b y + c z + d < 0 at the light, or negate the matrix.",
        ("listing:planar-point", "failure:wrong-matrix-sign"),
    ),
    Erratum(
        "E36", "CA:391-396", "the direction points towards the light",
        "“projecció en la direcció del vector (x,y,z)”",
        "With the direction in which light travels, w is negative for all casters.",
        "(x, y, z) points towards the light.",
        ("listing:planar-direction", "failure:light-direction"),
    ),
    Erratum(
        "E37", "SK:153", "this matrix has the right sign",
        "the matrix for y = 0, with l_y in the last element",
        "CA's matrices for the same task have the other sign (E35), so one of the two looks wrong.",
        "Right as printed: w = l_y − v_y is positive for everything below the light.",
        ("program:sign-of-w",),
        stands=True,
    ),
    Erratum(
        "E41", "CA:321-339, CA:759", "mask 1 and mask 255 do the same",
        "`glStencilFunc(GL_EQUAL, 1, 1)` in one printing, `(GL_EQUAL, 1, 255)` in the other",
        "One of the two looks like a mistake.",
        "Both are right, provided that the stencil buffer was cleared: it holds 0 and 1 only.",
        ("program:two-masks",),
        stands=True,
    ),
    Erratum(
        "E56", "SK:207", "the light must be static, too",
        "a texture can be kept “ak tienidlo aj tienený objekt sú dostatočne dlho statické”",
        "The shadow also moves with the light.",
        "Valid while caster, receiver and light stand still.",
        ("program:kept-shadow",),
    ),
    Erratum(
        "E60", "SK:166-171", "receiver, shadow, casters, in this order",
        "“Render scenu (uplné osvetlenie)”, then the flattened casters",
        "Shadow and receiver have equal depth except for rounding; without the depth test the shadow would cover the "
        "casters.",
        "Draw the receiver, the shadow without depth test, and then the casters.",
        ("listing:planar-darken", "failure:casters-before-shadow"),
    ),
    Erratum(
        "E67", "CA:82-87, CA:347", "the shadow needs a colour of its own",
        "`glDisable (GL_LIGHTING)`, then the shadow is drawn: no call sets its colour",
        "Without lighting, the current colour is used, whatever the last draw left: with objects that set their own "
        "colour, a brown box casts a brown shadow.",
        "Draw the shadow in the receiver's ambient colour, or blend black over it.",
        ("program:colour-of-the-shadow",),
    ),
    Erratum(
        "E68", "CA:712", "the receiver is drawn",
        "in the second printing `// drawReceiver();` is a comment",
        "Nothing is there for the shadow to fall on.",
        "`drawReceiver();`, as in CA:150.",
        ("listing:planar-offset-again",),
    ),
)  # fmt: skip
