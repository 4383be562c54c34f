// The order of the biases that a lookup takes, as analysis/lookup/bias_order.hpp has it.

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

/**
 * The critical bias of each scored pixel, NaN elsewhere: so many steps, in the order of biases, from the
 * difference of the pixel's two depths.
 * @param {object} layers  "class", "receiver_depth", "map_depth", "critical_bias_steps" (pixels)
 * @param {boolean} reversed  whether the map's depth is
 * @return {Float32Array}  (pixels)
 */
function criticalBiases(layers, reversed) {
  const { class: classes, receiver_depth: receiverDepths, map_depth: mapDepths } = layers;
  const result = new Float32Array(classes.length).fill(NaN);
  for (let i = 0; i < result.length; ++i) {
    if (isScored(classes[i])) {
      const above = Math.fround(receiverDepths[i] - mapDepths[i]);
      const start = Number.isFinite(above) ? biasRank(reversed ? -above : above) : 0;
      result[i] = biasOfRank((start + layers.critical_bias_steps[i]) | 0);
    }
  }
  return result;
}
