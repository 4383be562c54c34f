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

/** Writes a frame of which world position and mask are known alone. */
export function writeSeen(file, { frame }, { width, height }) {
  writeExr(file, width, height, seenChannels(targetReader(frame, width, height)));
}
