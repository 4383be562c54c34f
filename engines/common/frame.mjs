// What a page posted, as the channels of docs/evaluate.md.
import { writeExr } from "./exr.mjs";

/** Numbers by (x, y), rows from the top, of targets that hold four a pixel, rows from below. */
export function targetReader(values, width, height) {
  return (target, k) => (x, y) => values[4 * (target * width * height + (height - 1 - y) * width + x) + k];
}

/** Where nothing is seen all targets are NaN, which a mask and a number of an object cannot be. */
export function orZero(value) {
  return (x, y) => {
    const v = value(x, y);
    return Number.isNaN(v) ? 0 : v;
  };
}

/** The channels of a target that holds world position and mask. */
export function seenChannels(seen) {
  return { "P.X": seen(0, 0), "P.Y": seen(0, 1), "P.Z": seen(0, 2), "shadow.V": orZero(seen(0, 3)) };
}

const leastLight = 1e-6; // of 32-bit floats, where a white surface that faces the light has about 1: what is darker tells no share of it

/**
 * The mask of two of the engine's own pictures in 32-bit floats, of a white surface under this light alone: with shadows over
 * without. Where that is dark, or nothing is seen, nothing can be told, and the pixel is not `valid`.
 */
export function pictureChannels(shadowed, unshadowed, isSeen, width, height) {
  const [dark, light] = [shadowed, unshadowed].map((picture) => orZero(targetReader(picture, width, height)(0, 0)));
  const isTold = (x, y) => isSeen(x, y) && light(x, y) > leastLight;
  return {
    "shadow.V": (x, y) => (isTold(x, y) ? Math.min(Math.max(dark(x, y) / light(x, y), 0), 1) : 0),
    valid: (x, y) => (isTold(x, y) ? 1 : 0),
  };
}

/** Writes a frame of which world position and mask, or a mask alone, are known: the shader's own, or where there are pictures theirs. */
export function writeSeen(file, { frame, shadowed, unshadowed }, { width, height }) {
  const channels = frame ? seenChannels(targetReader(frame, width, height)) : {};
  const isSeen = (x, y) => !frame || Number.isFinite(channels["P.X"](x, y));
  const ofPictures = shadowed ? pictureChannels(shadowed, unshadowed, isSeen, width, height) : {};
  writeExr(file, width, height, { ...channels, ...ofPictures });
}
