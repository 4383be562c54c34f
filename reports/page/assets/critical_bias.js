// Critical biases from depths, bit for bit as analysis::critical_bias; docs/bias_curve.md#critical-bias.

const floatScratch = new Float32Array(1);
const bitScratch = new Uint32Array(floatScratch.buffer);
/** Rank of the largest finite float32; infinity follows it. */
const largestBiasRank = 0x7f000000;
const largestSubnormalBits = 0x007fffff;

/** @return {number}  the bits of a float32 */
function bitsOfFloat(value) {
  floatScratch[0] = value;
  return bitScratch[0];
}

/** @return {number}  the float32 with these bits */
function floatOfBits(bits) {
  bitScratch[0] = bits;
  return floatScratch[0];
}

/**
 * Numbers the biases, 0 and the normal float32 of either sign, in ascending order without gaps.
 * A subnormal has the rank of 0.
 */
function biasRank(bias) {
  const bits = bitsOfFloat(bias);
  const magnitude = bits & 0x7fffffff;
  const rank = Math.max(0, magnitude - largestSubnormalBits);
  return bits >>> 31 ? -rank : rank;
}

/** The inverse of biasRank, for ranks in ±(largestBiasRank + 1). */
function biasOfRank(rank) {
  if (rank === 0) {
    return 0;
  }
  return floatOfBits(Math.abs(rank) + largestSubnormalBits + (rank < 0 ? 0x80000000 : 0));
}

/** The largest bias below `bias`; −∞ for −∞. */
function previousBias(bias) {
  const rank = biasRank(bias);
  return biasOfRank(rank < -largestBiasRank ? rank : rank - 1);
}

/** Whether fl(bias + addend) >= threshold: the lookup's comparison in either depth direction. */
function isLitWith(bias, addend, threshold) {
  return Math.fround(bias + addend) >= threshold;
}

/** The critical bias, in nearly every case; else NaN. Doubles guess, float32 tries the guess. */
function guessCriticalBias(addend, threshold) {
  const bits = bitsOfFloat(threshold);
  if ((bits & 0x7fffffff) >= 0x7f800000) {
    return NaN;
  }
  // A threshold of 0 is −0, so that the float below it is the next one of its sign.
  const below = floatOfBits(bits + (bits >>> 31 ? 1 : -1));
  let sum = Math.fround(0.5 * (threshold + below) - addend);
  if (!isLitWith(sum, addend, threshold)) {
    const sumBits = bitsOfFloat(sum);
    sum = sum === 0 ? floatOfBits(1) : floatOfBits(sum > 0 ? sumBits + 1 : sumBits - 1);
  }
  if (Number.isNaN(sum)) {
    return NaN;
  }
  const isSubnormal = (bitsOfFloat(sum) & 0x7fffffff) <= largestSubnormalBits;
  const rank = isSubnormal ? (sum > 0 ? 1 : 0) : biasRank(sum);
  const guess = biasOfRank(rank);
  const isRight =
    Math.abs(guess) < 2 ** 126 &&
    isLitWith(guess, addend, threshold) &&
    !isLitWith(biasOfRank(rank - 1), addend, threshold);
  return isRight ? guess : NaN;
}

/** The critical bias by bisection over the ordered biases. */
function searchCriticalBias(addend, threshold) {
  if (isLitWith(biasOfRank(-largestBiasRank), addend, threshold)) {
    return -Infinity;
  }
  let shadowed = -largestBiasRank;
  let lit = largestBiasRank + 1; // infinity: it stands for "none"
  while (lit - 1 > shadowed) {
    const middle = Math.floor((shadowed + lit) / 2);
    if (isLitWith(biasOfRank(middle), addend, threshold)) {
      lit = middle;
    } else {
      shadowed = middle;
    }
  }
  return biasOfRank(lit);
}

/**
 * The smallest bias with which a comparison is lit: fl(r − b) <= d, reversed fl(r + b) >= d.
 * @param {number} r  depth of the receiver, float32
 * @param {number} d  depth in the map, float32
 * @param {boolean} reversed
 * @return {number}  0 or a normal float32; −∞ every bias lights it, +∞ none does
 */
function criticalBias(r, d, reversed) {
  const addend = reversed ? r : -r;
  const threshold = reversed ? -(0 - d) : -d;
  const guess = guessCriticalBias(addend, threshold);
  return Number.isNaN(guess) ? searchCriticalBias(addend, threshold) : guess;
}

/**
 * The critical bias of each scored pixel, NaN elsewhere.
 * @param {Uint8Array} classes  (pixels)
 * @param {Float32Array} receiverDepths  (pixels)
 * @param {Float32Array} mapDepths  (pixels); NaN where the `outside` policy decided
 * @param {{reversed: boolean, outside: string}} rule
 * @return {Float32Array}  (pixels)
 */
function criticalBiases(classes, receiverDepths, mapDepths, rule) {
  const policy = rule.outside === "shadowed" ? Infinity : -Infinity;
  const result = new Float32Array(classes.length);
  for (let i = 0; i < result.length; ++i) {
    if (!isScored(classes[i])) {
      result[i] = NaN;
    } else {
      const d = mapDepths[i];
      result[i] = Number.isNaN(d) ? policy : criticalBias(receiverDepths[i], d, rule.reversed);
    }
  }
  return result;
}
