// Packed blocks, the filter's language, and the groups of a sweep.

import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { deflateSync } from "node:zlib";
import { loadScripts, seededRandom } from "./scripts.mjs";

const page = loadScripts(
  [
    "blocks.js", "tables/columns.js", "charts/bins.js", "bias/curve_amounts.js", "light_choice.js",
    "numbers.js", "tables/filter_language.js", "sweep_data.js", "charts/scales.js", "charts/bin_charts.js"
  ],
  [
    "BlockReader", "Table", "parseFilter", "resolveColumn", "filterRows", "axisOfColumn", "joinValues",
    "summariseGroups", "cellCodes", "paretoFront", "thinnedRows", "symlogLayout", "CurveAmounts",
    "DistanceBins", "LightChoice", "ownBlock", "noIndex", "arrayOfType", "neededRange", "depthErrorRange"
  ],
);

/** Packs values as the page's writer does. */
function pack(values, delta) {
  const size = values.BYTES_PER_ELEMENT;
  const whole = new { 1: Uint8Array, 2: Uint16Array, 4: Uint32Array, 8: BigUint64Array }[size](
    values.slice().buffer,
  );
  for (let pass = 0; pass < delta; ++pass) {
    for (let i = whole.length - 1; i > 0; --i) {
      whole[i] -= whole[i - 1];
    }
  }
  const bytes = new Uint8Array(whole.buffer);
  const planes = Uint8Array.from(
    bytes,
    (_, i) => bytes[(i % values.length) * size + Math.floor(i / values.length)],
  );
  return deflateSync(planes).toString("base64");
}

/** A table of number arrays and text arrays, by name. */
function tableOf(columns) {
  const texts = [];
  const stored = Object.entries(columns).map(([name, values]) => {
    const isText = typeof values[0] === "string" || values[0] === null;
    const dictionary = [...new Set(values.filter((value) => value !== null))];
    const packed = isText
      ? Uint32Array.from(values, (value) => (value === null ? page.noIndex : dictionary.indexOf(value)))
      : Float64Array.from(values);
    texts.push(pack(packed, 0));
    return {
      name,
      block: String(texts.length - 1),
      count: values.length,
      delta: 0,
      ...(isText ? { type: "text", dictionary } : { type: "f64" }),
    };
  });
  return new page.Table(
    { count: Object.values(columns)[0].length, columns: stored },
    new page.BlockReader((id) => texts[id]),
  );
}

describe("A packed block", () => {
  for (const [type, delta] of [
    ["u8", 0],
    ["u8", 1],
    ["u16", 2],
    ["u32", 1],
    ["u32", 2],
    ["f32", 0],
    ["f32", 1],
    ["f32", 2],
    ["f64", 0],
  ]) {
    it(`gives the same bits of ${type} after ${delta} differences`, async () => {
      const random = seededRandom(11);
      const bytes = Uint8Array.from({ length: 8 * 257 }, () => 256 * random());
      const values = new page.arrayOfType[type](bytes.buffer);
      const reader = new page.BlockReader(() => pack(values, delta));
      const read = await reader.read({ block: "b0", type, count: values.length, delta });
      assert.deepEqual(new Uint8Array(read.buffer), bytes);
    });
  }

  it("is decoded once", async () => {
    let asked = 0;
    const reader = new page.BlockReader(() => {
      asked += 1;
      return pack(Uint8Array.of(1, 2), 0);
    });
    const block = { block: "b0", type: "u8", count: 2, delta: 0 };
    assert.equal(await reader.read(block), await reader.read({ ...block }));
    assert.equal(asked, 1);
  });

  it("of another length is refused", async () => {
    const reader = new page.BlockReader(() => pack(Uint8Array.of(1, 2), 0));
    await assert.rejects(
      reader.read({ block: "b0", type: "u8", count: 3, delta: 0 }),
      /2 bytes for 3 values/,
    );
  });
});

