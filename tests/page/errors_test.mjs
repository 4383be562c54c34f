// Clusters, marks, causes, sentences and texels of wrong pixels, on images made by hand.

import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { scripts as page } from "./page_images.mjs";
import { seededRandom } from "./scripts.mjs";

const [unmatched, attached, outOfLight, indeterminate, lit, blocked] = [1, 2, 3, 4, 5, 6];
const code = (names, name) => names.indexOf(name);
const label = (name) => code(page.labelNames, name);
const cause = (name) => code(page.causeNames, name);
const directional = {
  projection: "orthographic", is_linear: true, range_m: 10, inverse_range_per_m: 0, near_m: 0, far_m: 10, texel_m: 0.5,
  reversed: false,
};

/** An image of one row with nearest lookups of a directional light, whose job has the bias 0.25. */
function imageOf(layers, { width = layers.class.length, frustum = directional, ...rest } = {}) {
  const count = layers.class.length;
  const filled = (value) => new Float32Array(count).fill(value);
  const { detail, ...stored } = rest;
  return new page.PixelImage(
    {
      row: 0, width, height: count / width, step: 1, frustum, filter: "nearest", bias_constant: 0.25,
      derive: { needed_bias_m: true, needed_bias_texels: true }, objects: ["floor", "wall"],
      detail: { cause_arithmetic: "exact", job: { "method.name": "depth" }, ...detail },
      ...stored,
    },
    { verdict: filled(1), receiver_depth: filled(0.5), map_depth: filled(0.5), light_distance_m: filled(5), ...layers },
  );
}

/** The marks of a drawing: # is 1. */
function marksOf(...rows) {
  return { marks: Uint8Array.from(rows.join(""), (mark) => (mark === "#" ? 1 : 0)), width: rows[0].length };
}

describe("Clusters of wrong pixels", () => {
  const found = (...rows) => {
    const { marks, width } = marksOf(...rows);
    return page.findClusters(marks, width).map((pixels) => [...pixels].sort((a, b) => a - b));
  };

  it("join pixels that touch at a side or a corner, the largest first", () => {
    assert.deepEqual(found("#....", "..##.", ".#...", "....."), [[7, 8, 11], [0]]);
  });

  it("of a size are in reading order", () => {
    assert.deepEqual(found("#..#.", ".....", ".#..."), [[0], [3], [11]]);
  });

  it("do not go on at the other side of the image", () => {
    assert.deepEqual(found("....#", "#....", "....#"), [[4], [5], [14]]);
  });

  it("are none where nothing is wrong", () => assert.deepEqual(found("...", "..."), []));

  it("are those of spreading names until nothing changes, for random images", () => {
    const random = seededRandom(31);
    for (let round = 0; round < 30; ++round) {
      const [width, height] = [1 + Math.floor(9 * random()), 1 + Math.floor(9 * random())];
      const marks = Uint8Array.from({ length: width * height }, () => (random() < 0.4 ? 1 : 0));
      const names = Int32Array.from(marks, (mark, i) => (mark ? i : -1));
      const touch = (a, b) =>
        Math.abs((a % width) - (b % width)) <= 1 && Math.abs(Math.floor(a / width) - Math.floor(b / width)) <= 1;
      for (let pass = 0; pass < names.length; ++pass) {
        names.forEach((name, a) =>
          names.forEach((other, b) => {
            if (name >= 0 && other >= 0 && touch(a, b)) {
              names[a] = Math.min(names[a], other);
            }
          }),
        );
      }
      const wanted = [...new Set(names)].filter((name) => name >= 0).sort((a, b) => a - b);
      const size = (name) => names.filter((of) => of === name).length;
      wanted.sort((a, b) => size(b) - size(a) || a - b);
      const clusters = page.findClusters(marks.slice(), width);
      assert.deepEqual(
        clusters.map((pixels) => [Math.min(...pixels), pixels.length]),
        wanted.map((name) => [name, size(name)]),
        `round ${round}`,
      );
    }
  });

  it("change with the bias, as the counts do", () => {
    const image = imageOf({
      class: Uint8Array.of(lit, lit, attached, blocked, lit),
      critical_bias: Float32Array.of(0.5, 0.375, NaN, 0.125, -Infinity),
    });
    const at = (bias) => page.errorClusters(image, bias).map((pixels) => [...pixels]);
    assert.deepEqual(at(0.25), [[0, 1], [3]]);
    assert.deepEqual(at(0.375), [[0], [3]]);
    assert.deepEqual(at(0), [[0, 1]]);
  });

  it("have a box, and the pixel nearest to their centre", () => {
    const pixels = Int32Array.of(1, 2, 3, 7);
    assert.deepEqual(page.boxOf(pixels, 5), { left: 1, top: 0, right: 4, bottom: 2 });
    assert.deepEqual(page.middlePixel(pixels, 5), { x: 2, y: 0 });
  });
});

