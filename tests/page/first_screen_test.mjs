// The first screen answers: what is wrong, by how much, and what to type, with and without scripts.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, describe, it } from "node:test";
import { pathToFileURL } from "node:url";
import {
  axes,
  gnomon,
  job,
  makeReport,
  openPage,
  settle,
  stagePixels,
  startBrowser,
  stopBrowser,
} from "./browser.mjs";

const spot = job("sphere-plane", 240, 135, { "bias.constant": 0.001 });
const bottomOf = (page, selector) =>
  page.locator(selector).evaluate((node) => node.getBoundingClientRect().bottom);

describe("The first screen of a comparison", () => {
  let report;
  let detail;
  let page;
  before(async () => {
    report = makeReport("first", "compare", ...spot);
    detail = JSON.parse(gnomon("compare", ...spot, "--json"));
    page = await openPage(report.page);
  });
  after(stopBrowser);

  it("begins with the most frequent error", async () => {
    const heading = await page.locator("h1").textContent();
    assert.ok(detail.findings[0].startsWith(heading), `${heading} / ${detail.findings[0]}`);
    assert.match(heading, /^\d[\d.]* % of the lit surface shadows itself \(acne\)$/);
  });

  it("fits in a window of 1280 x 900", async () => {
    for (const part of [".strip", "#fix", "#ways"]) {
      const bottom = await bottomOf(page, part);
      assert.ok(bottom <= 900, `${part} ends at ${bottom}`);
    }
  });

  it("ranks the fixes as the JSON has them", async () => {
    const rows = await page
      .locator("#ways tbody tr")
      .evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
    const scored = detail.pixels.lit + detail.pixels.blocked;
    const left = [detail, ...detail.remedies].map(({ error_amount: amount }) => (100 * amount) / scored);
    assert.equal(rows.length, Math.min(left.length, 7));
    rows.forEach(([, wrong], i) => {
      // Three digits are shown.
      assert.ok(Math.abs(parseFloat(wrong) - left[i]) <= 0.005 * left[i], `${wrong} for ${left[i]}`);
    });
    assert.equal(await page.locator("#fix pre code").first().textContent(), detail.remedies[0].toml);
  });

  it("translates the fix for an engine, by mouse and keyboard", async () => {
    const tabs = page.getByRole("tab");
    assert.ok((await tabs.count()) > 2);
    await page.getByRole("tab", { name: "three.js" }).click();
    const shown = page.locator(".panel:not([hidden])");
    assert.equal(await shown.count(), 1);
    const { settings } = JSON.parse(gnomon("settings", ...spot, "--engine", "three", "--json"))[0];
    const code = await shown.locator("code").textContent();
    settings.forEach(({ line }) => assert.ok(code.includes(line), line));
    await page.keyboard.press("Home");
    assert.equal(await page.locator(":focus").textContent(), "Gnomon");
    assert.equal(await shown.getAttribute("data-name"), "gnomon");
    await page.keyboard.press("ArrowLeft");
    assert.equal(await tabs.last().getAttribute("aria-selected"), "true");
    await page.keyboard.press("ArrowRight");
  });

  it("copies what it shows", async () => {
    await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
    const shown = page.locator(".panel:not([hidden])");
    await shown.getByRole("button", { name: "Copy" }).click();
    await shown.getByRole("button", { name: "Copied" }).waitFor();
    const copied = await page.evaluate(() => navigator.clipboard.readText());
    assert.equal(copied, await shown.locator("code").textContent());
  });

  it("lists every section that it shows in the bar", async () => {
    const links = await page
      .locator("nav.sections .links a")
      .evaluateAll((all) => all.map((link) => link.getAttribute("href")));
    assert.ok(links.includes("#inspector") && links.includes("#environment"), links.join());
    for (const link of links) {
      assert.ok(await page.locator(link).isVisible(), link);
    }
    await page.locator("nav.sections .links a").last().click();
    assert.ok((await bottomOf(page, "nav.sections")) < 100, "the bar stays at the top");
  });

  it("has the same pictures in the page and in files", async () => {
    for (const [i, name] of ["drawn", "true", "wrong"].entries()) {
      const source = await page.locator(".strip img").nth(i).getAttribute("src");
      const file = readFileSync(`${report.run} report/pictures/${name}.png`).toString("base64");
      assert.equal(source, `data:image/png;base64,${file}`);
    }
    const summary = readFileSync(`${report.run} report/summary.md`, "utf8");
    assert.match(summary, /\(pictures\/wrong\.png\)/);
  });

  it("answers without JavaScript", async () => {
    const browser = await startBrowser();
    const context = await browser.newContext({ javaScriptEnabled: false });
    const plain = await context.newPage();
    await plain.goto(pathToFileURL(report.page).href);
    assert.ok(await plain.locator("h1").isVisible());
    assert.equal(await plain.locator(".strip img:visible").count(), 3);
    assert.ok((await plain.locator(".panel:visible").count()) > 2);
    assert.ok(await plain.locator("#ways table").isVisible());
    await context.close();
  });
});

describe("The first screen", () => {
  after(stopBrowser);

  it("says so where nothing is wrong", async () => {
    // A bias of 1 m frees a plane of acne, and nothing blocks its light.
    const words = job("tilted-plane", 64, 48, { "bias.constant_m": 1 });
    const page = await openPage(makeReport("right", "compare", ...words).page);
    assert.match(await page.locator("h1").textContent(), /^All [\d,]+ scored pixels are right$/);
    assert.equal(await page.locator("#fix h2").textContent(), "Nothing to fix");
    assert.equal(await page.locator("#ways").count(), 0);
    await page.close();
  });

  it("of a sweep names the best and the worst", async () => {
    const values = axes({ "bias.constant": "0,0.01" });
    const report = makeReport("two", "sweep", ...job("wall", 64, 48), ...values, "--quiet");
    const page = await openPage(report.page);
    assert.match(
      await page.locator("h1").textContent(),
      /^[\d.]+ % wrong with the best of 2 configurations, [\d.]+ % with the worst$/,
    );
    assert.ok(await page.getByText("Lowest error rates, and the highest").isVisible());
    await page.close();
  });
});

describe("A report against an earlier run", () => {
  after(stopBrowser);

  it("wipes between both runs, and counts what changed", async () => {
    const before = makeReport("earlier", "compare", ...job("sphere-plane", 96, 54, { "bias.constant": 0 }));
    const now = makeReport("later", "compare", ...job("sphere-plane", 96, 54, { "bias.constant": 0.02 }));
    gnomon("report", now.run, "--against", before.run, "--out", `${now.run} report`);
    const page = await openPage(now.page);
    assert.ok(await page.locator("#against img").isVisible());
    assert.match(await page.locator("#against").textContent(), /[\d,]+ pixels? became wrong, and [\d,]+ right\./);
    const keys = await page.locator("#against table").nth(1).locator("tbody tr").allTextContents();
    assert.deepEqual(keys, ["bias.constant00.02"]);
    const wipe = page.getByLabel("Wipe", { exact: true });
    const shown = async (share) => {
      await wipe.fill(share);
      await settle(page);
      return stagePixels(page);
    };
    // All of A is the earlier run's errors as its own page draws them.
    const earlier = await shown("100");
    assert.notEqual(earlier, await shown("0"));
    const own = await openPage(before.page);
    await own.getByLabel("Wipe", { exact: true }).fill("0");
    await settle(own);
    assert.equal(earlier, await stagePixels(own));
    assert.deepEqual(page.faults, []);
  });
});
