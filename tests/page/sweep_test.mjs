// A sweep's charts, heat map, Pareto front and table of configurations.

import assert from "node:assert/strict";
import { after, before, describe, it } from "node:test";
import { axes, job, makeReport, numberOf, openPage, settle, stopBrowser } from "./browser.mjs";

const kept = [
  ...job("columns", 64, 48),
  ...axes({ "shadow_map.resolution": "128,256,512", "bias.constant": "0,0.001,0.01" }),
];
const isFull = Boolean(process.env.GNOMON_FULL_TESTS);

/** A sweep of the wall with 10 curves and this many biases on each. */
function manyBiases(count) {
  const values = axes({
    "shadow_map.resolution": "64,128,256,512,1024",
    "lookup.filter": "nearest,pcf3",
    "bias.constant": `{from=1e-6, to=0.1, count=${count}, scale="log"}`,
  });
  return [...job("wall", 48, 32), ...values, "--quiet", "--no-keep-pixels"];
}

const cells = (page, column) =>
  page.evaluate((name) => {
    const headings = [...document.querySelectorAll(".rows thead button")].map(
      (button) => button.dataset.column,
    );
    return [...document.querySelectorAll(".rows tr[data-place]")].map(
      (row) => row.children[headings.indexOf(name)].textContent,
    );
  }, column);

describe("A small sweep with its pixels", () => {
  let page;
  before(async () => {
    page = await openPage(makeReport("small sweep", "sweep", ...kept, "--keep-pixels", "--quiet").page);
  });
  after(stopBrowser);

  it("opens without a request, a message or an error", () => assert.deepEqual(page.faults, []));

  it("opens with the least error first, and the columns that people need", async () => {
    const headings = await page.locator(".rows thead button").evaluateAll((all) => all.map(({ textContent }) => textContent));
    assert.deepEqual(headings.slice(0, 4), ["shadow_map.resolution", "bias.constant", "error_rate", "mean_abs_error"]);
    assert.equal(headings.at(-1), "ordinal");
    assert.equal(await page.locator(".rows th[aria-sort=ascending]").textContent(), "mean_abs_error");
    const errors = (await cells(page, "mean_abs_error")).map(parseFloat);
    assert.deepEqual(
      errors,
      [...errors].sort((a, b) => a - b),
    );
  });

  it("has the errors and a setting in sight on a phone", async () => {
    const narrow = await openPage(makeReport("narrow sweep", "sweep", ...kept, "--quiet").page, { width: 390 });
    const sight = await narrow.locator(".rows-scroll").boundingBox();
    const heading = await narrow.locator(".rows thead button[data-column='shadow_map.resolution']").boundingBox();
    assert.ok(heading.x + heading.width <= sight.x + sight.width, `${heading.x} + ${heading.width} of ${sight.width}`);
    await narrow.close();
  });

  it("shows every configuration, sorted as its headings are asked", async () => {
    assert.equal((await cells(page, "error_rate")).length, 9);
    const heading = page.locator(".rows thead button[data-column=false_shadow]");
    for (const [direction, way] of [
      ["ascending", 1],
      ["descending", -1],
    ]) {
      await heading.click();
      assert.equal(await page.locator(".rows th[aria-sort]").getAttribute("aria-sort"), direction);
      const counts = (await cells(page, "false_shadow")).map(numberOf);
      assert.deepEqual(
        counts,
        [...counts].sort((a, b) => way * (a - b)),
      );
    }
  });

  it("filters, and says what it does not understand", async () => {
    const filter = page.getByLabel("Filter", { exact: true });
    await filter.fill("resolution=256 constant > 0");
    await page.waitForFunction(() => document.querySelectorAll(".rows tr[data-place]").length === 2);
    assert.deepEqual(await cells(page, "shadow_map.resolution"), ["256", "256"]);
    await filter.fill("nonsense = 4");
    await page.getByText("no column “nonsense”").waitFor();
    await filter.fill("");
    await page.waitForFunction(() => document.querySelectorAll(".rows tr[data-place]").length === 9);
  });

  it("opens a configuration with Enter, its pixels and its charts", async () => {
    await page.locator(".rows thead button[data-column=ordinal]").click();
    await page.locator("table.rows").focus();
    await page.keyboard.press("Home");
    await page.keyboard.press("ArrowDown");
    await page.keyboard.press("ArrowDown");
    await page.keyboard.press("Enter");
    await page.waitForFunction(() =>
      document.querySelector("#sweep .configuration h3").textContent.startsWith("Configuration 2,"),
    );
    const caption = await page.locator("#inspector .caption").textContent();
    assert.match(caption, /Configuration 2, .*bias\.constant = 0\.01/);
    assert.equal(await page.locator("#distance .caption").textContent(), caption);
    assert.equal(await page.locator("#objects .caption").textContent(), caption);
    assert.equal(Math.fround(numberOf(await page.getByLabel("Exactly").inputValue())), Math.fround(0.01));
    assert.equal(await page.locator(".rows tr[aria-selected=true]").getAttribute("data-place"), "2");
  });

  it("chooses columns", async () => {
    await page.getByText("Columns", { exact: true }).click();
    await page.getByLabel("labels.acne", { exact: true }).check();
    assert.equal(await page.locator(".rows thead button[data-column='labels.acne']").count(), 1);
    await page.getByLabel("labels.acne", { exact: true }).uncheck();
    await settle(page);
    assert.equal(await page.locator(".rows thead button[data-column='labels.acne']").count(), 0);
  });

  it("draws a panel for each value of a second axis, and a heat map of both", async () => {
    await page.getByLabel("against", { exact: true }).selectOption("bias.constant");
    await page.getByLabel("one panel for each").selectOption("shadow_map.resolution");
    await page.locator("#sweep .panels-small .chart-figure").nth(2).waitFor();
    assert.equal(await page.locator("#sweep .panels-small .chart-figure").count(), 3);
    assert.equal(await page.locator("#sweep .heat").count(), 9);
    assert.deepEqual(page.faults, []);
  });
});

