// Biases in metres and texels, as analysis::map_biases has them; docs/bias_curve.md#units.

/**
 * @param {object} frustum  as in the page's data
 * @param {number} bias  depth units
 * @param {number} lightDistanceM  distance from the light's camera plane [m]
 * @return {number}  how far the bias moves a receiver towards the light [m]
 */
function biasLengthM(frustum, bias, lightDistanceM) {
  if (!Number.isFinite(bias)) {
    return bias;
  }
  if (frustum.is_linear) {
    return bias * frustum.range_m;
  }
  const relative = frustum.inverse_range_per_m * bias * lightDistanceM;
  return relative <= -1 ? -Infinity : (relative * lightDistanceM) / (1 + relative);
}

/** @return {number}  world width of a texel at lightDistanceM [m] */
function texelWidthM(frustum, lightDistanceM) {
  return frustum.projection === "perspective" ? frustum.texel_m * lightDistanceM : frustum.texel_m;
}

/**
 * The bias that a lit pixel needs, or the largest that a blocked one allows.
 * @param {number} pixelClass
 * @param {number} critical  the pixel's critical bias
 * @return {number}  depth units, float32; NaN where the pixel is not scored
 */
function neededBias(pixelClass, critical) {
  if (!isScored(pixelClass)) {
    return NaN;
  }
  return pixelClass === classBlocked && critical !== Infinity ? previousBias(critical) : critical;
}

/**
 * Needed and allowed biases of every pixel.
 * @param {Uint8Array} classes  (pixels)
 * @param {Float32Array} criticals  (pixels)
 * @param {Float32Array} lightDistancesM  distances from the light's camera plane (pixels) [m]
 * @param {object} frustum
 * @return {{metres: Float32Array, texels: Float32Array}}  (pixels); NaN where nothing is scored
 */
function neededBiases(classes, criticals, lightDistancesM, frustum) {
  const metres = new Float32Array(classes.length).fill(NaN);
  const texels = new Float32Array(classes.length).fill(NaN);
  for (let i = 0; i < classes.length; ++i) {
    if (isScored(classes[i])) {
      const lengthM = biasLengthM(frustum, neededBias(classes[i], criticals[i]), lightDistancesM[i]);
      metres[i] = lengthM;
      texels[i] = lengthM / texelWidthM(frustum, lightDistancesM[i]);
    }
  }
  return { metres, texels };
}
