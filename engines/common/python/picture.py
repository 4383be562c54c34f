"""The mask of two of an engine's own pictures, of a white surface under this light alone: with shadows over without."""
import numpy

MASKS = ("shader", "picture")  # what a mask can be made of: what an adapter takes out of the engine's shader, or its pictures
# By the bits of a picture's channel the light below which a quotient tells no share. Floats and halves have all their bits above it.
LEAST_LIGHT = {32: 1e-6, 16: 2.0**-14, 8: 8 / 255}


def mask_of_pictures(shadowed, unshadowed, bits=32):
    """The planes `shadow`, from 0 to 1, and `valid`: 0 where it is too dark without shadows.

    @param shadowed, unshadowed  light by pixel, linear; 1 is about what a surface that faces the light has.
    @param bits  of each of their numbers.
    """
    is_told = unshadowed > LEAST_LIGHT[bits]
    share = numpy.divide(shadowed, unshadowed, where=is_told, out=numpy.zeros(shadowed.shape))
    return {"shadow": numpy.clip(share, 0, 1).astype(numpy.float32), "valid": is_told.astype(numpy.float32)}