describe("A sweep without its pixels", () => {
  after(stopBrowser);
  const titles = (page) => page.locator("#distance figcaption").allTextContents();

  it("shows errors by distance at no other bias than it names", async () => {
    const page = await openPage(makeReport("biases", "sweep", ...manyBiases(3)).page);
    await page.locator(".rows tr[data-place]").nth(1).click();
    const missing = page.getByText("were not stored at this configuration’s own bias");
    await missing.waitFor();
    assert.match((await titles(page))[0], /^Errors by light distance, at the best bias, /);
    assert.deepEqual(await page.getByLabel("Errors at").locator("option").allTextContents(), ["the best bias"]);
    await page.close();
  });

  it("shows them at its own bias where the bias is the job's", async () => {
    const sweep = [...job("wall", 48, 32), ...axes({ "shadow_map.resolution": "64,128" }), "--no-keep-pixels", "--quiet"];
    const { page: file } = makeReport("resolutions", "sweep", ...sweep);
    const page = await openPage(file);
    assert.match((await titles(page))[0], /^Errors by light distance, at its own bias, /);
    assert.equal(await page.getByText("were not stored at this configuration’s own bias").count(), 0);
    assert.deepEqual(page.faults, []);
    await page.close();
  });

  it("has one range on every axis for its own bias and the best one", async () => {
    const sweep = [...job("wall", 48, 32), ...axes({ "shadow_map.resolution": "64,128" }), "--no-keep-pixels", "--quiet"];
    const page = await openPage(makeReport("ranges", "sweep", ...sweep).page);
    const ranges = () =>
      page.locator("#distance canvas").evaluateAll((all) =>
        all.map((canvas) => {
          const { x, y } = Chart.getChart(canvas).scales;
          return [x.min, x.max, y.min, y.max];
        }),
      );
    const own = await ranges();
    await page.getByLabel("Errors at").selectOption("best");
    assert.match((await titles(page))[0], /, at the best bias, /);
    assert.equal(own.length, 3);
    assert.deepEqual(await ranges(), own);
    await page.close();
  });

  it("names in its legends only what has values", async () => {
    // The middle of the sphere's shadow: no pixel is lit.
    const dark = [...job("sphere-plane", 48, 32, { "camera.eye": "[2.5,1,3.5]", "camera.target": "[2.6,0,3.5]" })];
    const page = await openPage(makeReport("dark", "compare", ...dark).page);
    const legend = await page.locator("#distance canvas").first().evaluate((canvas) => {
      const { options, data, legend: { legendItems } } = Chart.getChart(canvas);
      return { filtered: legendItems.map(({ text }) => text), all: data.datasets.map(({ label }) => label), shown: options.plugins.legend.display };
    });
    assert.deepEqual(legend, {
      filtered: ["false lit, of the blocked"],
      all: ["false shadow, of the lit", "false lit, of the blocked"],
      shown: true,
    });
    await page.close();
  });
});

