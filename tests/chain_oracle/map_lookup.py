"""The settings of lookups, and GL's lookup of one pixel: its taps and the texels that they read."""

import copy
from fractions import Fraction

import numpy

import cube_faces

FLOAT_HALF = numpy.float32(0.5)


class Settings:
    """The keys of a job that decide lookups."""

    def __init__(self, job, is_cube):
        self.is_cube = is_cube
        self.resolution = job["shadow_map.resolution"]
        self.filter = job["lookup.filter"]
        self.taps = int(self.filter[3:]) if self.filter.startswith("pcf") else 1
        self.outside = job["lookup.outside"]
        self.is_reversed = job["shadow_map.reversed"]
        self.border_is_lit = self.outside == "lit"

    def is_lit(self, receiver, stored):
        return bool(receiver >= stored if self.is_reversed else receiver <= stored)

    def biased_float(self, receiver, bias):
        return numpy.float32(receiver + bias if self.is_reversed else receiver - bias)

    def biased_exactly(self, receiver, bias):
        return receiver + Fraction(float(bias)) if self.is_reversed else receiver - Fraction(float(bias))

    def border_depth(self):
        """The depth of a texel outside the map, with linear."""
        return 0 if self.border_is_lit == self.is_reversed else 1


def rounded_down(value):
    """The largest float32 up to a Fraction."""
    nearest = numpy.float32(float(value))
    while Fraction(float(nearest)) > value:
        nearest = numpy.nextafter(nearest, numpy.float32(-numpy.inf))
    return nearest


class Lookup:
    """GL's lookup of a pixel: its map, receiver depth, uv · resolution, and the centre tap's depth.

    A tap is a column and a row, which may lie outside the map. A texel is a map, a column and a row."""

    def __init__(self, settings, receiver_depth, x, y, map_depth, map_index=0):
        self.settings = settings
        self.map_index = map_index
        self.x, self.y = x, y
        self.map_depth = map_depth
        r = numpy.float32(receiver_depth)
        reverse = settings.is_reversed
        self.is_at_far = bool(r <= 0 if reverse else r >= 1)
        beyond = bool(r < 0 if reverse else r > 1)
        self.is_beyond_far = beyond and settings.outside != "clamp"
        self.depth = min(max(r, numpy.float32(0)), numpy.float32(1)) if settings.outside == "clamp" else r

    def at(self, place):
        """The lookup at an exact place, rounded down so that it stays between the same centres and borders."""
        x, y = (rounded_down(value) for value in place)
        if self.settings.is_cube:
            last = numpy.nextafter(numpy.float32(self.settings.resolution), numpy.float32(0))
            x, y = (min(max(value, numpy.float32(0)), last) for value in (x, y))
        moved = copy.copy(self)
        moved.x, moved.y = x, y
        return moved

    def centre(self):
        """The tap that contains uv · resolution. A seam belongs to the chosen face."""
        tap = (int(numpy.floor(self.x)), int(numpy.floor(self.y)))
        if self.settings.is_cube:
            return tuple(min(index, self.settings.resolution - 1) for index in tap)
        return tap

    def corner(self):
        """The lower left tap of linear."""
        return tuple(int(numpy.floor(value - FLOAT_HALF)) for value in (self.x, self.y))

    def square(self):
        """The lower left tap and the width of the footprint."""
        if self.settings.filter == "linear":
            return *self.corner(), 2
        x, y = self.centre()
        half = self.settings.taps // 2
        return x - half, y - half, self.settings.taps

    def footprint(self):
        if self.settings.filter == "linear":
            return list(self.bilinear(0, 0))
        left, bottom, width = self.square()
        return [(left + i, bottom + j) for j in range(width) for i in range(width)]

    def bilinear(self, x, y):
        """The taps of linear and their weights, at a place in the square between their centres.

        At a cube's corner three texels meet, and share the fourth's weight."""
        left, bottom = self.corner()
        weights = {(left + i, bottom + j): (x if i else 1 - x) * (y if j else 1 - y) for j in (0, 1) for i in (0, 1)}
        if self.settings.is_cube:
            for tap in [tap for tap in weights if cube_faces.is_at_corner(*tap, self.settings.resolution)]:
                missing = weights.pop(tap)
                weights = {other: weight + Fraction(missing) / 3 for other, weight in weights.items()}
        return weights

    def weight(self, tap):
        """A tap's share of the footprint: 1 for a mean of taps, bilinear for linear."""
        if self.settings.filter != "linear":
            return Fraction(1)
        place = (Fraction(float(value - FLOAT_HALF)) - index for value, index in zip((self.x, self.y), self.corner()))
        return self.bilinear(*place)[tap]

    def ring(self):
        """The footprint and the taps around it."""
        left, bottom, width = self.square()
        return [(left + i, bottom + j) for j in range(-1, width + 1) for i in range(-1, width + 1)]

    def texel_at(self, tap):
        """The texel at a tap; None outside the map. A cube has no outside."""
        count = self.settings.resolution
        if self.settings.is_cube:
            return cube_faces.texel_over_seams(self.map_index, *tap, count)
        return (self.map_index, *tap) if 0 <= tap[0] < count and 0 <= tap[1] < count else None

    def resolve(self, tap):
        """The texel that is looked up; None if the border mode decides."""
        if self.settings.outside == "clamp":
            count = self.settings.resolution
            return self.texel_at(tap) or (self.map_index, *(min(max(index, 0), count - 1) for index in tap))
        return None if self.is_beyond_far else self.texel_at(tap)

    def is_decided_by_border(self):
        """Whether the border mode decides the whole lookup."""
        return all(self.resolve(tap) is None for tap in self.footprint())
