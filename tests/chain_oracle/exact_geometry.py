"""Exact integer geometry of a small scene: pixel rays, shadow segments, texel rays, walks over the surface.

Every input is a dyadic rational, so a power of two scales the world to integers. Computed points are homogeneous, four
integers (x, y, z, w) with w > 0. Nothing is rounded.
"""

from collections import defaultdict
from fractions import Fraction


def sign(value):
    return (value > 0) - (value < 0)


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def times(factor, a):
    return (factor * a[0], factor * a[1], factor * a[2])


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def shift_of(values):
    """The exponent of the least power of two that scales all these floats to integers."""
    return max((float(value).as_integer_ratio()[1].bit_length() - 1 for value in values), default=0)


def scaled(values, shift):
    """Floats times 2^shift, which must be integers."""
    result = []
    for value in values:
        numerator, denominator = float(value).as_integer_ratio()
        assert (1 << shift) % denominator == 0
        result.append(numerator * ((1 << shift) // denominator))
    return tuple(result)


def homogeneous(numerator, denominator):
    """The point numerator / denominator with w > 0."""
    if denominator < 0:
        numerator, denominator = times(-1, numerator), -denominator
    return (*numerator, denominator)


class Mesh:
    """Triangles in scaled integers. Those with bit-equal corners share edges and corners."""

    def __init__(self, triangles, shift):
        self.shift = shift
        self.corners = [tuple(scaled(corner, shift) for corner in triangle) for triangle in triangles]
        self.normals = [cross(sub(b, a), sub(c, a)) for a, b, c in self.corners]
        self.at_edge = defaultdict(list)
        self.at_corner = defaultdict(list)
        for index, corners in enumerate(self.corners):
            for k in range(3):
                edge = frozenset((corners[k], corners[(k + 1) % 3]))
                self.at_edge[edge].append((index, corners[(k + 2) % 3]))
                self.at_corner[corners[k]].append(index)

    def point(self, world):
        return scaled(world, self.shift)


def receiver_point(mesh, triangle, eye, direction):
    """P = E + (nu/delta) d, the pixel ray's point in the triangle's plane. The direction may be scaled."""
    normal = mesh.normals[triangle]
    delta = dot(normal, direction)
    nu = dot(normal, sub(mesh.corners[triangle][0], eye))
    return homogeneous(add(times(delta, eye), times(nu, direction)), delta)


def edge_sides(corners, origin, direction):
    """The sides on which the line passes the edges: all equal inside, 0 on an edge. If the first two differ, the line
    misses, and there is no third."""
    a, b, c = sub(corners[0], origin), sub(corners[1], origin), sub(corners[2], origin)
    around_b = cross(direction, b)
    first, second = -sign(dot(around_b, a)), sign(dot(around_b, c))
    if first * second < 0:
        return (first, second)
    return (first, second, sign(dot(direction, cross(c, a))))


def passes_through_seam(mesh, triangle, sides, origin, direction, is_kept):
    """Whether a kept triangle lies on the other side of the one edge that the line meets."""
    k = sides.index(0)
    corners = mesh.corners[triangle]
    u, v, apex = corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]
    plane = cross(sub(v, u), direction)
    side = sign(dot(plane, sub(apex, u)))
    return any(other != triangle and is_kept(other) and sign(dot(plane, sub(other_apex, u))) == -side != 0
               for other, other_apex in mesh.at_edge[frozenset((u, v))])


def is_hit(mesh, triangle, origin, direction, is_kept):
    """Whether the line crosses the triangle, or passes through a seam with another kept triangle."""
    if not is_kept(triangle) or dot(mesh.normals[triangle], direction) == 0:
        return False
    sides = edge_sides(mesh.corners[triangle], origin, direction)
    if 1 in sides and -1 in sides:
        return False
    zeros = sides.count(0)
    return zeros == 0 or (zeros == 1 and passes_through_seam(mesh, triangle, sides, origin, direction, is_kept))


class TexelRay:
    """A texel's ray as integers, and the first triangle that it sees."""

    def __init__(self, origin, direction):
        self.origin = origin
        self.direction = direction
        self.triangle = None
        self.point = None
        self.depth = None


def trace(mesh, ray, is_kept, depth_of, only_forward):
    """Finds the first hit with a depth in [0, 1]; of equal hits that with the lowest index."""
    best = None
    for triangle in range(len(mesh.corners)):
        if not is_hit(mesh, triangle, ray.origin, ray.direction, is_kept):
            continue
        normal = mesh.normals[triangle]
        along = Fraction(dot(normal, sub(mesh.corners[triangle][0], ray.origin)), dot(normal, ray.direction))
        if (only_forward and along <= 0) or (best is not None and along >= best):
            continue
        point = homogeneous(add(times(along.denominator, ray.origin), times(along.numerator, ray.direction)),
                            along.denominator)
        depth = depth_of(point)
        if 0 <= depth <= 1:
            best, ray.triangle, ray.point, ray.depth = along, triangle, point, depth


class Light:
    """The exact light: a position, or the direction in which light travels."""

    def __init__(self, position=None, direction=None):
        self.position = position
        self.direction = direction

    def towards(self, point):
        """The direction from the point to the light. It ends at a positional light."""
        if self.position is None:
            return times(-1, self.direction)
        return sub(times(point[3], self.position), point[:3])

    def faces_front(self, mesh, triangle):
        """Whether the triangle is counter-clockwise from the light."""
        normal = mesh.normals[triangle]
        if self.position is None:
            return dot(normal, self.direction) < 0
        return dot(normal, sub(self.position, mesh.corners[triangle][0])) > 0


def crossings(mesh, receiver, point, light, is_kept):
    """The triangles that the open segment from the receiver to the light crosses, also at seams, as (s, triangle) with
    the crossing at point + s · towards. Only the s of one point are comparable. The second result says whether there
    is also a degenerate contact."""
    found = []
    is_degenerate = False
    towards = light.towards(point)
    base = point[:3] if light.position is None else light.position
    weight = point[3] if light.position is None else 1
    for triangle, corners in enumerate(mesh.corners):
        if triangle == receiver or not is_kept(triangle):
            continue
        normal = mesh.normals[triangle]
        gap = point[3] * dot(normal, corners[0]) - dot(normal, point[:3])
        reach = dot(normal, towards)
        if gap == 0 or reach == 0:
            is_degenerate = is_degenerate or (gap == 0 and reach == 0)
            continue
        # A positional light is at s = 1/w; gap and towards are both scaled by w.
        if sign(gap) != sign(reach) or (light.position is not None and abs(gap) >= abs(reach)):
            continue
        sides = edge_sides([times(weight, corner) for corner in corners], base, towards)
        if 1 in sides and -1 in sides:
            continue
        zeros = sides.count(0)
        origin_free = passes_through_seam(mesh, triangle, sides, None, towards, is_kept) if zeros == 1 else False
        if zeros == 0 or origin_free:
            found.append((Fraction(gap, reach), triangle))
        else:
            is_degenerate = True
    return found, is_degenerate


def point_on_way(point, light, s):
    """The point at parameter s of `crossings`."""
    towards = light.towards(point)
    numerator = add(times(s.denominator, point[:3]), times(s.numerator, towards))
    return homogeneous(numerator, point[3] * s.denominator)


class Walk:
    """Walks over the surface from a receiver towards a texel's ray, as seen from the light.

    The line is the plane through the receiver and the ray. A corner's side is +1 to its left, so a walk leaves a
    counter-clockwise triangle over the edge from right to left."""

    def __init__(self, mesh, light, receiver, point, ray):
        self.mesh = mesh
        self.light = light
        self.receiver = receiver
        self.ray = ray
        if light.position is None:
            self.line = cross(sub(times(point[3], ray.origin), point[:3]), ray.direction)
        else:
            self.line = cross(ray.direction, sub(point[:3], times(point[3], ray.origin)))

    def side(self, corner):
        return sign(dot(self.line, sub(corner, self.ray.origin)))

    def orientation(self, triangle):
        """+1 counter-clockwise from the light, -1 clockwise, 0 edge-on."""
        normal = self.mesh.normals[triangle]
        if self.light.position is None:
            return -sign(dot(normal, self.ray.direction))
        return sign(dot(normal, sub(self.ray.origin, self.mesh.corners[triangle][0])))

    def turned(self, triangle):
        """The corners, counter-clockwise from the light, and their sides of the line."""
        corners = self.mesh.corners[triangle]
        if self.orientation(triangle) < 0:
            corners = corners[::-1]
        return corners, tuple(self.side(corner) for corner in corners)

    def is_beyond(self, u, v):
        """The side of the texel's ray from an edge of a counter-clockwise triangle: +1 inside, 0 on the edge."""
        if self.light.position is None:
            return sign(dot(cross(sub(v, u), sub(self.ray.origin, u)), times(-1, self.ray.direction)))
        return -sign(dot(self.ray.direction, cross(sub(u, self.ray.origin), sub(v, self.ray.origin))))

    def reaches(self, wanted):
        """Whether the walk from the receiver's triangle enters the wanted one."""
        if wanted is None:
            return False
        open_ways, seen = [self.receiver], {self.receiver}
        while open_ways:
            triangle = open_ways.pop()
            if triangle == wanted:
                return True
            for following in self.continuations(triangle):
                if following not in seen:
                    seen.add(following)
                    open_ways.append(following)
        return False

    def continuations(self, triangle):
        if self.line == (0, 0, 0) or self.orientation(triangle) == 0:
            return []
        corners, sides = self.turned(triangle)
        for k in range(3):
            if sides[k] < 0 < sides[(k + 1) % 3]:
                return self.over_edge(triangle, corners[k], corners[(k + 1) % 3])
        for k in range(3):
            before, after = sides[k - 1], sides[(k + 1) % 3]
            if sides[k] == 0 and before <= 0 <= after and before != after:
                return self.through_corner(triangle, corners, k)
        # The line touches one corner, which is the receiver.
        return self.through_corner(triangle, corners, sides.index(0)) if 0 in sides else []

    def over_edge(self, triangle, u, v):
        if self.is_beyond(u, v) > 0:
            return []
        plane = cross(sub(v, u), self.ray.direction) if self.light.position is None else \
            cross(sub(u, self.ray.origin), sub(v, self.ray.origin))
        sides = {other: sign(dot(plane, sub(apex, u))) for other, apex in self.mesh.at_edge[frozenset((u, v))]}
        return [other for other, side in sides.items() if side == -sides[triangle] != 0]

    def through_corner(self, triangle, corners, k):
        """The triangles that the line enters at the corner; empty if the texel's ray comes first."""
        sides = (self.is_beyond(corners[k - 1], corners[k]), self.is_beyond(corners[k], corners[(k + 1) % 3]))
        if min(sides) >= 0 and max(sides) > 0:
            return []
        found = []
        for other in self.mesh.at_corner[corners[k]]:
            if other == triangle or self.orientation(other) == 0:
                continue
            around, line_sides = self.turned(other)
            at = around.index(corners[k])
            before, after = line_sides[at - 1], line_sides[(at + 1) % 3]
            if before >= 0 >= after and before != after:
                found.append(other)
        return found
