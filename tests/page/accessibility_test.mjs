// axe-core finds nothing serious in light and dark, on a screen and on a phone, and nothing is too wide.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, describe, it } from "node:test";
import { axes, axeSource, job, makeReport, openPage, stopBrowser } from "./browser.mjs";

const reports = {};

/** The page's violations that axe calls serious or critical, in a line each. */
async function violations(page) {
  // The page's Content-Security-Policy blocks scripts, except those of the debugger.
  await page.evaluate(readFileSync(axeSource, "utf8"));
  const result = await page.evaluate(() =>
    // WCAG 2.2 AA requires it, but axe leaves it out by default.
    axe.run(document, { resultTypes: ["violations"], rules: { "target-size": { enabled: true } } }),
  );
  return result.violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .map(({ id, nodes }) => {
      const first = nodes.slice(0, 3).map((node) => `${node.target} ${node.failureSummary}`);
      return `${id}: ${first.join(" | ")}`;
    });
}

describe("The page", () => {
  before(() => {
    const values = axes({ "lookup.filter": "nearest,pcf3", "bias.constant": "0,0.001,0.01" });
    const sweep = [...job("wall", 64, 48), ...values, "--keep-pixels", "--quiet"];
    reports.compare = makeReport("axe compare", "compare", ...job("sphere-plane", 96, 64)).page;
    reports.sweep = makeReport("axe sweep", "sweep", ...sweep).page;
  });
  after(stopBrowser);

  for (const kind of ["compare", "sweep"]) {
    for (const colorScheme of ["light", "dark"]) {
      for (const width of [1280, 390]) {
        it(`of a ${kind} has no serious violation, ${colorScheme}, ${width} px wide`, async () => {
          const page = await openPage(reports[kind], { width, colorScheme });
          assert.deepEqual(await violations(page), []);
          const [page_px, window_px] = await page.evaluate(() => [
            document.documentElement.scrollWidth,
            innerWidth,
          ]);
          assert.ok(page_px <= window_px, `the page is ${page_px} px wide in a window of ${window_px}`);
          await page.close();
        });
      }
    }
  }

  it("opens with its parts closed and open without a violation", async () => {
    const page = await openPage(reports.sweep);
    await page.locator(".rows tr[data-place]").nth(1).click();
    await page.locator("#sweep .configuration dl").first().waitFor();
    await page.evaluate(() =>
      document.querySelectorAll("details").forEach((details) => {
        details.open = true;
      }),
    );
    await page.getByLabel("Go to pixel").fill("10,10");
    await page.getByLabel("Go to pixel").press("Enter");
    assert.deepEqual(await violations(page), []);
    assert.deepEqual(page.faults, []);
    await page.close();
  });

  it("says in words that a browser is too old", async () => {
    const page = await openPage(reports.compare);
    await page.addInitScript(() => {
      delete window.DecompressionStream;
    });
    await page.reload({ waitUntil: "load" });
    assert.match(await page.getByRole("alert").first().textContent(), /DecompressionStream/);
    assert.ok(await page.locator("#answer").isVisible());
    await page.close();
  });
});
