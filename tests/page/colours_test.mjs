// The page, the pictures and the figures share the meanings of colours.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { describe, it } from "node:test";
import { loadScripts } from "./scripts.mjs";

const page = loadScripts(
  ["numbers.js", "charts/scales.js", "charts/colours.js"],
  [
    "okabeIto", "causeColours", "labelColours", "errorColours", "mapColours", "mixStops", "shareOnScale",
    "texelScale"
  ],
);
const source = (path) => readFileSync(new URL(`../../${path}`, import.meta.url), "utf8");

describe("Colours", () => {
  it("of causes are those of the figures", () => {
    const style = source("reports/figures/style.py");
    const named = Object.fromEntries(
      [...style.matchAll(/^([A-Z]+) = "(#[0-9A-F]{6})"/gm)].map(([, name, colour]) => [name, colour]),
    );
    const [, entries] = /^CAUSES = \{(.*)\}$/m.exec(style);
    const causes = Object.fromEntries(
      [...entries.matchAll(/"(\w+)": (\w+)/g)].map(([, cause, name]) => [cause, named[name]]),
    );
    assert.deepEqual(page.causeColours, causes);
  });

  it("of causes and names are those of heat maps, and all different", () => {
    const heatMap = source("reports/pictures/heat_map.cpp");
    const colours = (name) => {
      const [, entries] = new RegExp(`${name}\\{\\{no_error,([^;]*);`).exec(heatMap);
      return [...entries.matchAll(/0x(..), 0x(..), 0x(..)/g)].map(([, ...bytes]) => `#${bytes.join("")}`);
    };
    assert.deepEqual(Object.values(page.causeColours), colours("cause_colours"));
    assert.deepEqual(Object.values(page.labelColours), colours("label_colours"));
    const all = [...Object.values(page.causeColours), ...Object.values(page.labelColours)];
    assert.equal(new Set(all).size, all.length);
  });

  it("of maps are all different, as many as a light has, and mean nothing else", () => {
    const most = 8; // cascades; a cube has 6 faces
    assert.equal(page.mapColours.length, most);
    const others = [page.okabeIto, page.causeColours, page.labelColours, page.errorColours];
    const all = new Set([...page.mapColours, ...others.flatMap(Object.values)]);
    assert.equal(all.size, most + new Set(others.flatMap(Object.values)).size);
  });

  it("of errors are those of the pictures", () => {
    const marks = Object.fromEntries(
      [
        ...source("reports/pictures/panels.cpp").matchAll(/case Mark::(\w+):\s+return \{0x(..), 0x(..), 0x(..)\}/g),
      ].map(([, mark, ...bytes]) => [mark, `#${bytes.join("")}`]),
    );
    assert.deepEqual(
      {
        false_shadow: page.errorColours.falseShadow,
        false_lit: page.errorColours.falseLit,
        unmatched: page.errorColours.unmatched,
        indeterminate: page.errorColours.indeterminate,
      },
      marks,
    );
  });

  it("on a scale do not depend on the image", () => {
    assert.equal(page.shareOnScale(page.texelScale, 0), 0.5);
    assert.equal(page.shareOnScale(page.texelScale, 1e6), 1);
    assert.deepEqual(page.mixStops(["#000000", "#FFFFFF"], 0.5), [128, 128, 128]);
  });
});
