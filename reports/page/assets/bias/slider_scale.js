// The bias slider's positions: negative, zero, positive, each side logarithmic from the format's step on.

const negativePositions = 600;
const positivePositions = 1400;

/** Maps whole positions from −600 to 1400 to float32 biases; position 0 is the bias 0. */
class SliderScale {
  /**
   * @param {number} step  the depth format's step, depth units; > 0
   * @param {{lowest: number, highest: number}} range  of the biases that matter
   */
  constructor(step, range) {
    this.step = step;
    // At least a decade on each side, and never beyond what a depth can make up for.
    this.negativeDecades = SliderScale.decades(step, -range.lowest);
    this.positiveDecades = SliderScale.decades(step, range.highest);
  }

  static decades(step, end) {
    return Math.max(1, Math.log10(Math.min(Math.max(end, 10 * step), 16) / step));
  }

  get lowestPosition() {
    return -negativePositions;
  }

  get highestPosition() {
    return positivePositions;
  }

  /** @return {number}  the float32 bias at a whole position */
  biasAt(position) {
    return Math.fround(this.realAt(position));
  }

  /** @return {number}  the bias at any position; linear within a position of 0 */
  realAt(position) {
    const [side, decades] =
      position < 0 ? [negativePositions, this.negativeDecades] : [positivePositions, this.positiveDecades];
    const places = Math.abs(position);
    const size = places < 1 ? places * this.step : this.step * 10 ** ((decades * (places - 1)) / (side - 1));
    return position < 0 ? -size : size;
  }

  /** @return {number}  where a bias stands, a real number within the slider's ends */
  positionOf(bias) {
    const size = Math.abs(bias);
    const [side, decades] =
      bias < 0 ? [negativePositions, this.negativeDecades] : [positivePositions, this.positiveDecades];
    const places =
      size < this.step ? size / this.step : 1 + ((side - 1) * Math.log10(size / this.step)) / decades;
    const position = Math.min(side, places);
    return bias < 0 ? -position : position;
  }
}
