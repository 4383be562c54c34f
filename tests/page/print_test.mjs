// The printed page is complete, light, and no longer than necessary.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { after, before, describe, it } from "node:test";
import { axes, job, makeReport, openPage, stopBrowser, workFolder } from "./browser.mjs";

/** Why PDF files cannot be read; empty if they can. */
function popplerIsMissing() {
  try {
    execFileSync("pdfinfo", ["-v"], { stdio: "ignore" });
    return "";
  } catch {
    return "there is no pdfinfo; apt-get install poppler-utils";
  }
}
const skip = popplerIsMissing();

/** Prints an open page. @return {Promise<{pages: number, texts: string[]}>}  with a text for each page */
async function printed(page) {
  const path = join(workFolder, "printed.pdf");
  await page.pdf({ path });
  const read = (...words) => execFileSync(words[0], words.slice(1), { encoding: "utf8" });
  const pages = Number(/^Pages:\s+(\d+)$/m.exec(read("pdfinfo", path))[1]);
  return { pages, texts: read("pdftotext", "-layout", path, "-").split("\f").slice(0, pages) };
}

describe("A page on paper", { skip: skip || false }, () => {
  let file;
  before(() => {
    const values = axes({
      "shadow_map.resolution": "64,128,256",
      "bias.constant": '{from=1e-6, to=0.1, count=300, scale="log"}',
    });
    const sweep = [...job("wall", 48, 32), ...values, "--quiet", "--no-keep-pixels"];
    file = makeReport("printed sweep", "sweep", ...sweep).page;
  });
  after(stopBrowser);

  it("has the first rows of a large sweep, and no blank pages", async () => {
    const page = await openPage(file);
    const { pages, texts } = await printed(page);
    // There are about nine. Room for all 900 rows would take 27.
    assert.ok(pages <= 12, `${pages} pages`);
    texts.forEach((text, i) => assert.match(text, /\w/, `page ${i + 1} is blank`));
    const all = texts.join("\n").replace(/\s+/g, " ");
    assert.match(all, /The first 40 rows are printed\. All of them are in results\.csv\./);
    assert.match(all, /Settings, and how to repeat the run/);
    assert.doesNotMatch(all, /Click a row/);
    assert.ok((await page.locator(".rows tr[data-place]").count()) < 40, "the screen has its own rows again");
    await page.close();
  });

  it("is no wider than the paper, and takes light colours from a dark screen", async () => {
    const page = await openPage(file, { width: 720, colorScheme: "dark" });
    const ink = () =>
      page.evaluate(() => [
        getComputedStyle(document.body).color,
        Chart.getChart(document.querySelector("#distance canvas")).options.scales.x.title.color,
      ]);
    const dark = await ink();
    await page.emulateMedia({ media: "print", colorScheme: "dark" });
    await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
    const [text, line] = await ink();
    assert.equal(text, "rgb(29, 33, 38)");
    assert.equal(line, "#1d2126");
    const tooWide = await page.evaluate(() =>
      [...document.querySelectorAll("main :is(canvas, table, figure, p, dl, pre)")]
        .filter((part) => part.closest("details:not([open])") === null)
        .filter((part) => part.getBoundingClientRect().right > innerWidth + 1)
        .map((part) => `${part.tagName} ${part.className} ${part.textContent.slice(0, 40)}`),
    );
    assert.deepEqual(tooWide, []);
    await page.evaluate(() => window.dispatchEvent(new Event("afterprint")));
    await page.emulateMedia({ media: "screen", colorScheme: "dark" });
    assert.deepEqual(await ink(), dark);
    await page.close();
  });
});