describe("A heat map of many values", () => {
  after(stopBrowser);
  it("has values along both sides, downwards as its choice says", async () => {
    const page = await openPage(makeReport("many biases", "sweep", ...manyBiases(40)).page);
    await page.getByLabel("across", { exact: true }).selectOption("bias.constant");
    await page.getByLabel("down", { exact: true }).selectOption("shadow_map.resolution");
    const canvas = page.locator(".heat-canvas");
    await canvas.waitFor();
    assert.deepEqual(await page.locator(".heat-down span").allTextContents(), ["64", "128", "256", "512", "1,024"]);
    assert.equal(await page.locator(".heat-across span").count(), 6);
    await canvas.hover({ position: { x: 2, y: 2 } });
    await page.getByText("bias.constant = 0.000001, shadow_map.resolution = 64: ").waitFor();
    assert.deepEqual(page.faults, []);
    await page.close();
  });
});

describe("A large sweep", () => {
  after(stopBrowser);
  const sizes = isFull ? [10_000, 200_000] : [10_000];
  for (const rows of sizes) {
    it(`of ${rows} rows opens, with few of them on the page`, { timeout: 1_200_000 }, async (test) => {
      const { page: file } = makeReport(`sweep of ${rows}`, "sweep", ...manyBiases(rows / 10));
      const start = performance.now();
      const page = await openPage(file);
      test.diagnostic(`${rows} rows: usable after ${Math.round(performance.now() - start)} ms`);
      assert.equal(await page.locator("table.rows").getAttribute("aria-rowcount"), String(rows + 1));
      assert.ok((await page.locator(".rows tr[data-place]").count()) < 60);
      const filtered = await page.evaluate(async () => {
        const field = document.querySelector("input.filter");
        field.value = "false_lit < 2 resolution=512";
        const before = performance.now();
        field.dispatchEvent(new Event("input"));
        while (!/ of /.test(document.querySelector("#sweep [role=status]").textContent)) {
          await new Promise(requestAnimationFrame);
        }
        return performance.now() - before;
      });
      test.diagnostic(`${rows} rows: filtered after ${Math.round(filtered)} ms`);
      await page.locator("table.rows").focus();
      await page.keyboard.press("End");
      await settle(page);
      assert.ok((await page.locator(".rows tr[data-place]").count()) < 60);
      await page.keyboard.press("Enter");
      await page.locator("#sweep .configuration dd[data-column='shadow_map.resolution']").waitFor();
      assert.equal(
        await page.locator("#sweep .configuration dd[data-column='shadow_map.resolution']").textContent(),
        "512",
      );
      assert.deepEqual(page.faults, []);
      await page.close();
    });
  }
});