describe("What a cluster is called", () => {
  const layers = {
    class: Uint8Array.of(lit, lit, lit, blocked),
    critical_bias: Float32Array.of(0.5, 0.5, 0.5, 0.125),
    cause: Uint8Array.of(cause("resolution"), cause("resolution"), cause("resolution"), cause("bias")),
    label: Uint8Array.of(label("acne"), label("acne"), label("edge"), label("peter_panning")),
    object: Uint16Array.of(1, 1, 0, 0),
  };
  const described = (pixels, bias = 0.25, rest = {}) => {
    const causes = new page.ErrorCauses(imageOf(layers, rest));
    const { text, object } = page.describeCluster(causes, Int32Array.from(pixels), bias);
    return [text, object];
  };

  it("is its most frequent name and object", () => {
    assert.deepEqual(described([0, 1]), ["2 pixels of acne", "wall"]);
    assert.deepEqual(described([0, 1, 2]), ["3 pixels, mostly acne,", "wall"]);
    assert.deepEqual(described([3]), ["1 pixel of peter panning", "floor"]);
  });

  it("is the kind of error where the page knows no name at that bias", () => {
    const filtered = { filter: "pcf3" };
    assert.deepEqual(described([0, 1, 2], Math.fround(0.3), filtered), ["3 pixels of false shadow", "wall"]);
    assert.deepEqual(described([0, 1], 0.25, filtered), ["2 pixels of acne", "wall"]);
  });

  it("says of a thinned image that its pixels are those shown", () => {
    const thinned = { step: 2, detail: { pixels: { lit: 12, blocked: 4 }, false_shadow: 12, false_lit: 4 } };
    assert.deepEqual(described([0, 1], 0.25, thinned), ["2 shown pixels of acne", "wall"]);
  });
});

describe("Marks of wrong pixels", () => {
  it("are a pixel each from 100 % on", () => {
    for (const zoom of [1, 1.5, 64]) {
      assert.equal(page.markGrowth(zoom), 0, `${zoom}`);
    }
  });

  it("are two to four pixels of the screen wide below", () => {
    for (let zoom = 0.02; zoom < 1; zoom += 0.01) {
      const width = (2 * page.markGrowth(zoom) + 1) * zoom;
      assert.ok(width >= 1.8 && width < 4, `${width} at ${zoom}`);
    }
  });

  const painted = (width, marks, growth) => {
    const packed = new Uint32Array(marks.length);
    page.paintMarks(packed, width, new Uint32Array(marks.length).fill(9), Uint32Array.from(marks), growth);
    return [...packed];
  };

  it("cover their own pixels alone without growth", () => {
    assert.deepEqual(painted(3, [0, 1, 0, 2, 0, 0], 0), [9, 1, 9, 2, 9, 9]);
  });

  it("grow to squares that end at the image's border", () => {
    assert.deepEqual(painted(4, [1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0], 1), [1, 1, 9, 9, 1, 1, 9, 9, 9, 9, 9, 9]);
  });

  it("hide no other mark, and the rarer kind is above", () => {
    assert.deepEqual(painted(6, [1, 1, 0, 0, 2, 0], 2), [1, 1, 2, 2, 2, 2]);
    assert.deepEqual(painted(3, [1, 2, 1], 2), [1, 2, 1]);
  });
});

