// The order, units and counts of biases agree with their definitions in float32.

import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { loadScripts, seededRandom } from "./scripts.mjs";

const page = loadScripts(
  [
    "image/pixel_names.js", "bias/bias_order.js", "bias/bias_units.js", "bias/bias_counts.js", "numbers.js",
    "bias/slider_scale.js", "image/image_data.js"
  ],
  [
    "criticalBiases", "previousBias", "biasRank", "biasOfRank", "biasLengthM", "neededBiases", "BiasCounts",
    "PixelImage", "sortFloats", "SliderScale", "shortestFloat32", "percent", "groupedAmount"
  ],
);

describe("Critical biases", () => {
  it("are so many steps from the depths' difference, for random depths and biases", () => {
    const random = seededRandom(20261124);
    const special = [0, -0, NaN, Infinity, 2 ** -140, 1];
    const depth = () => (random() < 0.3 ? special[Math.floor(special.length * random())] : random());
    for (const reversed of [false, true]) {
      const count = 2000;
      const layers = {
        class: Uint8Array.from({ length: count }, () => Math.floor(7 * random())),
        receiver_depth: Float32Array.from({ length: count }, depth),
        map_depth: Float32Array.from({ length: count }, depth),
      };
      const ranks = Int32Array.from({ length: count }, () => Math.floor((2 * random() - 1) * 0x7f000002));
      layers.critical_bias_steps = Uint32Array.from(ranks, (rank, i) => {
        const above = Math.fround(layers.receiver_depth[i] - layers.map_depth[i]);
        const difference = reversed ? -above : above;
        const isNormal = Number.isFinite(difference) && Math.abs(difference) >= 2 ** -126;
        return rank - (isNormal ? page.biasRank(difference) : 0);
      });
      page.criticalBiases(layers, reversed).forEach((critical, i) => {
        const wanted = layers.class[i] === 5 || layers.class[i] === 6 ? page.biasOfRank(ranks[i]) : NaN;
        assert.ok(Object.is(critical, wanted), `pixel ${i}: ${critical}, not ${wanted}`);
      });
    }
  });
});

describe("The order of biases", () => {
  it("has no gaps, and no subnormals", () => {
    const smallestNormal = 2 ** -126;
    assert.equal(page.previousBias(smallestNormal), 0);
    assert.equal(page.previousBias(0), -smallestNormal);
    assert.equal(page.previousBias(-Infinity), -Infinity);
    const random = seededRandom(1);
    for (let i = 0; i < 1000; ++i) {
      const rank = Math.floor((2 * random() - 1) * 0x7f000000);
      assert.equal(page.biasRank(page.biasOfRank(rank)), rank);
      assert.ok(page.previousBias(page.biasOfRank(rank)) < page.biasOfRank(rank), `rank ${rank}`);
    }
  });
});

describe("Lengths of biases", () => {
  const orthographic = { projection: "orthographic", is_linear: true, range_m: 20, texel_m: 0.5 };
  const perspective = { projection: "perspective", inverse_range_per_m: 2, texel_m: 0.01 };

  it("are the range's share of a directional light", () => {
    assert.equal(page.biasLengthM(orthographic, 0.25, 3), 5);
  });

  it("follow A b ζ² / (1 + A b ζ) of a spot, to minus infinity", () => {
    assert.equal(page.biasLengthM(perspective, 0.25, 2), 1);
    assert.equal(page.biasLengthM(perspective, -0.25, 2), -Infinity);
    assert.equal(page.biasLengthM(perspective, Infinity, 2), Infinity);
  });

  it("take the bias below the critical one for blocked pixels, and none elsewhere", () => {
    const critical = new Float32Array(4).fill(0.25);
    critical[3] = Infinity;
    const { metres, texels } = page.neededBiases(
      Uint8Array.of(5, 6, 2, 6),
      critical,
      new Float32Array(4).fill(1),
      orthographic,
    );
    const below = Math.fround(20 * page.previousBias(0.25));
    assert.deepEqual([...metres], [5, below, NaN, Infinity]);
    assert.deepEqual([...texels], [10, Math.fround((20 * page.previousBias(0.25)) / 0.5), NaN, Infinity]);
  });
});

