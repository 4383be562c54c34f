"""Ten small meshes with seeded jobs, in which every cause and label of a wrong pixel occurs.

Coordinates are multiples of 1/64, which text, double and float32 hold exactly.
"""

import random

GRID = 64


def snap(value):
    return round(value * GRID) / GRID


def quad(a, b, c, d):
    return [(a, b, c), (a, c, d)]


def ground(random_source, size=3.0, cells=2):
    """A nearly level floor of a few cells, so that walks cross edges."""
    ticks = [snap(-size + 2 * size * k / cells) for k in range(cells + 1)]
    height = {(x, z): snap(random_source.uniform(-0.05, 0.05)) for x in ticks for z in ticks}
    triangles = []
    for x0, x1 in zip(ticks, ticks[1:]):
        for z0, z1 in zip(ticks, ticks[1:]):
            corners = [(x, height[x, z], z) for x, z in ((x0, z0), (x0, z1), (x1, z1), (x1, z0))]
            triangles += quad(*corners)
    return triangles


def box(low, high):
    x0, y0, z0 = low
    x1, y1, z1 = high
    corner = [(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]
    faces = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    return [triangle for face in faces for triangle in quad(*(corner[k] for k in face))]


def tilted_quad(_):
    return quad((-1, 0.5, -1), (-1, 0.75, 1), (1, 1.25, 1), (1, 1, -1))


def roof(_):
    """Two slopes and a ridge. Under a low light one slope faces away."""
    a, b, c, d = (-1.25, 0.25, -1), (-1.25, 0.25, 1), (1.25, 0.3125, 1), (1.25, 0.25, -1)
    ridge_0, ridge_1 = (0, 1.25, -1), (0.0625, 1.25, 1)
    return quad(a, b, ridge_1, ridge_0) + quad(ridge_0, ridge_1, c, d)


def box_on_ground(_):
    return box((-0.75, 0.0625, -0.5), (0.5, 0.875, 0.625))


def thin_wall(_):
    return box((-0.03125, -0.0625, -1.25), (0.03125, 1, 1.25))


def close_sheets(_):
    low = quad((-1.5, 0.375, -1.5), (-1.5, 0.375, 1.5), (1.5, 0.5, 1.5), (1.5, 0.5, -1.5))
    high = quad((-1, 0.4375, -1), (-1, 0.4375, 1), (1, 0.546875, 1), (1, 0.546875, -1))
    return low + high


def stairs(_):
    triangles = []
    for k in range(4):
        x, y = -1 + 0.5 * k, 0.25 * k
        triangles += quad((x, y, -1), (x, y, 1), (x, y + 0.25, 1), (x, y + 0.25, -1))
        triangles += quad((x, y + 0.25, -1), (x, y + 0.25, 1), (x + 0.5, y + 0.25, 1), (x + 0.5, y + 0.25, -1))
    return triangles


def pyramid(_):
    base = [(-1, 0.125, -1), (-1, 0.125, 1), (1, 0.125, 1), (1, 0.125, -1)]
    apex = (0.125, 1.25, -0.0625)
    return [(base[k], base[(k + 1) % 4], apex) for k in range(4)]


def slats(source):
    triangles = []
    for k in range(6):
        x = snap(-1.25 + 0.4375 * k + source.uniform(-0.03, 0.03))
        triangles += quad((x, 0.5, -1.25), (x, 0.5, 1.25), (x + 0.15625, 0.625, 1.25), (x + 0.15625, 0.625, -1.25))
    return triangles


def fan(source):
    """An umbrella: triangles around one shared corner."""
    rim = [(1, 0), (0.5, 0.875), (-0.5, 0.875), (-1, 0), (-0.5, -0.875), (0.5, -0.875)]
    rim = [(x, snap(0.5 + source.uniform(-0.1, 0.1)), -z) for x, z in rim]
    top = (0.0625, 1, 0.03125)
    return [(rim[k], rim[(k + 1) % 6], top) for k in range(6)]


def strip(source):
    """An open zigzag of five quads with one flipped triangle, and a degenerate one, which is dropped."""
    line = [(-1.25 + 0.5 * k, snap((0.75 if k % 2 else 0.25) + source.uniform(-0.06, 0.06))) for k in range(6)]
    triangles = []
    for (x0, y0), (x1, y1) in zip(line, line[1:]):
        triangles += quad((x0, y0, -1), (x0, y0, 1), (x1, y1, 1), (x1, y1, -1))
    triangles[3] = triangles[3][::-1]
    triangles.insert(4, ((0, 1, 0), (0.5, 1, 0), (1, 1, 0)))
    return triangles


MESHES = (tilted_quad, roof, box_on_ground, thin_wall, close_sheets, stairs, pyramid, slats, fan, strip)


def build(index, source):
    """The objects of a scene by name."""
    return {"ground": ground(source), "thing": MESHES[index](source)}


def has_area(triangle):
    a, b, c = triangle
    u = [q - p for p, q in zip(a, b)]
    v = [q - p for p, q in zip(a, c)]
    return any(u[i] * v[j] != u[j] * v[i] for i, j in ((0, 1), (1, 2), (2, 0)))


def obj_text(objects):
    lines, count = [], 0
    for name, triangles in objects.items():
        lines.append(f"o {name}")
        lines += [f"v {x:.6f} {y:.6f} {z:.6f}" for triangle in triangles for x, y, z in triangle]
        for _ in triangles:
            lines.append(f"f {count + 1} {count + 2} {count + 3}")
            count += 3
    return "\n".join(lines) + "\n"


def toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml(item) for item in value) + "]"
    return repr(value)