describe("Causes at another bias", () => {
  const [low, high] = [0.125, 0.375];
  /** The codes of a pixel that is wrong at the biases asked for. */
  const codes = (pixelClass, critical, causeName, labelName, bias, rest = {}) => {
    const image = imageOf(
      {
        class: Uint8Array.of(pixelClass),
        critical_bias: Float32Array.of(critical),
        cause: Uint8Array.of(cause(causeName)),
        label: Uint8Array.of(label(labelName)),
      },
      rest,
    );
    const causes = new page.ErrorCauses(image);
    const name = (names, at) => (at === page.unknownCode ? "?" : names[at]);
    return [name(page.causeNames, causes.causeAt(0, bias)), name(page.labelNames, causes.labelAt(0, bias))];
  };

  it("are the stored ones at the job's, also of a pixel that is only partly wrong", () => {
    assert.deepEqual(codes(lit, 0.5, "filter", "edge", 0.25), ["filter", "edge"]);
    assert.deepEqual(codes(lit, 0, "filter", "edge", 0.25), ["filter", "edge"]);
  });

  it("are none where the pixel is right", () => {
    assert.deepEqual(codes(lit, 0.5, "resolution", "acne", 0.5), ["none", "right"]);
    assert.deepEqual(codes(attached, NaN, "none", "right", low), ["none", "right"]);
  });

  it("stay those of a pixel in shadow", () => {
    assert.deepEqual(codes(blocked, 0.0625, "bias", "peter_panning", low), ["bias", "peter_panning"]);
    assert.deepEqual(codes(blocked, 0.0625, "resolution", "leak", high), ["resolution", "leak"]);
  });

  it("stay those of a lit pixel where exact depths keep their side", () => {
    assert.deepEqual(codes(lit, 0.5, "bias", "overshadow", high), ["bias", "overshadow"]);
    assert.deepEqual(codes(lit, 0.5, "resolution", "acne", low), ["resolution", "acne"]);
    assert.deepEqual(codes(lit, 0.5, "coverage", "overshadow", low), ["coverage", "overshadow"]);
    assert.deepEqual(codes(lit, 0.5, "precision", "edge", high), ["precision", "edge"]);
  });

  it("are not known where exact depths may be right there and wrong here", () => {
    assert.deepEqual(codes(lit, 0.5, "resolution", "acne", high), ["?", "acne"]);
    assert.deepEqual(codes(lit, 0.5, "coverage", "overshadow", high), ["?", "?"]);
    assert.deepEqual(codes(lit, 0.5, "precision", "acne", low), ["?", "?"]);
    assert.deepEqual(codes(lit, 0.5, "filter", "acne", low), ["?", "?"]);
    assert.deepEqual(codes(lit, 0.5, "filter", "acne", high), ["?", "?"]);
  });

  it("are not known of a pixel that is right at the job's", () => {
    assert.deepEqual(codes(lit, 0.1875, "none", "right", low), ["?", "?"]);
    assert.deepEqual(codes(blocked, 0.3125, "none", "right", high), ["?", "?"]);
  });

  it("have no name where other taps may count", () => {
    assert.deepEqual(codes(lit, 0.5, "resolution", "acne", low, { filter: "pcf3" }), ["resolution", "?"]);
  });
});