describe("The filter", () => {
  const table = tableOf({
    false_lit: [5, 200, 50, NaN],
    "shadow_map.resolution": [512, 2048, 2048, 512],
    error_rate: [0.5, 0.002, 0.01, NaN],
    "lookup.filter": ["nearest", "pcf3", "nearest", null],
    "scene.file": ["a b.obj", "</script>", "ünïcode", "a.obj"],
  });
  const keeps = async (text) =>
    [
      ...(await page.filterRows(table, ["shadow_map.resolution", "lookup.filter", "scene.file"], text)),
    ].flatMap((kept, row) => (kept ? [row] : []));

  it("takes all rows where it is empty", async () => assert.deepEqual(await keeps("  "), [0, 1, 2, 3]));
  it("compares, with or without spaces, and joins terms", async () => {
    assert.deepEqual(await keeps("false_lit < 100 shadow_map.resolution=2048"), [2]);
    assert.deepEqual(await keeps("false_lit<100"), [0, 2]);
    assert.deepEqual(await keeps("error_rate <= 1%"), [1, 2]);
    assert.deepEqual(await keeps("resolution != 512"), [1, 2]);
  });
  it("finds words in texts whatever their case, and numbers whole", async () => {
    assert.deepEqual(await keeps("NEAR"), [0, 2]);
    assert.deepEqual(await keeps('"a b"'), [0]);
    assert.deepEqual(await keeps("2048"), [1, 2]);
    assert.deepEqual(await keeps("filter~pcf"), [1]);
    assert.deepEqual(await keeps("filter=nearest obj"), [0]);
    assert.deepEqual(await keeps('"</script>"'), [1]);
  });
  it("never takes a row without the value, but for !=", async () => {
    assert.deepEqual(await keeps("false_lit >= 0"), [0, 1, 2]);
    assert.deepEqual(await keeps("filter != nearest"), [1, 3]);
  });
  it("says what it does not understand", async () => {
    await assert.rejects(keeps("< 5"), /no column before/);
    await assert.rejects(keeps("false_lit <"), /no value after/);
    await assert.rejects(keeps("falselit < 5"), /no column “falselit”/);
    await assert.rejects(keeps("false_lit < many"), /is a number/);
    assert.throws(() => page.resolveColumn(["a.x", "b.x"], "x"), /may mean a.x or b.x/);
    assert.equal(
      page.resolveColumn(["causes.resolution", "shadow_map.resolution"], "resolution"),
      "shadow_map.resolution",
    );
  });
});

describe("A table's constants", () => {
  const table = new page.Table({ count: 2, columns: [] }, null, {
    "image.width": "96",
    id: "12345678",
    "scene.builtin": "wall",
  });

  it("are columns like others, numbers where they are numbers", async () => {
    assert.deepEqual(
      [(await table.column("image.width")).at(1), (await table.column("id")).at(0)],
      [96, "12345678"],
    );
    assert.deepEqual(table.names, []);
    assert.ok(table.has("scene.builtin") && !table.has("scene.file"));
  });

  it("can be filtered by", async () => {
    assert.deepEqual([...(await page.filterRows(table, [], "width=96 builtin~WALL"))], [1, 1]);
    assert.deepEqual([...(await page.filterRows(table, [], "width<96"))], [0, 0]);
  });
});

