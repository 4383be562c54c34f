// Causes and names of errors at the slider's bias, as far as those at the job's bias determine them; docs/causes.md.

/** Stands for the cause or the name of a wrong pixel where only the job's bias tells it. */
const unknownCode = 0xff;

const [causeBias, causePrecision, causeResolution, causeCoverage] = ["bias", "precision", "resolution", "coverage"].map(
  (name) => causeNames.indexOf(name),
);

/** Whether a verdict is one comparison with the depth of the texel that contains the receiver. */
function comparesOneTexel({ filter, detail }) {
  return filter === "nearest" && detail?.job?.["method.name"] === "depth" && detail.cause_arithmetic === "exact";
}

/**
 * Reads causes and names at any bias.
 *
 * Whether the maps without bias and without texels are right does not depend on the bias. Whether exact depths are
 * right does not either for a blocked pixel; for a lit one they are right from a smallest bias on. So a pixel that
 * is wrong at the job's bias, too, often keeps its cause. Of any other wrong pixel the page does not know it.
 */
class ErrorCauses {
  /** @param {PixelImage} image */
  constructor(image) {
    this.image = image;
    this.hasOneTexel = comparesOneTexel(image);
  }

  /** Whether the cause of a pixel that is wrong at the job's bias is the same at another bias, if it is wrong there. */
  keepsCause(index, bias) {
    const { image } = this;
    const cause = image.layers.cause[index];
    if (image.layers.class[index] === classBlocked || cause === causeBias) {
      return true;
    }
    return bias > image.jobBias ? cause === causePrecision : cause === causeResolution || cause === causeCoverage;
  }

  /** Likewise its name: of a lit pixel with one texel it tells what is seen there, unless the map covers nothing. */
  keepsLabel(index, bias) {
    const { image } = this;
    const cause = image.layers.cause[index];
    if (image.layers.class[index] === classBlocked || cause === causeBias) {
      return true;
    }
    if (cause === causeCoverage) {
      return bias < image.jobBias;
    }
    return this.hasOneTexel && (cause === causeResolution || (cause === causePrecision && bias > image.jobBias));
  }

  /** @return {number}  code of the cause at a float32 bias, 0 where the pixel is right, or `unknownCode` */
  causeAt(index, bias) {
    const { cause } = this.image.layers;
    if (bias === this.image.jobBias) {
      return cause[index];
    }
    const isKnown = this.isWrongAtBoth(index, bias) && this.keepsCause(index, bias);
    return isKnown ? cause[index] : this.unknownIfWrong(index, bias);
  }

  /** @return {number}  code of the name at a float32 bias, 0 where the pixel is right, or `unknownCode` */
  labelAt(index, bias) {
    const { label } = this.image.layers;
    if (bias === this.image.jobBias) {
      return label[index];
    }
    const isKnown = this.isWrongAtBoth(index, bias) && this.keepsLabel(index, bias);
    return isKnown ? label[index] : this.unknownIfWrong(index, bias);
  }

  isWrongAtBoth(index, bias) {
    return this.image.isWrongAt(index, bias) && this.image.isWrongAt(index, this.image.jobBias);
  }

  unknownIfWrong(index, bias) {
    return this.image.isWrongAt(index, bias) ? unknownCode : 0;
  }
}
