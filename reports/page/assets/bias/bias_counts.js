// Exact counts of wrong pixels at any bias, by binary search in sorted critical biases.

/** @return {number}  how many of the ascending values are at most `limit`; NaN stand last */
function countUpTo(sorted, limit) {
  let first = 0;
  let last = sorted.length;
  while (first < last) {
    const middle = (first + last) >>> 1;
    if (sorted[middle] <= limit) {
      first = middle + 1;
    } else {
      last = middle;
    }
  }
  return first;
}

const halfKeys = 0x10000;

/** Sorts keys by 16 of their bits, and leaves equal ones in their order. */
function sortByHalf(keys, shift) {
  const starts = new Uint32Array(halfKeys + 1);
  for (let i = 0; i < keys.length; ++i) {
    starts[((keys[i] >>> shift) & 0xffff) + 1] += 1;
  }
  for (let half = 0; half < halfKeys; ++half) {
    starts[half + 1] += starts[half];
  }
  const sorted = new Uint32Array(keys.length);
  for (let i = 0; i < keys.length; ++i) {
    sorted[starts[(keys[i] >>> shift) & 0xffff]++] = keys[i];
  }
  return sorted;
}

/**
 * Sorts float32 in ascending order, NaN last; several times faster than TypedArray.sort.
 * @param {Float32Array} values  overwritten
 * @return {Float32Array}
 */
function sortFloats(values) {
  for (let i = 0; i < values.length; ++i) {
    // One NaN for all: those with a sign would stand first. And one zero.
    values[i] = Number.isNaN(values[i]) ? NaN : values[i] + 0;
  }
  const bits = new Uint32Array(values.buffer, values.byteOffset, values.length);
  // With the sign turned, and negative numbers complemented, bits are in the order of their floats.
  const keys = bits.map((of) => (of >>> 31 ? ~of : of | 0x80000000));
  const sorted = sortByHalf(sortByHalf(keys, 0), 16);
  bits.set(sorted.map((key) => (key >>> 31 ? key & 0x7fffffff : ~key)));
  return values;
}

/** Counts wrong pixels: false shadow and false lit, for every constant bias. */
class BiasCounts {
  /**
   * @param {Uint8Array} classes  (pixels)
   * @param {Float32Array} criticals  (pixels)
   */
  constructor(classes, criticals) {
    this.lit = BiasCounts.sortedOf(classes, criticals, classLit);
    this.blocked = BiasCounts.sortedOf(classes, criticals, classBlocked);
  }

  static sortedOf(classes, criticals, pixelClass) {
    let count = 0;
    for (let i = 0; i < classes.length; ++i) {
      count += classes[i] === pixelClass ? 1 : 0;
    }
    const sorted = new Float32Array(count);
    for (let i = 0, to = 0; i < classes.length; ++i) {
      if (classes[i] === pixelClass) {
        sorted[to++] = criticals[i];
      }
    }
    return sortFloats(sorted);
  }

  /**
   * @param {number} bias  rounded to float32 first, as a job's is
   * @return {{falseShadow: number, falseLit: number}}
   */
  at(bias) {
    const limit = Math.fround(bias);
    return {
      falseShadow: this.lit.length - countUpTo(this.lit, limit),
      falseLit: countUpTo(this.blocked, limit),
    };
  }

  /** @return {{lowest: number, highest: number}}  of the finite critical biases; 0 and 0 if none */
  get finiteRange() {
    let lowest = 0;
    let highest = 0;
    for (const sorted of [this.lit, this.blocked]) {
      const first = countUpTo(sorted, -Infinity);
      let last = sorted.length;
      while (last > first && !Number.isFinite(sorted[last - 1])) {
        --last;
      }
      if (last > first) {
        lowest = Math.min(lowest, sorted[first]);
        highest = Math.max(highest, sorted[last - 1]);
      }
    }
    return { lowest, highest };
  }
}