describe("Numbers in sentences", () => {
  it("have two or three digits", () => {
    const values = [0, 0.0004, -0.0004, 0.0712, 1.07, 5, 9.96, 12.3, 99.6, 1234, Infinity];
    const wanted = ["0", "<0.001", ">\u22120.001", "0.071", "1.1", "5.0", "10", "12", "100", "1,230", "+\u221E"];
    assert.deepEqual(values.map(page.fewDigits), wanted);
  });

  it("are lengths with a prefix that suits them", () => {
    const lengths = [0, 3e-6, 0.0008, -0.0011, 0.034, 2.4, 1500];
    const wanted = ["0 m", "3.0 µm", "0.8 mm", "\u22121.1 mm", "3.4 cm", "2.4 m", "1.5 km"];
    assert.deepEqual(lengths.map(page.lengthWords), wanted);
  });

  it("are in units where nobody says the scene's unit", () => {
    globalThis.document = { body: { dataset: { lengthUnit: "units" } } };
    assert.equal(page.lengthWords(0.034), "0.034 units");
    delete globalThis.document;
  });
});

describe("The sentence of a pixel", () => {
  const sentence = (layers, { bias = 0.25, ...rest } = {}) => {
    const arrays = Object.entries({ texel_x: 311, texel_y: 87, ...layers }).map(([name, value]) => {
      const isCode = ["class", "cause", "label"].includes(name);
      return [name, (isCode ? Uint8Array : name.startsWith("texel") ? Uint16Array : Float32Array).of(value)];
    });
    return page.pixelSentence(new page.ErrorCauses(imageOf(Object.fromEntries(arrays), rest)), 0, bias);
  };
  const acne = {
    class: lit, critical_bias: 0.375, map_depth: 0.125, cause: cause("resolution"), label: label("acne"),
  };

  it("says what shadows a lit pixel, and which bias frees it", () => {
    const wanted = "Lit, but shadowed: its own surface, at texel 311, 87, is 3.8 m nearer";
    assert.equal(sentence(acne), `${wanted}; a bias of 3.8 m (7.5 texels) frees it.`);
    assert.match(sentence({ ...acne, label: label("edge") }), /^Lit, but shadowed: another surface, at texel/);
    assert.match(sentence(acne, { filter: "pcf3" }), /^Lit, but shadowed: a surface, at texel/);
    assert.match(sentence({ ...acne, critical_bias: Infinity }), /; no bias frees it\.$/);
  });

  it("measures depths of a perspective map along the light", () => {
    const spot = { ...directional, projection: "perspective", is_linear: false, inverse_range_per_m: 1 };
    // 5 m away, 1/d rises by 0.05: the surface is at 1/(1/5 + 0.05) = 4 m.
    const text = sentence({ ...acne, map_depth: 0.45, critical_bias: Infinity }, { frustum: spot });
    assert.match(text, /is 1\.0 m nearer/);
    const reversed = { frustum: { ...spot, reversed: true } };
    assert.match(sentence({ ...acne, map_depth: 0.55, critical_bias: Infinity }, reversed), /is 1\.0 m nearer/);
  });

  it("says what the map has of the blocker, and which bias keeps the shadow", () => {
    const panning = { class: blocked, critical_bias: 0.1, map_depth: 0.375 };
    const start = "In shadow, but lit: a surface, at texel 311, 87, is only 1.3 m nearer";
    assert.equal(sentence(panning), `${start}; a bias of at most 1.0 m (2.0 texels) keeps the shadow.`);
    const leak = "In shadow, but lit: texel 311, 87 holds nothing nearer";
    const behind = { class: blocked, map_depth: 0.75 };
    assert.equal(sentence({ ...behind, critical_bias: -0.25 }), `${leak}; even a bias of 0 leaves it lit.`);
    assert.equal(sentence({ ...behind, critical_bias: -Infinity }), `${leak}; no bias shadows it.`);
  });

  it("says that a pixel is right, and what bias it needs or allows", () => {
    assert.equal(sentence({ class: lit, critical_bias: -0.5 }), "Lit, and drawn lit.");
    const needs = "It needs a bias of 1.3 m (2.5 texels).";
    assert.equal(sentence({ class: lit, critical_bias: 0.125 }), `Lit, and drawn lit. ${needs}`);
    const dark = "In shadow, and drawn in shadow.";
    assert.ok(sentence({ class: blocked, critical_bias: 0.5 }).startsWith(`${dark} A bias of more than 5.0 m`));
    assert.equal(sentence({ class: blocked, critical_bias: Infinity }), dark);
  });

  it("follows the slider", () => {
    assert.match(sentence(acne, { bias: 0.375 }), /^Lit, and drawn lit\. It needs/);
    assert.match(sentence({ class: lit, critical_bias: 0.125 }, { bias: 0 }), /^Lit, but shadowed; a bias of 1\.3 m/);
  });

  it("says why a pixel is not scored", () => {
    assert.equal(sentence({ class: 0 }), "Background: the camera sees no surface here.");
    assert.equal(sentence({ class: unmatched }), "Not scored: GL and the exact ray hit different triangles.");
    assert.match(sentence({ class: attached }), /^Not scored: .* faces away from the light/);
    assert.match(sentence({ class: outOfLight }), /^Not scored: the spot’s cone/);
    assert.match(sentence({ class: indeterminate }), /^Not scored: .* leave open/);
  });

  it("leaves out what is not stored", () => {
    const none = { texel_x: 65535, texel_y: 65535 };
    assert.match(sentence({ ...acne, ...none }), /^Lit, but shadowed: its own surface is 3\.8 m nearer;/);
    assert.match(sentence({ ...acne, map_depth: NaN }), /^Lit, but shadowed; a bias/);
    assert.match(sentence(acne, { filter: "linear" }), /^Lit, but shadowed; a bias/);
    assert.match(sentence(acne, { detail: { job: { "method.name": "vsm" } } }), /^Lit, but shadowed; a bias/);
  });
});

