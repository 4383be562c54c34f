// Hostile names appear as text and run nothing.

import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { after, before, describe, it } from "node:test";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { job, makeReport, openPage, readFacts, stopBrowser } from "./browser.mjs";

const names = [
  "</script><img src=x onerror=window.hostile=1>",
  "<!--<script>window.hostile=1</script>",
  "\u{1F525}\u{1F469}\u{200D}\u{1F680}",
  "\u202Eright to left \u05E9\u05DC\u05D5\u05DD",
  `long ${"name ".repeat(2000)}`,
  "'\"&amp;{{constructor}}`${alert(1)}`",
];

/** A glTF of squares above each other, with a node for each name. */
function squares() {
  const corners = Float32Array.of(-1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1);
  const triangles = Uint16Array.of(0, 1, 2, 0, 2, 3);
  const bytes = Buffer.concat([Buffer.from(corners.buffer), Buffer.from(triangles.buffer)]);
  const nodes = names.map((name, i) => ({
    name,
    mesh: 0,
    translation: [0.2 * i, 0.4 * i, 0],
    scale: i === 0 ? [4, 1, 4] : [1 - 0.1 * i, 1, 1 - 0.1 * i],
  }));
  return JSON.stringify({
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: [...nodes.keys()] }],
    nodes,
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 4, type: "VEC3", min: [-1, 0, -1], max: [1, 0, 1] },
      { bufferView: 1, componentType: 5123, count: 6, type: "SCALAR" },
    ],
    bufferViews: [
      { buffer: 0, byteLength: corners.byteLength },
      { buffer: 0, byteOffset: corners.byteLength, byteLength: triangles.byteLength },
    ],
    buffers: [
      { byteLength: bytes.length, uri: `data:application/octet-stream;base64,${bytes.toString("base64")}` },
    ],
  });
}

describe("A hostile scene", () => {
  let page;
  let folder;
  before(async () => {
    folder = mkdtempSync(join(tmpdir(), "gnomon-hostile-"));
    const inside = join(folder, "<img src=x onerror=hostile()> & 'quotes' \u202E\u{1F525}");
    mkdirSync(inside);
    writeFileSync(join(inside, "<i>scene<i>.gltf"), squares());
    const name = "<img src=x onerror=window.hostile=1>'\" \u202E run";
    const { page: file } = makeReport(name, "compare", ...job(join(inside, "<i>scene<i>.gltf"), 64, 48));
    page = await openPage(file);
  });
  after(async () => {
    rmSync(folder, { recursive: true });
    await stopBrowser();
  });

  it("runs nothing", async () => {
    assert.equal(await page.evaluate(() => window.hostile), undefined);
    assert.deepEqual(page.faults, []);
  });

  it("makes no elements", async () => {
    const foreign = await page.evaluate(() =>
      [
        ...document.querySelectorAll(
          "img:not([src^='data:']), body script:not([type]):not(:nth-last-of-type(-n+2)), i",
        ),
      ].map((made) => made.outerHTML.slice(0, 80)),
    );
    assert.deepEqual(foreign, []);
  });

  it("has its names as texts", async () => {
    const texts = await page.locator("#objects tbody th").allTextContents();
    for (const name of names.slice(0, 4)) {
      assert.ok(
        texts.includes(name),
        `${name} is not in ${JSON.stringify(texts.map((text) => text.slice(0, 60)))}`,
      );
    }
    assert.ok(texts.some((text) => text.startsWith("long name name")));
  });

  it("does not make the page wider, nor its lines taller", async () => {
    const [page_px, window_px] = await page.evaluate(() => [
      document.documentElement.scrollWidth,
      innerWidth,
    ]);
    assert.ok(page_px <= window_px, `${page_px} > ${window_px}`);
    const heights = await page
      .locator("#objects tbody tr")
      .evaluateAll((rows) => rows.map((row) => row.offsetHeight));
    assert.ok(Math.max(...heights) < 80, String(heights));
  });

  it("is named under the pointer too", async () => {
    await page.getByLabel("Go to pixel").fill("32,40");
    await page.getByLabel("Go to pixel").press("Enter");
    const { object } = await readFacts(page);
    assert.ok(
      names.some((name) => name.trim() === object.trim()) || object === "\u2013",
      object.slice(0, 80),
    );
  });
});
