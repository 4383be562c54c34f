"""How right are float32 shadow rays that start a little off their surface? Held to the exact truth.

    python3 ray_offsets.py [points [distance_m]]

distance_m is how far the scene lies from the origin: the farther, the coarser is float32.

Rays are Möller and Trumbore's, in float32, from points that were rounded to float32 and moved along their triangle's
normal. Too small an offset, and they hit the triangle they start from; too large, and they jump over what casts a
contact shadow.
"""

import sys

import gnomon
import numpy as np

count = int(sys.argv[1]) if len(sys.argv) > 1 else 4000
distance_m = float(sys.argv[2]) if len(sys.argv) > 2 else 1000
model = gnomon.builtin("sphere-cube")
scene = gnomon.Scene(model.vertices + np.array([distance_m, 0, 0]), model.triangles)
light = {"direction": [-0.4, -1, -0.3]}

rng = np.random.default_rng(1)
corners = scene.vertices[scene.triangles]
edges = corners[:, 1:] - corners[:, :1]
normals = np.cross(edges[:, 0], edges[:, 1])
triangles = rng.choice(len(scene), count, p=np.linalg.norm(normals, axis=1) / np.linalg.norm(normals, axis=1).sum())
places = rng.random((count, 2))
places[places.sum(1) > 1] = 1 - places[places.sum(1) > 1]

truth = gnomon.truth(scene, triangles=triangles, barycentrics=places, light=light)
is_scored = truth.lit | truth.blocked
print(truth)

to_light = -np.float32(light["direction"])
facing = np.sign(normals[triangles] @ to_light)[:, None]
unit = (normals[triangles] / np.linalg.norm(normals[triangles], axis=1)[:, None] * facing).astype(np.float32)
points = (corners[triangles, 0] + np.einsum("nk,nkj->nj", places, edges[triangles])).astype(np.float32)


def hits(origins):
    """Which triangles each ray hits: bool, points × triangles. Everything is float32."""
    across = np.cross(to_light, edges[:, 1])
    determinant = np.einsum("tj,tj->t", edges[:, 0], across)
    found = np.zeros((len(origins), len(scene)), bool)
    with np.errstate(all="ignore"):
        for i, origin in enumerate(origins):
            s = origin - corners[:, 0]
            q = np.cross(s, edges[:, 0])
            u = np.einsum("tj,tj->t", s, across) / determinant
            v = q @ to_light / determinant
            t = np.einsum("tj,tj->t", edges[:, 1], q) / determinant
            found[i] = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0)
    return found


print("\noffset [m]   hit their own triangle   false shadow   false lit")
for offset in np.float32([0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1]):
    found = hits(points + offset * unit)
    is_shadowed = found.any(1)
    own = found[np.arange(count), triangles][is_scored].mean()
    false_shadow = is_shadowed[truth.lit].mean()
    false_lit = (~is_shadowed)[truth.blocked].mean()
    print(f"{offset:<12.0e} {own:>21.3%} {false_shadow:>14.3%} {false_lit:>11.3%}")
