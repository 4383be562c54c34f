// The pixel inspector shows the numbers of the EXR, and all of it can be reached.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { after, before, describe, it } from "node:test";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { readImages, scripts } from "./page_images.mjs";
import {
  axes,
  gnomon,
  inLane,
  job,
  makeReport,
  numberOf,
  openPage,
  pixelPoint,
  readFacts,
  settle,
  stagePixels,
  stopBrowser,
} from "./browser.mjs";

const seed = 20261122;
const classes = ["background", "unmatched", "attached", "out of light", "indeterminate", "lit", "blocked"];
const causes = ["none", "bias", "precision", "resolution", "coverage", "filter"];
const labels = ["right", "acne", "peter panning", "leak", "edge", "overshadow", "bleed"];
const jobs = {
  spot: job("sphere-plane", 96, 64, { "shadow_map.resolution": 128 }),
  pcf: job("sphere-plane", 96, 64, { "shadow_map.resolution": 128, "lookup.filter": "pcf3" }),
  reversed: job("two-distances", 96, 64, { "shadow_map.depth_format": "d32f", "shadow_map.reversed": true }),
  directional: job("columns", 96, 54, { "shadow_map.resolution": 512 }),
  cascades: job("columns", 96, 54, {
    "shadow_map.layout": "cascades",
    "shadow_map.resolution": 128,
    "bias.constant_m": 0.02,
  }),
  cube: job("lamp-room", 96, 54, { "shadow_map.resolution": 64 }),
};

function exrPixels(run, count) {
  const script = fileURLToPath(new URL("exr_pixels.py", import.meta.url));
  const words = ["-B", script, run, String(count), String(seed)];
  return JSON.parse(execFileSync("/usr/bin/python3", words, { encoding: "utf8", maxBuffer: 2 ** 26 }));
}

/** The JSON of the run's only configuration. */
function detailOf(run) {
  const [name] = readdirSync(join(run, "pixels")).filter((file) => file.endsWith(".json"));
  return JSON.parse(readFileSync(join(run, "pixels", name), "utf8"));
}

/** Compares a pixel's texts with the image's values, floats bit by bit. */
function assertFacts(facts, pixel, told, maps = undefined) {
  const map = maps?.[pixel.map_index]?.map ?? (maps ? "\u2013" : undefined);
  assert.equal(facts.map?.split(":")[0], map, told);
  assert.equal(facts.x, String(pixel.x), told);
  assert.equal(facts.y, String(pixel.y), told);
  assert.equal(facts.class, classes[pixel.class], told);
  const isScored = ["lit", "blocked"].includes(facts.class);
  assert.equal(facts.cause, isScored ? causes[pixel.cause] : "\u2013", told);
  assert.equal(facts.label, isScored ? labels[pixel.label] : "\u2013", told);
  for (const name of ["prim", "witness"]) {
    const wanted = pixel[name] === 0xffffffff ? "\u2013" : String(pixel[name]);
    assert.equal(facts[name], wanted, `${told}: ${name}`);
  }
  const depths = ["verdict", "receiver_depth", "map_depth"];
  for (const name of [...depths, "critical_bias", "needed_bias_m", "needed_bias_texels"]) {
    const hasNone = name === "verdict" && facts.class === "background";
    const wanted = hasNone ? NaN : ({ nan: NaN, inf: Infinity, "-inf": -Infinity }[pixel[name]] ?? pixel[name]);
    assert.equal(Math.fround(numberOf(facts[name])), wanted, `${told}: ${name} “${facts[name]}”`);
  }
}

