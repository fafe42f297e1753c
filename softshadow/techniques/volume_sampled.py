"""Soft shadows by many shadow volumes: one volume for each of several points of the light.

A point of the scene sees as much of the light as the share of the light's points that it sees. Each of these points has
a shadow volume of its own, which is counted as for a point light: here where the depth test fails, so that the eye may
be in shadow.

Paper: none of its own; Brotman & Badler 1984, "Generating soft shadows with a depth buffer algorithm", first summed
shadow volumes of light points.
Slides: Zimányi & Valient, Mäkké tiene, tieňové telesá (sampling the light).

Known failures: n points give n + 1 shades, and with few of them the penumbra is a pile of hard shadows (banding), most
of all with the corners alone; jittered points turn bands into noise. The time grows with the number of points. As for
all volumes, edges are those of the triangles, and infinite volumes need a projection without a far plane.
"""

from typing import Any

import numpy as np

from softshadow.scene import Scene
from softshadow.techniques import drawing, light_points, shadow_volumes
from softshadow.techniques.technique import Steps


def steps(
    gl: Any,
    scene: Scene,
    *,
    size: tuple[int, int],
    samples: light_points.Samples = 9,
    pattern: light_points.LightPattern = "grid",
    seed: light_points.Seed = 0,
    generator: shadow_volumes.Generator = "silhouette",
    cap: shadow_volumes.Cap = "infinite",
    reach: shadow_volumes.Reach = None,
    far: shadow_volumes.Far = "infinite",
    ops: shadow_volumes.Ops = "wrap",
) -> Steps:
    """Draw the scene with z-fail shadow volumes of points of each light."""
    # 1. the colours of the scene in shadow, and the depth of what is visible
    drawing.begin_frame(gl, scene)
    drawing.set_camera(gl, scene.camera, size, far)
    drawing.light_ambient_only(gl, scene)
    drawing.draw_objects(gl, scene.objects)
    depth = drawing.read_depth(gl, size)
    valid = depth < 1
    yield "draw the scene without the light"

    shares = []
    for light in scene.lights:
        seen, n_points = np.zeros(depth.shape, np.int32), 0
        for with_point, point, words in light_points.lit_from_points(scene, light, samples, pattern, seed):
            # 2. one more where a back face of the point's volumes is hidden, one less where a front face is
            count_hidden_faces(gl, shadow_volumes.volumes_of(with_point, point, generator, cap, reach), ops)

            # 3. the point is seen where the count is 0
            seen += shadow_volumes.lit_pixels(gl, with_point, point, depth, size, far, ops)
            n_points += 1
            yield (
                drawing.title(f"count the volumes of {words}", scene, light),
                {drawing.title("points seen", scene, light): seen.astype(np.float32)},
            )

        # 4. as much of the light as the share of its points that are seen
        shares.append(light_points.add_mean(gl, scene, size, light, seen, n_points, far))
        yield light_points.finish_title(scene, light), drawing.visibility_maps(scene, shares, valid)


def count_hidden_faces(gl: Any, volumes: list[shadow_volumes.CasterVolume], ops: shadow_volumes.Ops) -> None:
    """Count z-fail shadow volumes into the cleared stencil buffer, front and back faces in one pass."""
    up, down = shadow_volumes.counting_ops(gl, ops)
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_ALWAYS, 0, 0xFF)
    gl.glStencilOpSeparate(gl.GL_BACK, gl.GL_KEEP, up, gl.GL_KEEP)
    gl.glStencilOpSeparate(gl.GL_FRONT, gl.GL_KEEP, down, gl.GL_KEEP)
    gl.glDepthMask(gl.GL_FALSE)
    gl.glColorMask(gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE, gl.GL_FALSE)
    gl.glDisable(gl.GL_LIGHTING)
    shadow_volumes.draw_volumes(gl, volumes)
    gl.glColorMask(gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE, gl.GL_TRUE)
    gl.glDepthMask(gl.GL_TRUE)
    gl.glDisable(gl.GL_STENCIL_TEST)
