// An image of the page with what follows from its layers.

/** The layers of one configuration's pixels, decoded and derived. */
class PixelImage {
  /**
   * @param {object} stored  an entry of "images" in the page's data
   * @param {Object<string, TypedArray>} layers  decoded, each (width × height), row 0 at the top
   */
  constructor(stored, layers) {
    Object.assign(this, {
      row: stored.row,
      width: stored.width,
      height: stored.height,
      step: stored.step,
      layers,
      frustum: stored.frustum,
      objects: stored.objects,
      detail: stored.detail,
      filter: stored.filter,
      jobBias: Math.fround(stored.bias_constant),
      depthStep: stored.depth_step,
      derive: stored.derive,
    });
    this.deriveLayers();
    /** @type {?CurveAmounts}  of the image's curve, where verdicts are fractions */
    this.amounts = null;
    this.counts = this.hasCurve ? new BiasCounts(layers.class, layers.critical_bias) : null;
  }

  /** Whether other biases than the job's are known. */
  get hasCurve() {
    return this.layers.critical_bias !== undefined;
  }

  deriveLayers() {
    const { layers, derive, frustum } = this;
    if (layers.critical_bias_steps !== undefined) {
      layers.critical_bias = criticalBiases(layers, frustum.reversed);
    }
    if (layers.critical_bias !== undefined && (derive.needed_bias_m || derive.needed_bias_texels)) {
      const { metres, texels } = neededBiases(
        layers.class,
        layers.critical_bias,
        layers.light_distance_m,
        frustum,
      );
      layers.needed_bias_m ??= metres;
      layers.needed_bias_texels ??= texels;
    }
  }

  /** Median light distance of the scored pixels [m]; NaN without any. */
  get medianDistanceM() {
    this.knownMedianM ??= medianOf(this.layers.light_distance_m ?? []);
    return this.knownMedianM;
  }

  /** @return {boolean}  whether the shadow map says that a pixel is lit, at a float32 bias */
  isShownLit(index, bias) {
    return this.litFrom[index] <= bias;
  }

  /**
   * From which bias on each pixel is shown lit; (pixels). The verdict of one that is not scored is the job's at
   * every bias.
   */
  get litFrom() {
    this.knownLitFrom ??= litFromOf(this.layers);
    return this.knownLitFrom;
  }

  /** @return {boolean}  whether a scored pixel's verdict is wrong at a float32 bias */
  isWrongAt(index, bias) {
    const pixelClass = this.layers.class[index];
    return pixelClass === classLit
      ? this.litFrom[index] > bias
      : pixelClass === classBlocked && this.litFrom[index] <= bias;
  }

  /** By how much verdicts are off at a bias, where there are fractions: `amounts` must be known. */
  amountsAt(bias) {
    const { shadow_amount: shadow, light_amount: light } = this.detail;
    return bias === this.jobBias ? { shadow, light, isStored: true } : this.amounts.at(bias);
  }

  /** Whether counts at a bias are exact: of thinned pixels at the job's alone. */
  isCountedAt(bias) {
    return this.step === 1 || bias === this.jobBias;
  }

  /** Wrong pixels at a bias; of an image without a curve, at the job's. */
  countsAt(bias) {
    if (this.counts === null || (this.step > 1 && bias === this.jobBias)) {
      return { falseShadow: this.detail.false_shadow, falseLit: this.detail.false_lit };
    }
    const counts = this.counts.at(bias);
    return this.step === 1 ? counts : this.countsOfAll(counts);
  }

  /** Estimates counts of all pixels from those of the thinned ones. */
  countsOfAll({ falseShadow, falseLit }) {
    const { lit, blocked } = this.detail.pixels;
    const scaled = (count, part, whole) => (part === 0 ? 0 : Math.round((count * whole) / part));
    return {
      falseShadow: scaled(falseShadow, this.counts.lit.length, lit),
      falseLit: scaled(falseLit, this.counts.blocked.length, blocked),
    };
  }
}

/** From which bias on each pixel is shown lit; (pixels). */
function litFromOf({ class: classes, critical_bias: criticals, verdict }) {
  const thresholds = new Float32Array(verdict.length);
  for (let i = 0; i < thresholds.length; ++i) {
    const atEveryBias = verdict[i] >= 0.5 ? -Infinity : Infinity;
    thresholds[i] = criticals !== undefined && isScored(classes[i]) ? criticals[i] : atEveryBias;
  }
  return thresholds;
}

/** The middle of the numbers that are none of them NaN; of an even number the mean of both in the middle. */
function medianOf(values) {
  const sorted = Float32Array.from(values)
    .filter((value) => !Number.isNaN(value))
    .sort();
  const last = sorted.length >>> 1;
  if (sorted.length % 2 === 1) {
    return sorted[last];
  }
  return sorted.length === 0 ? NaN : (sorted[last - 1] + sorted[last]) / 2;
}

/**
 * @param {object} stored  an entry of "images"
 * @param {BlockReader} reader
 * @return {Promise<PixelImage>}
 */
async function loadImage(stored, reader) {
  const names = Object.keys(stored.layers);
  const decoded = await Promise.all(names.map((name) => reader.read(stored.layers[name])));
  return new PixelImage(stored, Object.fromEntries(names.map((name, i) => [name, decoded[i]])));
}
