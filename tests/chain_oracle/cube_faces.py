"""The six maps of a point light, by docs/point_lights.md: axes, matrices and texels beyond a side."""

NAMES = ("+x", "-x", "+y", "-y", "+z", "-z")

# The viewing direction of a face, and the directions in which u and v grow.
AXES = (
    ((1, 0, 0), (0, 0, -1), (0, -1, 0)),
    ((-1, 0, 0), (0, 0, 1), (0, -1, 0)),
    ((0, 1, 0), (1, 0, 0), (0, 0, 1)),
    ((0, -1, 0), (1, 0, 0), (0, 0, -1)),
    ((0, 0, 1), (1, 0, 0), (0, -1, 0)),
    ((0, 0, -1), (-1, 0, 0), (0, -1, 0)),
)
FORWARD = [axes[0] for axes in AXES]


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def exact_rows(face, position):
    """The rows of x, y and w of a face's matrix: 0, ±1 and the light's coordinates."""
    forward, u, v = AXES[face]
    return [[*axis, -dot(axis, position)] for axis in (u, v, forward)]


def beyond(index, count):
    """The number of texels by which an index lies outside 0 … count - 1."""
    return max(-index, index - (count - 1), 0)


def limited(index, count):
    return min(max(index, 0), count - 1)


def is_at_corner(x, y, count):
    """Whether it lies beyond two sides, where a cube has no texel."""
    return beyond(x, count) > 0 and beyond(y, count) > 0


def texel_over_seams(face, x, y, count):
    """The cube's texel, as (face, x, y), that a tap of a face reads.

    A tap beyond a side is folded onto the neighbour: it keeps its place along the shared side, and the distance beyond
    the side becomes the distance from it. Lengths are half texels from the light."""
    if is_at_corner(x, y, count):
        if beyond(x, count) >= beyond(y, count):
            y = limited(y, count)
        else:
            x = limited(x, count)
    if beyond(x, count) == 0 and beyond(y, count) == 0:
        return (face, x, y)
    forward, u, v = AXES[face]
    leads_over_u = beyond(x, count) > 0
    out, along = (u, v) if leads_over_u else (v, u)
    out_index, along_index = (x, y) if leads_over_u else (y, x)
    reach, shift = 2 * out_index + 1 - count, 2 * along_index + 1 - count
    side = 1 if reach > 0 else -1
    depth = 2 * count - abs(reach)
    centre = [count * side * out[k] + depth * forward[k] + shift * along[k] for k in range(3)]
    neighbour = FORWARD.index(tuple(side * value for value in out))
    _, new_u, new_v = AXES[neighbour]
    return (neighbour, *((dot(axis, centre) + count - 1) // 2 for axis in (new_u, new_v)))
