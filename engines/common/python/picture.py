"""Computes the mask from two of the engine's pictures of white surfaces: the quotient with and without shadows."""
import numpy

MASKS = ("shader", "picture")  # the source of the mask: the engine's shader, or its pictures
# By bits of a channel: the light below which a quotient is too coarse. Above it, floats and halves have full precision.
LEAST_LIGHT = {32: 1e-6, 16: 2.0**-14, 8: 8 / 255}


def mask_of_pictures(shadowed, unshadowed, bits=32):
    """The planes `shadow`, from 0 to 1, and `valid`, 0 where the picture without shadows is too dark.

    @param shadowed, unshadowed  linear light by pixel; a surface that faces the light has about 1.
    @param bits  of each number.
    """
    is_told = unshadowed > LEAST_LIGHT[bits]
    share = numpy.divide(shadowed, unshadowed, where=is_told, out=numpy.zeros(shadowed.shape))
    return {"shadow": numpy.clip(share, 0, 1).astype(numpy.float32), "valid": is_told.astype(numpy.float32)}