describe("Groups of a sweep", () => {
  it("have the median, of two values their mean, and the range", async () => {
    const table = tableOf({ axis: [2, 1, 2, 1, 2, NaN, 3, 3], error: [5, 1, 3, NaN, 4, 9, 2, 7] });
    const axis = page.axisOfColumn(await table.column("axis"));
    assert.deepEqual(axis.values, [1, 2, 3]);
    assert.deepEqual([...axis.codes], [1, 0, 1, 0, 1, -1, 2, 2]);
    const groups = page.summariseGroups((await table.column("error")).values, axis.codes, 3);
    assert.deepEqual(groups, [
      { median: 1, least: 1, most: 1, count: 1 },
      { median: 4, least: 3, most: 5, count: 3 },
      { median: 4.5, least: 2, most: 7, count: 2 },
    ]);
  });

  it("agree with sorting, for random rows", () => {
    const random = seededRandom(17);
    const values = Float64Array.from({ length: 500 }, () => (random() < 0.1 ? NaN : random()));
    const codes = Int32Array.from({ length: 500 }, () => Math.floor(8 * random()) - 1);
    page.summariseGroups(values, codes, 7).forEach((group, code) => {
      const part = [...values]
        .filter((value, row) => codes[row] === code && !Number.isNaN(value))
        .sort((a, b) => a - b);
      const [below, above] = [Math.ceil(part.length / 2) - 1, Math.floor(part.length / 2)];
      assert.deepEqual(group, {
        median: (part[below] + part[above]) / 2,
        least: part[0],
        most: part.at(-1),
        count: part.length,
      });
    });
  });

  it("join neighbouring values where there are too many", () => {
    const axis = {
      name: "x",
      isText: false,
      values: [...Array(10).keys()],
      codes: Int32Array.from(Array(10).keys()),
    };
    const joined = page.joinValues(axis, 3);
    assert.equal(joined.values.length, 3);
    assert.deepEqual([...joined.codes], [0, 0, 0, 0, 1, 1, 1, 2, 2, 2]);
    joined.values.forEach((value, group) => assert.equal(joined.codes[value], group));
  });

  it("have a cell for each pair of values", () => {
    const axis = (codes, count) => ({ values: Array(count), codes: Int32Array.from(codes) });
    assert.deepEqual([...page.cellCodes(axis([0, 1, -1], 2), axis([2, 0, 1], 3))], [2, 3, -1]);
  });
});

describe("The Pareto front", () => {
  it("is what no row beats, for random rows", () => {
    const random = seededRandom(23);
    const measure = () =>
      Float64Array.from({ length: 300 }, () => (random() < 0.05 ? NaN : Math.floor(40 * random())));
    const [first, second] = [measure(), measure()];
    const front = page.paretoFront(first, second);
    const beats = (a, b) =>
      first[a] <= first[b] && second[a] <= second[b] && (first[a] < first[b] || second[a] < second[b]);
    const rows = [...first.keys()].filter((row) => !Number.isNaN(first[row] + second[row]));
    const unbeaten = new Set(
      rows
        .filter((row) => !rows.some((other) => beats(other, row)))
        .map((row) => `${first[row]} ${second[row]}`),
    );
    assert.deepEqual(new Set(front.map((row) => `${first[row]} ${second[row]}`)), unbeaten);
    assert.equal(front.length, unbeaten.size);
  });

  it("has of equal rows the one that costs least", () => {
    const same = Float64Array.of(0.5, 0.5, 0.5);
    assert.deepEqual(page.paretoFront(same, same, Float64Array.of(4, 1, 1)), [1]);
    assert.deepEqual(page.paretoFront(same, same), [0]);
  });

  it("is empty without rows", () => {
    assert.deepEqual(page.paretoFront(Float64Array.of(NaN), Float64Array.of(1)), []);
    assert.deepEqual(page.thinnedRows(Float64Array.of(NaN), Float64Array.of(1), 10), []);
  });
});

describe("A symmetric logarithmic axis", () => {
  it("is undone by its inverse and rises everywhere", () => {
    const layout = page.symlogLayout(1e-3);
    const values = [-100, -1, -1e-3, -1e-5, 0, 1e-4, 1e-3, 2, 1e3];
    values.forEach((value) =>
      assert.ok(
        Math.abs(layout.inverse(layout.forward(value)) - value) <= 1e-12 * Math.abs(value),
        `${value}`,
      ),
    );
    values.slice(1).forEach((value, i) => assert.ok(layout.forward(value) > layout.forward(values[i])));
  });

  it("has ticks within its ends, 0 among them", () => {
    assert.deepEqual(page.symlogLayout(0.01).ticks(-1, 1), [-1, -0.1, -0.01, 0, 0.01, 0.1, 1]);
  });
});

