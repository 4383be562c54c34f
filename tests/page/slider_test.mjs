// The bias slider counts as the program does at 60 biases.

import assert from "node:assert/strict";
import { join } from "node:path";
import { after, describe, it } from "node:test";
import { readImages, scripts } from "./page_images.mjs";
import {
  gnomon,
  inLane,
  job,
  makeReport,
  numberOf,
  openPage,
  settle,
  stagePixels,
  stopBrowser,
  workFolder,
} from "./browser.mjs";

const jobs = {
  "nearest, a spot": job("sphere-plane", 64, 48, { "shadow_map.resolution": 128 }),
  "pcf5, a spot": job("sphere-plane", 64, 48, { "shadow_map.resolution": 128, "lookup.filter": "pcf5" }),
  "hardware, a spot": job("sphere-plane", 64, 48, { "lookup.filter": "hardware" }),
  "nearest, directional, d16": job("wall", 64, 48, { "shadow_map.depth_format": "d16" }),
  "nearest, reversed float": job("two-distances", 64, 48, {
    "shadow_map.depth_format": "d32f",
    "shadow_map.reversed": true,
  }),
  "linear, shadowed outside": job("wall", 64, 48, { "lookup.filter": "linear", "lookup.outside": "shadowed" }),
};
const positions = [-590, -301, -1, 0, 1, 120, 433, 777, 1001, 1290];

function shownCounts(page) {
  return page.evaluate(() =>
    Object.fromEntries(
      [...document.querySelectorAll("#inspector [data-count]")].map((dd) => [dd.dataset.count, dd.textContent]),
    ),
  );
}

/** Reads the image of a run with other settings. */
async function imageOf(name, words) {
  const [image] = await readImages(makeReport(name, "compare", ...words).page);
  return image;
}

describe("Causes at the slider's bias", () => {
  const settings = { "shadow_map.resolution": 256, "bias.constant": 0.001 };
  const kinds = {
    nearest: settings,
    pcf5: { ...settings, "lookup.filter": "pcf5" },
    slope: { ...settings, "bias.slope": 0.0001 },
  };
  for (const [name, keys] of inLane(kinds, "nearest", "pcf5")) {
    it(`are those of gnomon compare wherever the page knows them: ${name}`, async () => {
      const image = await imageOf(`causes ${name}`, job("columns", 96, 54, keys));
      const causes = new scripts.ErrorCauses(image);
      for (const bias of [0.001, 0, 0.002]) {
        const changed = job("columns", 96, 54, { ...keys, "bias.constant": bias });
        const there = await imageOf(`causes ${name} at ${bias}`, changed);
        let known = 0;
        there.layers.class.forEach((_, i) => {
          const told = [causes.causeAt(i, there.jobBias), causes.labelAt(i, there.jobBias)];
          if (!there.isWrongAt(i, there.jobBias)) {
            const partial = bias === 0.001 ? [there.layers.cause[i], there.layers.label[i]] : [0, 0];
            assert.deepEqual(told, partial, `pixel ${i} at ${bias}`);
            return;
          }
          [there.layers.cause[i], there.layers.label[i]].forEach((code, kind) => {
            const isUnknown = bias !== 0.001 && told[kind] === scripts.unknownCode;
            assert.ok(told[kind] === code || isUnknown, `pixel ${i} at ${bias}`);
            known += told[kind] === code ? 1 : 0;
          });
        });
        assert.ok(known > 0, `nothing is known at ${bias}`);
      }
    });
  }
});