describe("The inspector", () => {
  let report;
  let page;
  before(async () => {
    report = makeReport("spot", "compare", ...jobs.spot);
    page = await openPage(report.page);
    await page.locator("#inspector .stage").scrollIntoViewIfNeeded();
  });
  after(stopBrowser);

  const layer = (side) => page.getByLabel(`Layer ${side}`, { exact: true });

  it("opens from the disk without a request, a message or an error", () => {
    assert.deepEqual(page.faults, []);
  });

  it("shows other pixels for each layer", async () => {
    const options = await layer("A")
      .locator("option")
      .evaluateAll((all) => all.map(({ value }) => value));
    assert.ok(options.length >= 8, options.join());
    await page.getByLabel("Wipe", { exact: true }).fill("100");
    const seen = new Map();
    for (const option of options) {
      await layer("A").selectOption(option);
      await settle(page);
      const pixels = await stagePixels(page);
      assert.ok(!seen.has(pixels), `${option} looks like ${seen.get(pixels)}`);
      seen.set(pixels, option);
    }
    await layer("A").selectOption("gl");
  });

  it("has a wipe that moves by its range, by keys and by dragging", async () => {
    const handle = page.getByRole("slider", { name: "Wipe between layers A and B" });
    await page.getByLabel("Wipe", { exact: true }).fill("50");
    await settle(page);
    const half = await stagePixels(page);
    await handle.focus();
    await page.keyboard.press("ArrowRight");
    assert.equal(await handle.getAttribute("aria-valuenow"), "52");
    await settle(page);
    assert.notEqual(await stagePixels(page), half);
    const from = await handle.boundingBox();
    const stage = await page.locator("#inspector .stage").boundingBox();
    await page.mouse.move(from.x + from.width / 2, from.y + 20);
    await page.mouse.down();
    await page.mouse.move(stage.x + 0.25 * stage.width, from.y + 20, { steps: 4 });
    await page.mouse.up();
    assert.equal(await handle.getAttribute("aria-valuenow"), "25");
    await page.keyboard.press("Home");
    assert.equal(await handle.getAttribute("aria-valuenow"), "0");
    await page.keyboard.press("End");
  });

  it("zooms with keys, buttons and the wheel, pans, and shows all again", async () => {
    const canvas = page.locator("#inspector .stage-canvas");
    const zoom = async () =>
      numberOf((await page.getByLabel("Zoom", { exact: true }).first().textContent()).replace(" %", ""));
    const fitted = await zoom();
    await canvas.focus();
    await page.keyboard.press("+");
    assert.ok((await zoom()) > fitted);
    await page.getByRole("button", { name: "Zoom in" }).click();
    const closer = await zoom();
    await settle(page);
    const before = await stagePixels(page);
    await canvas.focus();
    await page.keyboard.press("Shift+ArrowRight");
    await settle(page);
    assert.notEqual(await stagePixels(page), before);
    const box = await canvas.boundingBox();
    await page.mouse.move(box.x + box.width / 3, box.y + box.height / 3);
    await page.mouse.wheel(0, -300);
    await page.waitForFunction(
      (low) => parseFloat(document.querySelector("#inspector output").textContent) > low,
      closer,
    );
    await page.getByRole("button", { name: "Show all" }).click();
    assert.equal(await zoom(), fitted);
  });

  it("moves a cursor by keys, pins with Enter, and goes to a pixel", async () => {
    await page.locator("#inspector .stage-canvas").focus();
    await page.keyboard.press("ArrowRight");
    const first = await readFacts(page);
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("ArrowDown");
    const second = await readFacts(page);
    assert.deepEqual([Number(second.x), Number(second.y)], [Number(first.x) + 1, Number(first.y) + 1]);
    await page.keyboard.press("Enter");
    assert.match(await page.locator("#inspector .pixel h3").textContent(), /pinned/);
    await page.keyboard.press("Enter");
    await page.getByLabel("Go to pixel").fill("7, 60");
    await page.getByLabel("Go to pixel").press("Enter");
    assert.equal((await readFacts(page)).x, "7");
    assert.equal((await readFacts(page)).y, "60");
    await page.locator("#inspector .stage-canvas").focus();
    await page.keyboard.press("Enter");
    await page.keyboard.press("0");
    assert.deepEqual(page.faults, []);
  });

  it("says of the sky that it has no verdict", async () => {
    await page.getByLabel("Go to pixel").fill("0,0");
    await page.getByLabel("Go to pixel").press("Enter");
    await settle(page);
    const { class: pixelClass, ...facts } = await readFacts(page);
    assert.equal(pixelClass, "background");
    for (const key of ["truth", "shown", "verdict", "cause", "label", "object"]) {
      assert.equal(facts[key], "\u2013", key);
    }
  });

  it("pins the pixel that a finger taps, and zooms with two", async () => {
    const phone = await openPage(report.page, { width: 390, height: 800, hasTouch: true });
    await phone.locator("#inspector .stage").scrollIntoViewIfNeeded();
    const at = await pixelPoint(phone, { width: 96, height: 64 }, 10, 50);
    await phone.touchscreen.tap(at.x, at.y);
    assert.match(await phone.locator("#inspector .pixel h3").textContent(), /10, 50 \(pinned\)/);
    const zoom = () => phone.locator("#inspector output").textContent().then(parseFloat);
    const fitted = await zoom();
    const fingers = await phone.context().newCDPSession(phone);
    const touch = (type, gap) => {
      const touchPoints = [-gap, gap].map((dx, id) => ({ x: at.x + 100 + dx, y: at.y - 50, id }));
      return fingers.send("Input.dispatchTouchEvent", { type, touchPoints: gap === 0 ? [] : touchPoints });
    };
    await touch("touchStart", 20);
    for (const gap of [25, 30, 40]) {
      await touch("touchMove", gap);
    }
    await touch("touchEnd", 0);
    assert.ok((await zoom()) > 1.5 * fitted, `${await zoom()} % after ${fitted} %`);
    assert.match(await phone.locator("#inspector .pixel h3").textContent(), /10, 50 \(pinned\)/);
    assert.deepEqual(phone.faults, []);
    await phone.close();
  });
});