describe("The texels around a pixel", () => {
  const layers = {
    class: Uint8Array.of(lit, lit, lit, blocked, 0, lit),
    critical_bias: Float32Array.of(0.25, 0.375, 0, 0, NaN, 0),
    receiver_depth: new Float32Array(6).fill(0.5),
    map_depth: Float32Array.of(0.25, 0.125, 0.5, 0.875, 0, 0.5),
    texel_x: Uint16Array.of(10, 11, 10, 9, 10, 40),
    texel_y: Uint16Array.of(20, 20, 21, 19, 22, 20),
  };
  const at = (dx, dy) => (4 - dy) * 9 + 4 + dx;
  const states = (index, bias, rest = {}, changed = {}) =>
    page.texelStatesAround(new page.ErrorCauses(imageOf({ ...layers, ...changed }, rest)), index, bias);
  const [unread, nearer, equal, farther] = [0, 1, 2, 3];

  it("are those that pixels read, the map's upper rows first", () => {
    const around = states(0, 0.25);
    assert.deepEqual([...around].filter((state) => state !== unread).length, 4);
    assert.equal(around[at(0, 0)], equal);
    assert.equal(around[at(1, 0)], nearer);
    assert.equal(around[at(0, 1)], equal);
    assert.equal(around[at(-1, -1)], farther);
  });

  it("follow the slider", () => {
    assert.equal(states(0, 0.125)[at(0, 0)], nearer);
    assert.equal(states(0, 0.5)[at(1, 0)], equal);
  });

  it("shadow a pixel's own texel exactly where its verdict does", () => {
    const added = { critical_bias: Float32Array.of(0.125, 0.375, 0, 0, NaN, 0) }; // a slope adds 0.125
    assert.equal(states(0, 0.125, {}, added)[at(0, 0)], equal);
    assert.equal(states(0, Math.fround(0.124), {}, added)[at(0, 0)], nearer);
  });

  it("are not known without texels, of interpolated depths, or where pixels contradict each other", () => {
    assert.equal(states(4, 0.25), null); // background
    assert.equal(states(0, 0.25, { filter: "linear" }), null);
    assert.equal(states(0, 0.25, {}, { texel_x: undefined }), null);
    const same = { texel_x: Uint16Array.of(10, 11, 10, 11, 10, 40), texel_y: Uint16Array.of(20, 20, 21, 20, 22, 20) };
    assert.equal(states(0, 0.25, {}, same), null);
  });
});
