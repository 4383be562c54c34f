"""Additional views and lights of a job, by fixed formulas."""

import math
from dataclasses import dataclass

import numpy

VIEW_CAP_DEG = 60
LIGHT_TURN_DEG = 10


def radical_inverse(index, base):
    """Van der Corput's sequence: the digits of `index` mirrored behind the radix point."""
    value, scale = 0.0, 1.0
    while index > 0:
        index, digit = divmod(index, base)
        scale /= base
        value += digit * scale
    return value


def halton(index, bases):
    return tuple(radical_inverse(index, base) for base in bases)


def in_cap(axis, across, up, height, turn, cap_deg):
    """A direction within `cap_deg` of a unit axis: uniform over that cap for uniform `height` and `turn` in [0, 1)."""
    cosine = 1 - height * (1 - math.cos(math.radians(cap_deg)))
    sine = math.sqrt(1 - cosine * cosine)
    angle = 2 * math.pi * turn
    return cosine * axis + sine * (math.cos(angle) * across + math.sin(angle) * up)


@dataclass(frozen=True)
class Camera:
    """A camera with its axes: unit vectors, as the program uses them."""

    eye: numpy.ndarray
    target: numpy.ndarray
    forward: numpy.ndarray
    right: numpy.ndarray
    up: numpy.ndarray
    up_hint: tuple  # the job's camera.up
    lens: tuple     # the key of its opening angle or height, and the value

    def keys(self, eye=None):
        """The job's keys for this camera, or with another eye."""
        return {"camera.eye": list(map(float, self.eye if eye is None else eye)),
                "camera.target": list(map(float, self.target)), "camera.up": list(self.up_hint),
                self.lens[0]: self.lens[1]}

    def generated(self, index):
        """The keys of generated view 1, 2, ...: within 60 degrees of the camera's own line of sight, at its distance
        from the target times or by up to the root of 2."""
        a, b, c = halton(index, (2, 3, 5))
        towards_eye = in_cap(-self.forward, self.right, self.up, a, b, VIEW_CAP_DEG)
        distance_m = numpy.linalg.norm(self.target - self.eye) * 2 ** (c - 0.5)
        return self.keys(self.target + distance_m * towards_eye)


def turned(direction, index):
    """Direction 0 to 3, turned by 10 degrees from a light's own, a quarter turn apart."""
    axis = direction / numpy.linalg.norm(direction)
    across = numpy.cross(axis, (0, 1, 0))
    if numpy.linalg.norm(across) < 1e-3:
        across = numpy.cross(axis, (0, 0, 1))
    across /= numpy.linalg.norm(across)
    return in_cap(axis, across, numpy.cross(across, axis), 1, index / 4, LIGHT_TURN_DEG)
