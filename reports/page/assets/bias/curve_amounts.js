// By how much verdicts are off at every bias, where they are fractions; docs/errors.md.

/** Amounts of error along one bias curve, between the biases that were stored of it. */
class CurveAmounts {
  /**
   * @param {TypedArray} biases  (points) ascending
   * @param {TypedArray} shadow  (points) [px]
   * @param {TypedArray} light  (points) [px]
   */
  constructor(biases, shadow, light) {
    Object.assign(this, { biases, shadow, light });
  }

  /**
   * Linear between two stored biases: of one to the next few pixels change, or where each costs a lookup, they are
   * close around the least amount; beyond them as at the last one.
   * @return {{shadow: number, light: number, isStored: boolean}}  isStored: at that bias itself
   */
  at(bias) {
    const { biases } = this;
    let above = 0;
    while (above < biases.length && biases[above] < bias) {
      ++above;
    }
    const high = Math.min(above, biases.length - 1);
    const low = Math.max(0, biases[high] > bias ? high - 1 : high);
    const share = high === low ? 0 : (bias - biases[low]) / (biases[high] - biases[low]);
    const between = (values) => values[low] + share * (values[high] - values[low]);
    return {
      shadow: between(this.shadow),
      light: between(this.light),
      isStored: biases[high] === bias || biases[low] === bias,
    };
  }
}

/**
 * @param {object} stored  "curves" of the page's data
 * @param {BlockReader} reader
 * @param {?string} id  of a curve
 * @return {Promise<?CurveAmounts>}  null where there is no such curve, or its amounts are its counts
 */
async function loadCurveAmounts(stored, reader, id) {
  if (id === null || !stored?.points?.columns?.some(({ name }) => name === "shadow_amount")) {
    return null;
  }
  const curves = new Table(stored, reader);
  const points = new Table(stored.points, reader);
  const ids = await curves.column("id");
  const place = Array.from(ids.values).findIndex((_, row) => ids.at(row) === id);
  if (place < 0) {
    return null;
  }
  const first = (await curves.column("first_point")).values[place];
  const end = first + (await curves.column("points")).values[place];
  const names = ["bias", "shadow_amount", "light_amount", "false_shadow", "false_lit"];
  const [biases, shadow, light, falseShadow, falseLit] = await Promise.all(
    names.map(async (name) => (await points.column(name)).values.subarray(first, end)),
  );
  // Amounts are float32 here, counts are whole.
  const isCount = (amount, count) => amount === Math.fround(count);
  const areCounts = shadow.every((_, i) => isCount(shadow[i], falseShadow[i]) && isCount(light[i], falseLit[i]));
  return areCounts ? null : new CurveAmounts(biases, shadow, light);
}