describe("A hovered pixel", () => {
  after(stopBrowser);
  for (const [name, words] of inLane(jobs, "pcf", "cascades", "cube")) {
    it(`shows the numbers of the EXR, float32 by float32: ${name}`, async () => {
      const { run, page: file } = makeReport(`hover-${name}`, "compare", ...words);
      const image = exrPixels(run, 80);
      const { by_map: maps } = detailOf(run);
      const page = await openPage(file);
      await page.locator("#inspector .stage").scrollIntoViewIfNeeded();
      // At either end the wipe's handle covers only a few pixels.
      for (const [wipe, isHere] of [
        ["0", (x) => x >= 8],
        ["100", (x) => x < 8],
      ]) {
        await page.getByLabel("Wipe", { exact: true }).fill(wipe);
        for (const pixel of image.pixels.filter(({ x }) => isHere(x))) {
          const at = await pixelPoint(page, image, pixel.x, pixel.y);
          await page.mouse.move(at.x, at.y);
          assertFacts(await readFacts(page), pixel, `${name}, seed ${seed}, pixel ${pixel.x}, ${pixel.y}`, maps);
        }
      }
      assert.deepEqual(page.faults, []);
      await page.close();
    });
  }
});

describe("Wrong pixels", () => {
  let file;
  let image;
  before(async () => {
    ({ page: file } = makeReport("errors", "compare", ...job("columns", 1280, 720)));
    [image] = await readImages(file);
  });
  after(stopBrowser);

  const shownError = (page) => page.locator("#inspector .error-text").textContent();
  /** How many pixels of the stage have a colour, of red, green and blue, each to a difference. */
  const coloured = (page, colour, difference = 0) =>
    page.evaluate(([wanted, most]) => {
      const canvas = document.querySelector("#inspector .stage-canvas");
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let at = 0; at < data.length; at += 4) {
        count += wanted.every((value, i) => Math.abs(data[at + i] - value) <= most) ? 1 : 0;
      }
      return count;
    }, [colour, difference]);

  it("are shown cluster by cluster, by buttons and by keys", async () => {
    const page = await openPage(file);
    const causes = new scripts.ErrorCauses(image);
    const clusters = scripts.errorClusters(image, image.jobBias);
    const wanted = (place) => {
      const { text, object } = scripts.describeCluster(causes, clusters[place], image.jobBias);
      return `Error ${place + 1} of ${clusters.length.toLocaleString("en")}: ${text} on ${object}`;
    };
    await page.getByRole("button", { name: "Next error" }).click();
    assert.equal(await shownError(page), wanted(0));
    await page.locator("#inspector .stage-canvas").focus();
    await page.keyboard.press("n");
    await page.keyboard.press("n");
    assert.equal(await shownError(page), wanted(2));
    await page.keyboard.press("p");
    assert.equal(await shownError(page), wanted(1));
    const { x, y } = scripts.middlePixel(clusters[1], image.width);
    const facts = await readFacts(page);
    assert.deepEqual([Number(facts.x), Number(facts.y)], [x, y]);
    assert.ok((await coloured(page, [0xd5, 0x5e, 0x00])) >= clusters[1].length, "the cluster is in view");
    assert.match(await page.locator("#inspector .stage-canvas").getAttribute("aria-label"), /n and p show/);
    assert.deepEqual(page.faults, []);
    await page.close();
  });

  it("are found anew at another bias, from the largest on", async () => {
    const page = await openPage(file);
    await page.getByRole("button", { name: "Previous error" }).click();
    const clusters = scripts.errorClusters(image, image.jobBias);
    assert.match(await shownError(page), new RegExp(`^Error ${clusters.length.toLocaleString("en")} of`));
    await page.getByLabel("Exactly").fill("0.25");
    await page.getByLabel("Exactly").press("Enter");
    assert.match(await shownError(page), /^Go from one cluster/);
    await page.getByRole("button", { name: "Next error" }).click();
    const there = scripts.errorClusters(image, 0.25);
    assert.match(await shownError(page), new RegExp(`^Error 1 of ${there.length.toLocaleString("en")}: `));
    await page.close();
  });

  it("say in a sentence what happened, with the texels around and all numbers beneath", async () => {
    const page = await openPage(file);
    const causes = new scripts.ErrorCauses(image);
    await page.getByRole("button", { name: "Next error" }).click();
    const { x, y } = scripts.middlePixel(scripts.errorClusters(image, image.jobBias)[0], image.width);
    const index = y * image.width + x;
    const sentence = page.locator("#inspector .sentence");
    assert.equal(await sentence.textContent(), scripts.pixelSentence(causes, index, image.jobBias));
    assert.match(await sentence.textContent(), /^(Lit, but shadowed|In shadow, but lit): /);
    const counts = scripts.texelStatesAround(causes, index, image.jobBias).filter((state) => state === 1).length;
    const told = await page.getByRole("img", { name: /^Texels of the shadow map around/ }).getAttribute("aria-label");
    assert.ok(told.includes(`${counts} nearer`), told);
    assert.ok(!(await page.locator("#inspector .facts").isVisible()));
    await page.getByText("All numbers").click();
    assert.ok(await page.locator("#inspector .facts").isVisible());
    await page.getByLabel("Go to pixel").fill("0,0");
    await page.getByLabel("Go to pixel").press("Enter");
    assert.equal(await sentence.textContent(), "Background: the camera sees no surface here.");
    assert.ok(!(await page.locator("#inspector .texels").isVisible()));
    await page.close();
  });

  it("are drawn larger below 100 % alone", async () => {
    const { page: small } = makeReport("few pixels", "compare", ...jobs.spot);
    const marks = async (path) => {
      const page = await openPage(path);
      await page.getByLabel("Wipe", { exact: true }).fill("0");
      await settle(page);
      const zoom = parseFloat(await page.locator("#inspector output").textContent()) / 100;
      const count = await coloured(page, [0xd5, 0x5e, 0x00], 60);
      const wrong = numberOf(await page.locator("[data-count=false_shadow]").textContent());
      await page.close();
      return { zoom, area: count / (wrong * zoom * zoom) };
    };
    const far = await marks(file);
    assert.ok(far.zoom < 0.7, `${far.zoom}`);
    // A lone mark covers 9 pixels of the image, one in a row 3.
    assert.ok(far.area > 2 && far.area <= 9, `${far.area} of the wrong pixels' area`);
    const near = await marks(small);
    assert.ok(near.zoom > 5, `${near.zoom}`);
    // Edges of marks are up to half a pixel of the screen off, on each side of 7 px.
    assert.ok(Math.abs(near.area - 1) < 0.15, `${near.area} of the wrong pixels' area`);
  });

  it("stand with the slider, the counts, the curve and a pixel in a window of 1280 by 900", async () => {
    const page = await openPage(file);
    await page.getByRole("button", { name: "Next error" }).click();
    const rows = await page.evaluate(() => {
      const edges = (part) => {
        const { top, bottom, left, right } = document.querySelector(`#inspector ${part}`).getBoundingClientRect();
        return { top, bottom, left, right };
      };
      const parts = [".bias-range", ".totals", ".curve-host", ".stage", ".pixel", ".legends"];
      return { heading: edges("h2").top, ...Object.fromEntries(parts.map((part) => [part, edges(part)])) };
    });
    const { heading, ...parts } = rows;
    for (const [part, { bottom }] of Object.entries(parts)) {
      assert.ok(bottom - heading <= 900, `${part} ends ${bottom - heading} px below the heading`);
    }
    assert.ok(parts[".bias-range"].bottom <= parts[".stage"].top, "the slider is above the picture");
    assert.ok(parts[".totals"].top < parts[".stage"].top, "the counts are beside the slider");
    for (const part of [".totals", ".curve-host", ".pixel"]) {
      assert.ok(parts[part].left >= parts[".stage"].right, `${part} is beside the picture`);
    }
    await page.close();
  });

  it("are below each other on a phone, the slider and its counts before the picture", async () => {
    const page = await openPage(file, { width: 390, height: 844 });
    const tops = await page.evaluate(() =>
      [".bias-range", ".totals", ".stage", ".error-text", ".pixel", ".legends", ".curve-host"].map(
        (part) => document.querySelector(`#inspector ${part}`).getBoundingClientRect().top,
      ),
    );
    tops.slice(1).forEach((top, i) => assert.ok(top > tops[i], `part ${i + 1} at ${top} after ${tops[i]}`));
    const [slider, , stage] = tops;
    const height = await page.locator("#inspector .stage").evaluate((part) => part.clientHeight);
    assert.ok(stage + height - slider <= 844, "the slider and the picture are seen together");
    await page.close();
  });

  it("have their causes at the slider's bias, where the page knows them", async () => {
    const page = await openPage(file);
    await page.getByLabel("Layer B", { exact: true }).selectOption("cause");
    await page.getByLabel("Wipe", { exact: true }).fill("0");
    const unknown = [0x4a, 0x50, 0x58];
    await settle(page);
    assert.equal(await coloured(page, unknown), 0);
    await page.getByLabel("Exactly").fill("0");
    await page.getByLabel("Exactly").press("Enter");
    await settle(page);
    assert.ok((await coloured(page, unknown)) > 0);
    const legend = page.locator("#inspector .legend").nth(1);
    assert.ok(await legend.getByText("wrong at this bias, cause known at the job’s bias only").isVisible());
    await page.getByRole("button", { name: "Next error" }).click();
    const facts = await readFacts(page);
    assert.equal(facts.cause_here, "known at the job’s bias only");
    await page.close();
  });
});