describe("Amounts along a curve", () => {
  const amounts = new page.CurveAmounts(
    Float32Array.of(0, 0.25, 0.75),
    Float32Array.of(8, 4, 0),
    Float32Array.of(0, 0, 2),
  );

  it("are the stored ones at stored biases", () => {
    assert.deepEqual({ ...amounts.at(0) }, { shadow: 8, light: 0, isStored: true });
    assert.deepEqual({ ...amounts.at(0.25) }, { shadow: 4, light: 0, isStored: true });
    assert.deepEqual({ ...amounts.at(0.75) }, { shadow: 0, light: 2, isStored: true });
  });

  it("lie between two of them, and stay beyond", () => {
    assert.deepEqual({ ...amounts.at(0.5) }, { shadow: 2, light: 1, isStored: false });
    assert.deepEqual({ ...amounts.at(-1) }, { shadow: 8, light: 0, isStored: false });
    assert.deepEqual({ ...amounts.at(2) }, { shadow: 0, light: 2, isStored: false });
  });
});

describe("Errors by distance of a configuration", () => {
  const bins = new page.DistanceBins(
    tableOf({
      curve: [0, 0, 0, 0, 1],
      at: ["job_bias", "job_bias", "job_bias", "best_bias", "job_bias"],
      bias: [0.25, 0.25, 0.5, 0.75, 0.25],
      lower_m: [1, 2, 1, 1, 1],
      false_lit_rate: [0.1, 0.2, 0.3, 0.4, 0.5],
    }),
    tableOf({ id: ["a", "b"] }),
  );
  const ratesOf = (block) => block?.bins.map(({ falseLitRate }) => falseLitRate) ?? null;

  it("are a block for each bias of its curve", async () => {
    assert.deepEqual((await bins.of("a", "job_bias")).map(ratesOf), [[0.1, 0.2], [0.3]]);
    assert.deepEqual((await bins.of("a", "best_bias")).map(ratesOf), [[0.4]]);
    assert.deepEqual(await bins.of("b", "best_bias"), []);
    assert.deepEqual(await bins.of(null, "job_bias"), []);
  });

  it("are those at its own bias alone, not at the job's without the axes", async () => {
    const blocks = await bins.of("a", "job_bias");
    assert.deepEqual(ratesOf(page.ownBlock(blocks, 0.5, ["bias.constant"])), [0.3]);
    assert.equal(page.ownBlock(blocks, 0.006, ["bias.constant"]), null);
    const [one] = await bins.of("b", "job_bias");
    assert.equal(page.ownBlock([one], null, ["shadow_map.resolution"]), one);
    assert.equal(page.ownBlock([one], null, ["bias.constant_m"]), null);
    assert.equal(page.ownBlock([one], null, ["lights.sun.bias.constant"]), null);
    assert.equal(page.ownBlock(blocks, null, []), null);
  });
});

describe("The choice of a light", () => {
  it("keeps all that the axes say otherwise", async () => {
    const shown = [];
    const choice = new page.LightChoice(
      tableOf({
        "bias.slope": [0, 0, 1, 1, 2],
        "lights.sun.bias.constant": [5, 5, 6, 6, 5],
        light: ["sun", "lamp", "sun", "lamp", "sun"],
      }),
      ["bias.slope", "lights.sun.bias.constant", "light"],
      (row) => shown.push(row),
    );
    await choice.load();
    choice.row = 2;
    choice.choose("lamp");
    choice.row = 1;
    choice.choose("sun");
    choice.row = 4; // whose lamp was not measured here
    choice.choose("lamp");
    assert.deepEqual(shown, [3, 0]);
  });
});

describe("The ranges of charts by distance", () => {
  const bin = (needed, min, max, envelope) => ({
    needed: { p95: needed, median: 0 },
    mapError: { min, max },
    envelope,
  });
  const own = [bin(0.002, -0.5, 0.25, 0.001)];
  const best = [bin(-0.004, -0.125, 1, 0.003), bin(null, null, null, null)];

  it("hold the bins of both biases", () => {
    assert.deepEqual(page.neededRange([...own, ...best]), { low: -0.004, high: 0.002 });
    assert.deepEqual(page.depthErrorRange([...own, ...best]), { largest: 1, envelope: 0.003, smallest: 0.001 });
  });

  it("take errors to both sides", () => {
    assert.equal(page.depthErrorRange(own).largest, 0.5);
  });

  it("leave out biases that are infinite or missing", () => {
    const range = page.neededRange([bin(Infinity, 0, 0, 0), ...best]);
    assert.deepEqual(range, { low: -0.004, high: 0 });
  });
});