def job_text(job):
    return "".join(f"{key} = {toml(value)}\n" for key, value in job.items())


def light_keys(source, is_spot):
    """A light above the scene, and its map's planes and sides."""
    x, z = source.uniform(-1.6, 1.6), source.uniform(-1.6, 1.6)
    keys = {}
    if is_spot:
        keys |= {"light.type": "spot", "light.position": [snap(2 * x), source.choice([2.75, 4.0]), snap(2 * z)],
                 "light.target": [0.1, 0.2, -0.1], "light.cone_deg": source.choice([50.0, 75.0])}
        if source.random() < 0.5:
            keys |= {"shadow_map.fit": "fixed", "shadow_map.fov_deg": source.choice([22.0, 35.0])}
        near, far = source.choice([3.4, 3.9]), source.choice([4.2, 5.0])
    else:
        keys |= {"light.type": "directional", "light.direction": [round(x, 3), -1.5, round(z, 3)]}
        if source.random() < 0.5:
            keys |= {"shadow_map.fit": "fixed", "shadow_map.half_extent": source.choice([0.9, 1.6])}
        near, far = source.choice([-0.45, -0.2]), source.choice([0.1, 0.4])
    if source.random() < 0.25:
        keys["shadow_map.near"] = near
    if source.random() < 0.25:
        keys["shadow_map.far"] = far
    return keys


def point_light_keys(source):
    """A light among the objects, mostly off the middle of each face."""
    position = [snap(source.uniform(-1.2, 1.2)), snap(source.uniform(0.9, 1.7)), snap(source.uniform(-1.2, 1.2))]
    keys = {"light.type": "point", "light.position": position}
    if source.random() < 0.4:
        keys["shadow_map.near"] = source.choice([0.25, 0.5])
    if source.random() < 0.4:
        keys["shadow_map.far"] = source.choice([1.4, 2.0])
    return keys


def bias_keys(source):
    keys = {"bias.constant": source.choice([0.0, 0.0, 0.002, 0.01, 0.05, 0.25]),
            "bias.slope": source.choice([0.0, 0.0, 0.004, 0.02])}
    if source.random() < 0.25:
        keys["bias.normal_texels"] = source.choice([0.5, 1.5])
    if source.random() < 0.25:
        keys["bias.slope_kernels"] = source.choice([0.5, 1.0])
    if source.random() < 0.15:
        keys["bias.constant_texels"] = source.choice([0.25, 1.0])
    return keys


# Bias terms beside constant and slope.
TERM_KEYS = ("bias.normal_texels", "bias.slope_kernels", "bias.constant_texels")


def view_keys(source, mesh_file):
    """A scene and a camera that looks down on it."""
    width, height = source.choice([(40, 28), (48, 32), (64, 40)])
    angle_x, angle_z = source.uniform(-3.5, 3.5), source.uniform(2.0, 4.0)
    job = {"scene.file": mesh_file, "image.width": width, "image.height": height,
           "camera.eye": [round(angle_x, 3), round(source.uniform(2.0, 4.0), 3), round(angle_z, 3)],
           "camera.target": [0.05, 0.3, 0.02]}
    if source.random() < 0.25:
        job["camera.orthographic_height"] = 3.5
    else:
        job["camera.vertical_fov_deg"] = 38.0
    return job


def random_job(source, mesh_file):
    """A job that varies every key of the chain's definition."""
    job = view_keys(source, mesh_file)
    job |= light_keys(source, source.random() < 0.5)
    job |= {"shadow_map.resolution": source.choice([8, 13, 16, 24, 32]),
            "shadow_map.depth_format": source.choice(["d16", "u8", "d24", "d32f"]),
            "shadow_map.roll_deg": source.choice([0.0, 17.0]),
            "shadow_map.cull": source.choice(["none", "none", "front", "back"]),
            "shadow_map.reversed": source.random() < 0.4,
            "lookup.filter": source.choice(["pcf3", "pcf3", "linear", "linear", "nearest", "pcf5"]),
            "lookup.outside": source.choice(["lit", "shadowed", "clamp"])}
    return job | bias_keys(source)


def random_point_job(source, mesh_file):
    """A job with a point light that varies every key of the chain's definition."""
    job = view_keys(source, mesh_file) | point_light_keys(source)
    job |= {"shadow_map.resolution": source.choice([12, 16, 24]),
            "shadow_map.depth_format": source.choice(["d16", "u8", "d24", "d32f"]),
            "shadow_map.cull": source.choice(["none", "none", "front", "back"]),
            "shadow_map.reversed": source.random() < 0.4,
            "lookup.filter": source.choice(["pcf3", "pcf5", "linear"]),
            "lookup.outside": source.choice(["lit", "shadowed", "clamp"])}
    return job | bias_keys(source)
