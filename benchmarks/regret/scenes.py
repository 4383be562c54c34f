"""Scenes of boxes, balls and sheets over ground, as OBJ files, and pairs of scenes. The second scene of a pair is the first
with its objects put into contact, or changed."""

import random
from dataclasses import dataclass
from pathlib import Path

import numpy

from comparisons import Scene

GROUND_M = 12.0  # the side of generated scenes' ground


def box(half):
    """Vertices and faces, counted from 0, of a box about the origin."""
    vertices = numpy.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float) * half
    faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
             (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
    return vertices, faces


def ball(radius, slices=32, stacks=16):
    """Vertices and faces of a sphere about the origin."""
    angles = [(numpy.pi * i / stacks, 2 * numpy.pi * j / slices) for i in range(stacks + 1) for j in range(slices)]
    vertices = radius * numpy.array([[numpy.sin(t) * numpy.cos(p), numpy.cos(t), numpy.sin(t) * numpy.sin(p)]
                                     for t, p in angles])
    faces = []
    for i in range(stacks):
        for j in range(slices):
            a, b = i * slices + j, i * slices + (j + 1) % slices
            faces += [(a, b, a + slices), (b, b + slices, a + slices)]
    return vertices, faces


def ground(side):
    half = 0.5 * side
    vertices = numpy.array([[-half, 0, -half], [half, 0, -half], [-half, 0, half], [half, 0, half]])
    return vertices, [(0, 2, 1), (1, 2, 3)]


def turned_about_y(vertices, angle):
    sine, cosine = numpy.sin(angle), numpy.cos(angle)
    return vertices @ numpy.array([[cosine, 0, -sine], [0, 1, 0], [sine, 0, cosine]])


def things(seed):
    """Eight boxes, balls and thin sheets at their places, with the lowest point at 0; and the gap of each above ground."""
    source = random.Random(seed)
    for index in range(8):
        size = source.uniform(0.25, 0.9)
        if index % 3 == 0:
            vertices, faces = ball(size)
        else:
            thickness = 0.05 if index % 3 == 2 else source.uniform(0.2, 0.9)
            vertices, faces = box([size, source.uniform(0.2, 1.2), thickness])
            vertices = turned_about_y(vertices, source.uniform(0, numpy.pi))
        place = numpy.array([source.uniform(-4, 4), -vertices[:, 1].min(), source.uniform(-4, 4)])
        yield vertices + place, faces, source.uniform(0.3, 1.5)


def write_obj(path, objects):
    """Writes objects of vertices and faces as groups."""
    lines, first = [], 1
    for index, (vertices, faces) in enumerate(objects):
        lines.append(f"o part_{index}")
        lines += [f"v {x:.7g} {y:.7g} {z:.7g}" for x, y, z in vertices]
        lines += [f"f {a + first} {b + first} {c + first}" for a, b, c in faces]
        first += len(vertices)
    path.write_text("\n".join(lines) + "\n")
    return path


def read_obj(path):
    """Vertices and triangles of an OBJ file, without groups."""
    vertices, faces = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            corners = [int(word.split("/")[0]) - 1 for word in words[1:]]
            faces += [(corners[0], corners[i], corners[i + 1]) for i in range(1, len(corners) - 1)]
    return numpy.array(vertices), faces


@dataclass(frozen=True)
class Pair:
    """A scene from which a bias is made, and another in which it is used."""

    kind: str  # "contact" or "changed"
    name: str
    first: Scene
    second: Scene


def plain_file(path):
    """A file with its own ground."""
    return Scene(path.stem, (str(path),), {}, Scene.file(path).contents)


def generated(folder, seed, gap_share):
    """The objects of a seed, each at a share of its gap above the ground."""
    objects = [(vertices + [0, gap_share * gap, 0], faces) for vertices, faces, gap in things(seed)]
    path = folder / f"things_{seed}_{'apart' if gap_share else 'down'}.obj"
    return plain_file(write_obj(path, [ground(GROUND_M), *objects]))


def lifted(folder, mesh, gap_share):
    """A mesh at a share of its height above a ground four times as wide."""
    vertices, faces = read_obj(mesh)
    lower, upper = vertices.min(axis=0), vertices.max(axis=0)
    middle = 0.5 * (lower + upper)
    shifted = vertices - [middle[0], lower[1] - gap_share * (upper - lower)[1], middle[2]]
    path = folder / f"{mesh.stem}_{'apart' if gap_share else 'down'}.obj"
    return plain_file(write_obj(path, [ground(4 * (upper - lower).max()), (shifted, faces)]))


def builtin(name, **parameters):
    return Scene(name, ("--builtin", name), {f"scene.{name}.{key}": value for key, value in parameters.items()})


def pairs(folder, meshes, seeds):
    """Pairs of objects put into contact, and of changed scenes. Generated files go into the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    found = [Pair("contact", "sphere-plane", builtin("sphere-plane"), builtin("sphere-plane", sphere_height_m=1)),
             Pair("contact", "sphere-cube", builtin("sphere-cube", sphere_distance_m=3),
                  builtin("sphere-cube", sphere_distance_m=1.6))]
    found += [Pair("contact", mesh.stem, lifted(folder, mesh, 0.2), lifted(folder, mesh, 0)) for mesh in meshes]
    for seed in seeds:
        apart = generated(folder, seed, 1)
        found.append(Pair("contact", apart.name, apart, generated(folder, seed, 0)))
        found.append(Pair("changed", apart.name, apart, generated(folder, seed + 1000, 1)))
    found += [Pair("changed", "terrain", builtin("terrain"), builtin("terrain", seed=8)),
              Pair("changed", "fence", builtin("fence"), builtin("fence", slat_width_m=0.08)),
              Pair("changed", "two-distances", builtin("two-distances"), builtin("two-distances", object_count=20)),
              Pair("changed", "wall", builtin("wall"), builtin("wall", thickness_m=0.1)),
              Pair("changed", "columns", builtin("columns"), builtin("columns", column_count=4))]
    return found


def meshes_in(folder, names):
    return [Path(folder) / name for name in names] if folder else []
