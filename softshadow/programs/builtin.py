"""The built-in programs; their kernels are compiled at the first draw that uses them."""

from softshadow.programs.blinn_phong import BLINN_PHONG
from softshadow.programs.blinn_phong_shadowed import BLINN_PHONG_SHADOWED, BLINN_PHONG_SHADOWED_5X5
from softshadow.programs.cube_visibility import CUBE_VISIBILITY
from softshadow.programs.distance_map import DISTANCE_VISIBILITY, LIGHT_DISTANCE
from softshadow.programs.eight_maps import MAP_VISIBILITY_8
from softshadow.programs.filterable_depth import BOX_BLUR, DEPTH_EXPONENTIAL, DEPTH_MOMENTS
from softshadow.programs.filtered_visibility import EXPONENTIAL_VISIBILITY, VARIANCE_VISIBILITY
from softshadow.programs.map_visibility import MAP_VISIBILITY, MAP_VISIBILITY_BILINEAR
from softshadow.programs.shadow_map import SHADOW_MAP
from softshadow.programs.silhouette_visibility import SILHOUETTE_VISIBILITY
from softshadow.programs.soft_visibility import SOFT_VISIBILITY
from softshadow.programs.wedge import WEDGE_DISC, WEDGE_RECTANGLE, WEDGE_SEGMENT, WEDGE_SPHERE, WEDGE_VISIBILITY
from softshadow.programs.window_lookup import POSITION, VOLUME_SIDE

BUILTIN = (
    BLINN_PHONG,
    SHADOW_MAP,
    BLINN_PHONG_SHADOWED,
    BLINN_PHONG_SHADOWED_5X5,
    MAP_VISIBILITY,
    MAP_VISIBILITY_BILINEAR,
    MAP_VISIBILITY_8,
    CUBE_VISIBILITY,
    LIGHT_DISTANCE,
    DISTANCE_VISIBILITY,
    SILHOUETTE_VISIBILITY,
    SOFT_VISIBILITY,
    DEPTH_MOMENTS,
    DEPTH_EXPONENTIAL,
    BOX_BLUR,
    VARIANCE_VISIBILITY,
    EXPONENTIAL_VISIBILITY,
    POSITION,
    VOLUME_SIDE,
    WEDGE_RECTANGLE,
    WEDGE_DISC,
    WEDGE_SPHERE,
    WEDGE_SEGMENT,
    WEDGE_VISIBILITY,
)
