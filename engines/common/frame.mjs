// Turns posted data into the channels of docs/evaluate.md.
import { writeExr } from "./exr.mjs";

/** Reads targets of four numbers a pixel with the bottom row first, by (x, y) from the top. */
export function targetReader(values, width, height) {
  return (target, k) => (x, y) => values[4 * (target * width * height + (height - 1 - y) * width + x) + k];
}

/** Replaces NaN, the background of all targets, for masks and object numbers. */
export function orZero(value) {
  return (x, y) => {
    const v = value(x, y);
    return Number.isNaN(v) ? 0 : v;
  };
}

/** The channels of a target with world position and mask. */
export function seenChannels(seen) {
  return { "P.X": seen(0, 0), "P.Y": seen(0, 1), "P.Z": seen(0, 2), "shadow.V": orZero(seen(0, 3)) };
}

const leastLight = 1e-6; // darker pixels are too coarse for a quotient; a white surface that faces the light has about 1

/**
 * The mask from two of the engine's pictures of white surfaces: the quotient with and without shadows. Pixels that are dark
 * without shadows, or show background, are not `valid`.
 */
export function pictureChannels(shadowed, unshadowed, isSeen, width, height) {
  const [dark, light] = [shadowed, unshadowed].map((picture) => orZero(targetReader(picture, width, height)(0, 0)));
  const isTold = (x, y) => isSeen(x, y) && light(x, y) > leastLight;
  return {
    "shadow.V": (x, y) => (isTold(x, y) ? Math.min(Math.max(dark(x, y) / light(x, y), 0), 1) : 0),
    valid: (x, y) => (isTold(x, y) ? 1 : 0),
  };
}

/** Writes a frame with a mask from the shader or from pictures, and world positions if they are known. */
export function writeSeen(file, { frame, shadowed, unshadowed }, { width, height }) {
  const channels = frame ? seenChannels(targetReader(frame, width, height)) : {};
  const isSeen = (x, y) => !frame || Number.isFinite(channels["P.X"](x, y));
  const ofPictures = shadowed ? pictureChannels(shadowed, unshadowed, isSeen, width, height) : {};
  writeExr(file, width, height, { ...channels, ...ofPictures });
}
