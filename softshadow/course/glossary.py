"""The terms of the course in English, Romanian, Slovak and Catalan, and the names of the package that they stand for.

Romanian, Slovak and Catalan terms are those of the slides, with their accents restored. A term that ends in * is not in
the slides of that language; it is the one in general use.
"""

from typing import NamedTuple


class Term(NamedTuple):
    """A term in four languages, what it means, and where it is in the package.

    Attributes
    ----------
    symbols : tuple of str       full names: of modules, classes, functions, attributes
    avoid : tuple of str         spellings that are not used here
    """

    english: str
    romanian: str
    slovak: str
    catalan: str
    meaning: str
    symbols: tuple[str, ...]
    avoid: tuple[str, ...] = ()


TERMS = (
    Term("shadow", "umbră", "tieň", "ombra", "The points that do not see the light.",
         ("softshadow.runs.Run.visibility",)),
    Term("umbra", "umbră pură", "hlavný tieň", "umbra", "The points that see no part of the light.",
         ("softshadow.inspection.soft_truth.SoftTruth.classes",)),
    Term("penumbra", "penumbră*", "polotieň", "penombra", "The points that see a part of an area light.",
         ("softshadow.inspection.soft_truth.SoftTruth.visibility",)),
    Term("own shadow", "umbră proprie", "vlastný tieň", "ombra pròpia*",
         "Shadow on a face that is turned away from the light.", ("softshadow.inspection.shadow_kinds",)),
    Term("cast shadow", "umbră purtată", "vrhnutý tieň", "ombra projectada*", "Shadow of one object on another.",
         ("softshadow.inspection.shadow_kinds",)),
    Term("hard shadow", "umbră dură*", "ostrý tieň", "ombra dura*", "Shadow of a point light: without penumbra.",
         ("softshadow.techniques.volume_zpass",)),
    Term("soft shadow", "umbră moale*", "mäkký tieň", "ombra suau*", "Shadow of an area light: with penumbra.",
         ("softshadow.inspection.soft_truth.soft_truth", "softshadow.techniques.volume_wedges"), ("softshadows",)),
    Term("caster (occluder)", "obiect care produce umbra*", "tienidlo", "oclusor", "An object that blocks light.",
         ("softshadow.scene.Scene.casters", "softshadow.scene.SceneObject.casts")),
    Term("receiver", "obiect care conține umbra*", "zatienený objekt", "receptor", "An object on which shadow falls.",
         ("softshadow.scene.Scene.receivers", "softshadow.scene.SceneObject.receives")),
    Term("light", "sursă de lumină", "zdroj svetla", "font de llum", "What emits light.",
         ("softshadow.scene.Light",)),
    Term("point light", "sursă punctiformă", "bodové svetlo", "font de llum puntual", "A light at one point.",
         ("softshadow.scene.Light.position",)),
    Term("area light", "sursă extinsă*", "plošné svetlo*", "font de llum extensa*", "A light of some size.",
         ("softshadow.scene.Light.shape", "softshadow.scene.Rectangle", "softshadow.scene.Disc")),
    Term("ambient light", "lumină ambiantă*", "okolité svetlo*", "llum ambient*",
         "Light from everywhere, which reaches shadows, too.", ("softshadow.scene.Scene.ambient",)),
    Term("planar shadow", "umbră planară", "rovinný tieň", "ombra per projecció",
         "The shadow on a plane, drawn as the flattened caster.", ("softshadow.techniques.planar",)),
    Term("projection matrix", "matrice de proiecție*", "projekčná matica", "matriu de projecció",
         "The matrix that flattens a caster onto a plane.", ("softshadow.matrices.planar_shadow",)),
    Term("shadow polygon", "poligon de umbră", "polygón tieňa*", "polígon d'ombra*",
         "A polygon of own or cast shadow, or a side of a volume.", ("softshadow.techniques.shadow_polygons",)),
    Term("z-fighting", "z-fighting*", "z fighting", "z-fighting",
         "Two surfaces of equal depth, between which rounding decides.", ("softshadow.gallery.planar",)),
    Term("polygon offset", "decalaj de poligon*", "posun polygónu*", "offset",
         "What is added to the depth of a polygon before the depth test.", ("softshadow.gl.glPolygonOffset",)),
    Term("anti-shadow", "antiumbră*", "antishadow", "antiombra*", "The false shadow of a caster behind the light.",
         ("softshadow.techniques.clipping",)),
    Term("clipping", "decupare", "orezávanie", "retallat*", "Removing what is outside a volume or behind a plane.",
         ("softshadow.pipeline.geometry.clip",)),
    Term("shadow volume", "volum de umbră", "tieňové teleso", "volum d'ombra", "The part of space that a caster hides.",
         ("softshadow.scene.shadow_volume", "softshadow.space.shadow_geometry")),
    Term("generator (polygon)", "poligon generator", "polygón tienidla", "polígon generador*",
         "A lit polygon from which a volume starts.", ("softshadow.scene.casting_faces",)),
    Term("silhouette", "siluetă", "silueta", "silueta*", "The edges between faces towards and away from the light.",
         ("softshadow.scene.silhouette",)),
    Term("front face", "față din față", "predná stena", "cara frontal", "A face that is turned towards the eye.",
         ("softshadow.gl.glFrontFace", "softshadow.gl.glCullFace")),
    Term("back face", "față din spate", "zadná stena", "cara posterior", "A face that is turned away from the eye.",
         ("softshadow.gl.glCullFace",)),
    Term("counter", "contor", "počítadlo", "comptador*", "The number of volumes around a point, in the stencil buffer.",
         ("softshadow.techniques.shadow_volumes",)),
    Term("z-pass (depth pass)", "depth pass", "z-pass*", "z-pass*", "Counting where the depth test passes.",
         ("softshadow.techniques.volume_zpass",)),
    Term("z-fail (depth fail)", "depth fail", "z-fail*", "z-fail*", "Counting where the depth test fails.",
         ("softshadow.techniques.volume_zfail",)),
    Term("stencil buffer", "buffer de marcaje", "stencil buffer", "stencil buffer", "A small integer for each pixel.",
         ("softshadow.gl.glStencilOp", "softshadow.gl.glStencilFunc"), ("stencilbuffer",)),
    Term("depth buffer (z-buffer)", "buffer de adâncime", "z-buffer", "z-buffer",
         "The depth of the nearest surface for each pixel.", ("softshadow.gl.glDepthFunc", "softshadow.gl.glDepthMask"),
         ("depthbuffer",)),
    Term("depth test", "test de adâncime", "hĺbkový test*", "depth test",
         "The comparison of a fragment's depth with the stored one.", ("softshadow.gl.glDepthFunc",)),
    Term("fragment", "fragment", "fragment*", "fragment", "What a primitive contributes to one pixel.",
         ("softshadow.runs.Run.pixel",)),
    Term("rasterization", "rasterizare", "rasterizácia", "rasterització*", "Making fragments of primitives.",
         ("softshadow.pipeline.raster",)),
    Term("pass", "pas", "krok", "pas", "Drawing the scene, or a part of it, once.", ("softshadow.runs.Run.ledger",)),
    Term("shadow map (depth map)", "shadow map", "hĺbková mapa", "shadow map", "The depth buffer of the light's view.",
         ("softshadow.techniques.map", "softshadow.techniques.depth_maps"), ("shadowmap ", "shadow-mapping")),
    Term("bias", "bias*", "depth bias", "bias", "What is subtracted from a depth before it is compared with the map.",
         ("softshadow.techniques.depth_maps",)),
    Term("factor (shadow factor)", "factor de umbră", "faktor tieňa*", "factor d'ombra*",
         "The share of its colour that a point in shadow keeps.", ("softshadow.programs.shadow_map",)),
    Term("percentage-closer filtering", "percentage-closer filtering*", "percentage closer filtering",
         "percentage-closer filtering*", "The mean of comparisons with several texels.",
         ("softshadow.techniques.map_pcf",)),
    Term("shadow silhouette map", "hartă de siluete*", "shadow silhouette map", "mapa de siluetes*",
         "A shadow map with the points of the silhouette.", ("softshadow.techniques.map_silhouette",)),
    Term("penumbra wedge", "pană de penumbră*", "klin", "falca de penombra*",
         "The part of space from where one silhouette edge is seen before the light.",
         ("softshadow.scene.penumbra_wedge.PenumbraWedges",)),
)  # fmt: skip