describe("The bias slider", () => {
  after(stopBrowser);
  const usual = ["pcf5, a spot", "nearest, directional, d16", "linear, shadowed outside"];
  for (const [name, words] of inLane(jobs, ...usual)) {
    it(`counts as gnomon compare does, in ${positions.length} places: ${name}`, async () => {
      const { page: file } = makeReport(`slider ${name}`, "compare", ...words);
      const page = await openPage(file);
      const range = page.getByLabel("Constant bias", { exact: true });
      for (const position of positions) {
        await range.fill(String(position));
        const bias = numberOf(await page.getByLabel("Exactly").inputValue());
        const said = JSON.parse(gnomon("compare", ...words, "--set", `bias.constant=${bias}`, "--json"));
        const shown = await shownCounts(page);
        said.wrong = said.false_shadow + said.false_lit;
        for (const count of ["wrong", "false_shadow", "false_lit"]) {
          assert.equal(numberOf(shown[count]), said[count], `${name}: ${count} at ${bias}, position ${position}`);
        }
      }
      assert.deepEqual(page.faults, []);
      await page.close();
    });
  }

  it("recolours the image, and has buttons for the biases of the curve", async () => {
    const words = jobs["nearest, a spot"];
    const { page: file } = makeReport("buttons", "compare", ...words);
    const page = await openPage(file);
    const said = JSON.parse(gnomon("compare", ...words, "--json"));
    const press = async (name) => {
      await page.getByRole("button", { name }).click();
      await settle(page);
      return {
        bias: numberOf(await page.getByLabel("Exactly").inputValue()),
        shown: await shownCounts(page),
        pixels: await stagePixels(page),
      };
    };
    const atJob = await press("Job’s bias");
    const atBest = await press("Best bias");
    assert.equal(numberOf(atJob.shown.false_shadow), said.false_shadow);
    const atBestErrors = numberOf(atBest.shown.false_shadow) + numberOf(atBest.shown.false_lit);
    assert.equal(atBestErrors, said.bias_curve.best_errors);
    assert.notEqual(atJob.pixels, atBest.pixels);
    for (const [name, limit] of [
      ["Acne-free", said.bias_curve.acne_free],
      ["Peter-panning-free", said.bias_curve.peter_panning_free],
    ]) {
      if (limit === null) {
        assert.ok(await page.getByRole("button", { name }).isDisabled(), name);
      } else {
        assert.equal(Math.fround((await press(name)).bias), Math.fround(limit), name);
      }
    }
    await page.close();
  });

  it("takes any float32 and refuses the rest in words", async () => {
    const { page: file } = makeReport("field", "compare", ...jobs["nearest, directional, d16"]);
    const page = await openPage(file);
    const field = page.getByLabel("Exactly");
    for (const bad of ["", "much", "1e99"]) {
      await field.fill(bad);
      await field.press("Enter");
      assert.equal(await field.getAttribute("aria-invalid"), "true", bad);
      assert.ok(await page.getByText("a float32 can hold").isVisible(), bad);
    }
    await field.fill("-3.5e-5");
    await field.press("Enter");
    assert.equal(await field.getAttribute("aria-invalid"), "false");
    assert.equal(await field.inputValue(), "-0.000035");
    await page.close();
  });

  it("is missing if other biases are unknown, and the page says why", async () => {
    const words = job("sphere-plane", 64, 48, { "method.name": "pcss" });
    const page = await openPage(makeReport("soft", "compare", ...words).page);
    assert.equal(await page.getByLabel("Constant bias", { exact: true }).count(), 0);
    const shown = await shownCounts(page);
    const said = JSON.parse(gnomon("compare", ...words, "--json"));
    assert.equal(numberOf(shown.false_shadow), said.false_shadow);
    assert.ok(await page.getByText("The layers show the job’s bias alone").isVisible());
    assert.deepEqual(page.faults, []);
    await page.close();
  });

  it("is there for a case whose map gives other biases, also with the driver's own filter", async () => {
    const folder = join(workFolder, "hardware case");
    gnomon("compare", ...jobs["hardware, a spot"], "--export-case", folder);
    const page = await openPage(makeReport("hardware", "evaluate", folder).page);
    assert.equal(await page.getByLabel("Constant bias", { exact: true }).count(), 1);
    assert.deepEqual(page.faults, []);
    await page.close();
  });
});