describe("Counts at a bias", () => {
  it("sort as TypedArray.sort does, for random bits of floats", () => {
    const random = seededRandom(9);
    for (const count of [0, 1, 2, 5000]) {
      const bits = Uint32Array.from({ length: count }, () => 2 ** 32 * random());
      bits.set([0x7fc00000, 0xffc00001, 0x80000000, 0, 0x7f800000, 0xff800000].slice(0, count));
      const values = new Float32Array(bits.buffer);
      const wanted = [...values.slice().sort()].map((value) => (value === 0 ? 0 : value));
      assert.deepEqual([...page.sortFloats(values)], wanted, `${count} values`);
    }
  });

  it("are those of counting every pixel, for random images and biases", () => {
    const random = seededRandom(3);
    for (let round = 0; round < 50; ++round) {
      const classes = Uint8Array.from({ length: 200 }, () => Math.floor(7 * random()));
      const special = [-Infinity, Infinity, 0, NaN];
      const criticals = Float32Array.from({ length: 200 }, () =>
        random() < 0.2 ? special[Math.floor(4 * random())] : random() - 0.5,
      );
      const counts = new page.BiasCounts(classes, criticals);
      for (const bias of [random() - 0.5, criticals[Math.floor(200 * random())], 0]) {
        const limit = Math.fround(bias);
        const count = (wanted, lit) =>
          classes.reduce((sum, of, i) => sum + (of === wanted && criticals[i] <= limit === lit ? 1 : 0), 0);
        assert.deepEqual(
          counts.at(bias),
          { falseShadow: count(5, false), falseLit: count(6, true) },
          `round ${round}, bias ${bias}`,
        );
      }
    }
  });
});

describe("The slider", () => {
  const scale = new page.SliderScale(2 ** -24, { lowest: -0.1, highest: 0.5 });

  it("has the bias 0 at position 0, and biases that rise with it", () => {
    assert.equal(scale.biasAt(0), 0);
    for (let position = scale.lowestPosition; position < scale.highestPosition; ++position) {
      assert.ok(scale.biasAt(position) < scale.biasAt(position + 1), `position ${position}`);
    }
  });

  it("finds the position of its biases again", () => {
    for (let position = scale.lowestPosition; position <= scale.highestPosition; ++position) {
      // Rounding a bias to float32 moves it by 6e-8 of itself, far less than a position.
      assert.ok(Math.abs(scale.positionOf(scale.biasAt(position)) - position) < 0.01, `position ${position}`);
    }
  });

  it("reaches all biases that matter", () => {
    assert.ok(Math.abs(scale.biasAt(scale.highestPosition) - 0.5) < 1e-6);
    assert.ok(Math.abs(scale.biasAt(scale.lowestPosition) + 0.1) < 1e-6);
  });
});

describe("A float32 as text", () => {
  it("reads back as the same number, and is short", () => {
    assert.equal(page.shortestFloat32(Math.fround(0.1)), "0.1");
    assert.equal(page.shortestFloat32(-Infinity), "\u2212\u221E");
    const random = seededRandom(5);
    for (let i = 0; i < 5000; ++i) {
      const value = Math.fround((random() - 0.5) * 10 ** (60 * random() - 30));
      assert.equal(Math.fround(Number(page.shortestFloat32(value))), value);
    }
  });
});

describe("An amount of pixels", () => {
  it("has the digits that the program gives it", () => {
    const amounts = [0, 0.0004, 0.0012, 0.25, 1 / 3 + 1, 9.996, 12.34, 99.96, 999.6, 367863.6];
    const wanted = ["0", "<0.001", "0.001", "0.250", "1.33", "10.0", "12.3", "100", "1,000", "367,864"];
    assert.deepEqual(amounts.map(page.groupedAmount), wanted);
  });
});

describe("A share in percent", () => {
  it("has the digits that the program gives it", () => {
    const texts = [0, 1, 0.5, 0.082, 0.0086, 0.000197, 1.23e-5, 1e-7, null].map(page.percent);
    const wanted = ["0 %", "100 %", "50.0 %", "8.20 %", "0.860 %", "0.0197 %", "0.0012 %", "<0.0001 %", "\u2013"];
    assert.deepEqual(texts, wanted);
  });
});

describe("Counts of an image of which every second pixel is stored", () => {
  // One lit pixel of four, and one blocked pixel of four.
  const stored = {
    row: 0,
    width: 2,
    height: 1,
    step: 2,
    frustum: {},
    derive: {},
    bias_constant: 0.5,
    detail: { pixels: { lit: 4, blocked: 4 }, false_shadow: 3, false_lit: 1 },
  };
  const layers = {
    class: Uint8Array.of(5, 6),
    critical_bias: Float32Array.of(0.25, 0.75),
    verdict: Float32Array.of(1, 0),
  };
  const image = new page.PixelImage(stored, layers);

  it("are exact at the job's bias, and estimates at others", () => {
    assert.deepEqual(image.countsAt(0.5), { falseShadow: 3, falseLit: 1 });
    assert.ok(image.isCountedAt(0.5));
    assert.deepEqual(image.countsAt(0), { falseShadow: 4, falseLit: 0 });
    assert.deepEqual(image.countsAt(1), { falseShadow: 0, falseLit: 4 });
    assert.ok(!image.isCountedAt(1));
  });

  it("are exact everywhere where all pixels are stored", () => {
    const whole = new page.PixelImage({ ...stored, step: 1 }, layers);
    assert.deepEqual(whole.countsAt(1), { falseShadow: 0, falseLit: 1 });
    assert.ok(whole.isCountedAt(1));
  });
});