describe("Several maps of a light", () => {
  const runs = {};
  before(() => {
    for (const name of ["cascades", "cube"]) {
      runs[name] = makeReport(`maps-${name}`, "compare", ...jobs[name]);
    }
  });
  after(stopBrowser);

  /** The cells of the table of maps, by its headings. */
  const tableRows = (page) =>
    page
      .locator("#objects table")
      .filter({ has: page.getByText("Errors by map", { exact: true }) })
      .evaluate((table) => {
        const headings = [...table.tHead.rows[0].cells].map((cell) => cell.textContent);
        return [...table.tBodies[0].rows].map((row) =>
          Object.fromEntries([...row.cells].map((cell, i) => [headings[i], cell.textContent])),
        );
      });

  it("are a layer with a legend that names them", async () => {
    for (const { run, page: file } of Object.values(runs)) {
      const page = await openPage(file);
      const { by_map: maps } = detailOf(run);
      await page.getByLabel("Layer A", { exact: true }).selectOption("maps");
      await page.getByLabel("Wipe", { exact: true }).fill("100");
      const names = await page.locator("#inspector .legend").first().locator("li").allTextContents();
      assert.deepEqual(
        names.slice(0, -1).map((name) => name.split(":")[0]),
        maps.map(({ map }) => map),
      );
      assert.deepEqual(page.faults, []);
      await page.close();
    }
  });

  it("have a row each with their errors, and cascades what they see", async () => {
    for (const [name, { run, page: file }] of Object.entries(runs)) {
      const page = await openPage(file);
      const { by_map: maps } = detailOf(run);
      const rows = await tableRows(page);
      assert.equal(rows.length, maps.length);
      maps.forEach((map, i) => {
        const row = rows[i];
        assert.equal(row.cascade ?? row.map, map.map);
        assert.equal(numberOf(row["false shadow"]), map.false_shadow);
        assert.equal(numberOf(row["false lit"]), map.false_lit);
        assert.equal("view depth [m]" in row, name === "cascades");
        if (name === "cascades") {
          const close = (text, value) =>
            assert.ok(Math.abs(numberOf(text) - value) <= 5e-4 * Math.abs(value), `${text}, ${value}`);
          const [begin, end] = row["view depth [m]"].split(" to ");
          close(begin, map.begin_m);
          close(end, map.end_m);
          close(row["texel [m]"], map.texel_m);
          close(row["range [m]"], map.far_m - map.near_m);
          close(row["bias [m]"], map.bias.constant_m);
        }
      });
      await page.close();
    }
  });

  it("are compared in a chart, whose data are their rates", async () => {
    const page = await openPage(runs.cascades.page);
    const { by_map: maps } = detailOf(runs.cascades.run);
    const figure = page.locator("#objects .chart-figure").filter({ hasText: "by map" });
    await figure.locator("summary").click();
    await figure.locator("tbody tr").first().waitFor();
    const rows = await figure
      .locator("tbody tr")
      .evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
    assert.equal(rows.length, maps.length);
    const isRate = (text, rate) =>
      rate === null ? Number.isNaN(numberOf(text)) : Math.abs(numberOf(text) - rate) <= 1e-8 * rate;
    rows.forEach(([map, shadow, light], i) => {
      assert.equal(map.split(":")[0], maps[i].map);
      assert.ok(isRate(shadow, maps[i].false_shadow_rate), shadow);
      assert.ok(isRate(light, maps[i].false_lit_rate), light);
    });
    await page.close();
  });

  it("are forgotten where the configuration shown next has one", async () => {
    const layouts = axes({ "shadow_map.layout": "cascades,single" });
    const sweep = [...job("columns", 96, 54, { "shadow_map.resolution": 128 }), ...layouts, "--keep-pixels", "--quiet"];
    const { page: file } = makeReport("maps-layouts", "sweep", ...sweep);
    const page = await openPage(file);
    const shown = async (layout) => {
      await page.locator(".rows tr[data-place]").filter({ hasText: layout }).click();
      await page.waitForFunction(
        (name) => document.querySelector("#inspector .caption").textContent.includes(name),
        layout,
      );
      await page.getByLabel("Go to pixel").fill("48,40");
      await page.getByLabel("Go to pixel").press("Enter");
      await settle(page);
      const layers = await page
        .getByLabel("Layer A", { exact: true })
        .locator("option")
        .evaluateAll((all) => all.map(({ value }) => value));
      const tables = await page.locator("#objects caption").allTextContents();
      return [
        "map" in (await readFacts(page)),
        layers.includes("maps"),
        tables.some((caption) => caption.startsWith("Errors by map")),
      ];
    };
    assert.deepEqual(await shown("cascades"), [true, true, true]);
    assert.deepEqual(await shown("single"), [false, false, false]);
    assert.deepEqual(page.faults, []);
    await page.close();
  });
});