# pages that describe the names which the API reference does not have; layout.md lists every file
PAGES = (("softshadow.gl.", "gl21.md"), ("softshadow.techniques.", "techniques.md"))
DOCUMENTED = (
    "softshadow.inspection.soft_truth.", "softshadow.runs.", "softshadow.scene.Disc", "softshadow.scene.Light",
    "softshadow.scene.Rectangle", "softshadow.scene.Scene", "softshadow.scene.penumbra_wedge.",
    "softshadow.space.shadow_geometry",
)  # fmt: skip


def link(symbol: str) -> str:
    """Return a Markdown link to the documentation of a name: the API reference, or a page.

    Examples
    --------
    >>> link("softshadow.gl.glStencilOp")
    '[softshadow.gl.glStencilOp](gl21.md)'
    """
    if symbol.startswith(DOCUMENTED):
        return f"{{py:obj}}`{symbol}`"
    page = next((page for start, page in PAGES if symbol.startswith(start)), "layout.md")
    return f"[{symbol}]({page})"


def markdown_table() -> str:
    """Return the terms as a Markdown table, in the order of the course, with links to the names of the package."""
    rows = ["| English | Romanian | Slovak | Catalan | meaning | in the package |", "|---|---|---|---|---|---|"]
    for term in TERMS:
        names = ", ".join(link(name) for name in term.symbols)
        rows.append(f"| {' | '.join(term[:5])} | {names} |".replace("*", "\\*"))
    return "\n".join(rows)
