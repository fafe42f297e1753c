"""Errors in the slides on soft shadows."""

from softshadow.course.erratum import Erratum

ERRATA = (
    Erratum(
        "E26", "SK:312-322", "the corners do not stand for the light",
        "“Tieňové telesá pre každý roh plošného telesa”",
        "N corners give N + 1 grey levels, and points that see all corners may not see the middle. Only the umbra of "
        "one convex caster is exact.",
        "Many points spread over the light, or wedges.",
        ("failure:corners-only", "failure:banding"),
    ),
    Erratum(
        "E28", "SK:427-436", "which tangent plane bounds a wedge",
        "the right wall “„dotýka“ sa plochy svetla”",
        "At each end two planes touch the light. With the other one of them, the wedge leaves out points that see its "
        "edge before the light.",
        "All four planes touch the light's sphere and face away from it; at an end take the one between the sphere "
        "and the other end.",
        ("program:wedge-planes",),
    ),
    Erratum(
        "E29", "SK:429", "only the bounding wedge has the moved vertex",
        "“Vzdialenejší vrchol hrany siluety sa posunie”",
        "What an edge hides of the light depends on the edge itself, not on the moved one.",
        "Use the moved vertex for the planes, the true edge for the coverage.",
        ("program:moved-vertex",),
    ),
    Erratum(
        "E54", "CA:53, CA:682", "the width is s (d_r − d_b) / d_b",
        "“apropem ocluser i receptor”; “apropar la llum a l'occludor”",
        "It is not said which of the two moves, nor whether “extensió” is a width or an area.",
        "The width of the penumbra is s (d_r − d_b) / d_b; all questions follow from it.",
        ("program:penumbra-width",),
    ),
)  # fmt: skip
