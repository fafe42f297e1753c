"""What is drawn: meshes and their shadow geometry, cameras, lights, scenes built in or read from files."""

from softshadow.scene.camera import Camera
from softshadow.scene.lights import Light
from softshadow.scene.mesh import Mesh
from softshadow.scene.named import scene_names, scene_title
from softshadow.scene.placement import placement
from softshadow.scene.scene import Material, Scene, SceneObject
from softshadow.scene.shadow_volume import ShadowVolume, shadow_volume
from softshadow.scene.silhouette import CastingFaces, Silhouette, casting_faces, silhouette
from softshadow.scene.topology import Topology

__all__ = [
    "Camera",
    "CastingFaces",
    "Light",
    "Material",
    "Mesh",
    "Scene",
    "SceneObject",
    "ShadowVolume",
    "Silhouette",
    "Topology",
    "casting_faces",
    "placement",
    "scene_names",
    "scene_title",
    "shadow_volume",
    "silhouette",
]
