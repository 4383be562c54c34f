// Bins by light distance and by receiver angle, from the JSON of an image or from error_vs_z.

/**
 * A bin with lower and upper edge, rates, and the five numbers of needed bias and depth error.
 * @typedef {{lower: number, upper: number, lit: number, blocked: number, falseShadowRate: ?number,
 *            falseLitRate: ?number, needed: object, mapError: object, envelope: ?number}} Bin
 */

/** @return {Bin}  from a bin of `gnomon compare --json` */
function binOfJson(bin) {
  return {
    lower: bin.lower,
    upper: bin.upper,
    lit: bin.lit,
    blocked: bin.blocked,
    falseShadowRate: bin.false_shadow_rate,
    falseLitRate: bin.false_lit_rate,
    needed: bin.needed_bias ?? {},
    mapError: bin.map_error_m ?? {},
    envelope: bin.envelope_m ?? null,
  };
}

/** The bins of a curve in error_vs_z; decoded once for all curves. */
class DistanceBins {
  /**
   * @param {Table} table  error_vs_z
   * @param {Table} curves
   */
  constructor(table, curves) {
    this.table = table;
    this.curves = curves;
  }

  async load() {
    if (this.columns === undefined) {
      this.columns = await this.table.select(this.table.names);
      const { dictionary, values } = this.curves.has("id")
        ? await this.curves.column("id")
        : { dictionary: [], values: [] };
      this.curveOfId = new Map(Array.from(values, (text, index) => [dictionary[text], index]));
      this.rowsOf = new Map();
      const curve = this.columns.get("curve")?.values ?? [];
      const at = this.columns.get("at");
      for (let row = 0; row < this.table.count; ++row) {
        const key = `${curve[row]} ${at.at(row)}`;
        this.rowsOf.set(key, [...(this.rowsOf.get(key) ?? []), row]);
      }
    }
  }

  /**
   * The blocks of a curve: several cases may share it, each with a block at its own bias.
   * @param {?string} id  of a curve
   * @param {string} at  "job_bias" or "best_bias"
   * @return {Promise<{bias: number, bins: Bin[]}[]>}  one for each bias
   */
  async of(id, at) {
    await this.load();
    const value = (name, row) => this.columns.get(name)?.at(row) ?? null;
    const blocks = new Map();
    for (const row of this.rowsOf.get(`${this.curveOfId.get(id)} ${at}`) ?? []) {
      const bias = value("bias", row);
      blocks.set(bias, [...(blocks.get(bias) ?? []), this.bin((name) => value(name, row))]);
    }
    return [...blocks].map(([bias, bins]) => ({ bias, bins }));
  }

  bin(value) {
    const five = (stem) =>
      Object.fromEntries(
        ["count", "min", "median", "p95", "max"].map((name) => [name, value(`${stem}.${name}`)]),
      );
    return {
      lower: value("lower_m"),
      upper: value("upper_m"),
      lit: value("lit"),
      blocked: value("blocked"),
      falseShadowRate: value("false_shadow_rate"),
      falseLitRate: value("false_lit_rate"),
      needed: five("needed_bias"),
      mapError: five("map_error_m"),
      envelope: value("envelope_m"),
    };
  }
}

/**
 * The block at a configuration's own bias. A sweep's curve has one at the bias of the job without the axes, which
 * need not be that of any configuration.
 * @param {{bias: number, bins: Bin[]}[]} blocks  at "job_bias" of the configuration's curve
 * @param {?number} bias  constant bias of the configuration [depth units]; null: it is given in another unit
 * @param {string[]} axes  of the sweep
 * @return {?{bias: number, bins: Bin[]}}  null where there is none
 */
function ownBlock(blocks, bias, axes) {
  if (bias !== null) {
    return blocks.find((block) => Math.fround(block.bias) === Math.fround(bias)) ?? null;
  }
  const isSwept = axes.some((axis) => /(^|\.)bias\.constant/.test(axis));
  return blocks.length === 1 && !isSwept ? blocks[0] : null;
}
