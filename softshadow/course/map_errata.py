"""Errors in the slides on shadow maps."""

from softshadow.course.erratum import Erratum

ERRATA = (
    Erratum(
        "E19", "SK:334", "in shadow if farther than the map, not nearer",
        "“Ak leží bod, získaný z pohľadu kamery, bližšie než z pohľadu svetla => je v tieni”",
        "Reversed: a point nearer than the stored depth is lit. And not the map's pixels but the camera's are "
        "transformed. The loop in SK:357 (A < B) has it right.",
        "In shadow if the point is farther from the light than the stored depth.",
        ("failure:reversed-comparison",),
    ),
    Erratum(
        "E27", "SK:374", "faces turned away move the errors",
        "“Lepšie riešenie: do z-buffra vykresľovať len plochy odvrátené od svetla”",
        "Light leaks in where casters touch their receivers and where unlit faces meet lit ones; open meshes have no "
        "such faces.",
        "Use it for closed casters of some thickness.",
        ("failure:open-mesh-leak", "failure:offset-of-far-faces"),
    ),
    Erratum(
        "E46", "CA:518-519", "depths are not filtered",
        "`GL_LINEAR` on a texture that is read as plain depth",
        "The mean of two depths is the depth of no surface: edges move with the receiver's depth and stay hard.",
        "`GL_NEAREST`, or a compare mode, which filters the results of the comparison.",
        ("listing:map", "failure:linear-filtered-depth"),
    ),
    Erratum(
        "E47", "CA:516-517", "what the light does not see is lit",
        "`GL_CLAMP_TO_EDGE`",
        "Outside the light's view, the texel at the edge is repeated.",
        "A border of depth 1, and tests of q > 0 and 0 ≤ s, t ≤ 1.",
        ("listing:map", "failure:edge-smear"),
    ),
    Erratum(
        "E48", "CA:544, CA:620", "an offset or a bias, not both",
        "`glPolygonOffset(1,1)` in pass 1 and `bias = 0.01` in pass 2, “només si no hem usar glPolygonOffset”",
        "The comment is right, but the two listings together use both: light leaks in at contacts.",
        "One of them.",
        ("listing:map", "failure:offset-and-bias"),
    ),
    Erratum(
        "E49", "CA:620", "the bias must follow the slope",
        "`float bias = 0.01;`",
        "0.01 of the depth range is a different distance at every depth, and steep surfaces need more.",
        "A polygon offset whose factor follows the slope.",
        ("listing:map-bias", "failure:constant-bias", "failure:peter-panning", "failure:acne"),
    ),
    Erratum(
        "E50", "RO2:28-39, RO2:65-83", "projection, division and scale are needed as well",
        "“se transforma varfurile … folosind ViewS”, then `ZS[poz_sursa.y][poz_sursa.x]`",
        "A view matrix only rotates and moves: its results are not texel coordinates.",
        "View, projection, division by w for each fragment, scale to texels, and q > 0.",
        ("listing:map-two-stages", "failure:light-view-only"),
    ),
    Erratum(
        "E51", "RO2:43", "the map is cleared to 1",
        "`daca z < ZS[y][x] atunci ZS[y][x] = z`, without a first value of ZS",
        "If ZS starts at 0, no z is less.",
        "Clear it to the far end, 1.",
        ("listing:map-two-stages", "failure:map-not-cleared"),
    ),
    Erratum(
        "E52", "RO2:83", "a comparison needs a bias",
        "`daca poz_sursa.z > ZS[poz_sursa.y][poz_sursa.x]`",
        "A lit surface has nearly the stored depth, and rounding and texel size decide.",
        "A slope offset in the map, see E49.",
        ("listing:map-two-stages", "failure:acne"),
    ),
    Erratum(
        "E53", "RO2:85", "only this light's direct part is multiplied",
        "`Culoare_fragment = factor_umbra * Culoare_fragment`",
        "The factor also dims ambient light and all other lights.",
        "Multiply the direct term of this light, by 0 for a hard shadow.",
        ("listing:map-two-stages", "failure:factor-on-whole-color", "failure:modulative-lights"),
    ),
    Erratum(
        "E55", "RO1:23, RO1:24, CA:803", "one frustum must contain casters and receivers",
        "a light “la distanță finită dar în afara scenei” is easier than one “în scenă”",
        "What decides is not whether the light is inside the scene.",
        "One map is enough if one frustum from the light contains all casters and receivers.",
        ("failure:omni-light",),
    ),
    Erratum(
        "E62", "CA:531, CA:553", "the map is drawn into its texture",
        "`glViewport(0, 0, SHADOW_MAP_WIDTH, …)` in the window, then `glCopyTexSubImage2D`",
        "Outside the window nothing is drawn, so a map larger than the window is cut off.",
        "Draw into a framebuffer object.",
        ("listing:map", "failure:map-larger-than-window"),
    ),
    Erratum(
        "E66", "CA:591", "the model matrix belongs into the product",
        "`texCoord = lightMatrix*vec4(vertex,1);`",
        "`lightMatrix` takes world space, but `vertex` is in object space: an object that a model matrix places is "
        "compared at another place of the map.",
        "`lightMatrix * (modelMatrix * vec4(vertex, 1))`, as in the program `shadow-map`; or vertices in world "
        "space, as in the listings here.",
        ("program:model-matrix",),
    ),
    Erratum(
        "E69", "SK:331", "the map holds window z, not the distance",
        "“Pixle nesú info o svojej vzdialenosti ku zdroju”",
        "A depth buffer holds window z: equal on planes across the light's view, where distances differ.",
        "Compare window z with window z, or distance with distance (technique `map-distance`), never one with the "
        "other.",
        ("program:distance-of-equal-depths",),
    ),
)  # fmt: skip
