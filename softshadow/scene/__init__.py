"""Meshes and their shadow geometry, cameras, lights, and scenes: built in or read from files."""

from softshadow.scene.camera import Camera
from softshadow.scene.files import load_scene
from softshadow.scene.light_samples import light_samples, sample_lights
from softshadow.scene.light_shapes import Disc, LightShape, Rectangle, Segment, Sphere
from softshadow.scene.lights import Light
from softshadow.scene.loading import mesh_from_file, scene_from_mesh
from softshadow.scene.mesh import Mesh
from softshadow.scene.named import named_scene, scene_names, scene_title
from softshadow.scene.placement import placement
from softshadow.scene.scene import Material, Scene, SceneObject
from softshadow.scene.scene_warnings import scene_warnings
from softshadow.scene.shadow_volume import ShadowVolume, shadow_volume
from softshadow.scene.silhouette import CastingFaces, Silhouette, casting_faces, silhouette
from softshadow.scene.topology import Topology

__all__ = [
    "Camera",
    "CastingFaces",
    "Disc",
    "Light",
    "LightShape",
    "Material",
    "Mesh",
    "Rectangle",
    "Scene",
    "SceneObject",
    "Segment",
    "ShadowVolume",
    "Silhouette",
    "Sphere",
    "Topology",
    "casting_faces",
    "light_samples",
    "placement",
    "sample_lights",
    "scene_names",
    "scene_title",
    "shadow_volume",
    "silhouette",
]

# attached here, because the modules of these functions import the class; there it declares them for type checkers
Scene.named = staticmethod(named_scene)  # type: ignore[method-assign]
Scene.from_mesh = staticmethod(scene_from_mesh)  # type: ignore[method-assign]
Mesh.load = staticmethod(mesh_from_file)  # type: ignore[method-assign]
Scene.load = staticmethod(load_scene)  # type: ignore[method-assign]
Scene.warnings = scene_warnings  # type: ignore[method-assign]
