// A headless Chromium, the program that $GNOMON names, and runs and reports made by it.

import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const require = createRequire(join(process.env.GNOMON_PAGE_MODULES, "node_modules", "x"));
const { chromium } = require("playwright-core");
export const axeSource = require.resolve("axe-core/axe.min.js");

export const workFolder = mkdtempSync(join(tmpdir(), "gnomon-page-"));
process.on("exit", () => rmSync(workFolder, { recursive: true, force: true }));

/** Runs the program and returns its output; throws if it fails. */
export function gnomon(...words) {
  return execFileSync(process.env.GNOMON, words, {
    encoding: "utf8",
    maxBuffer: 2 ** 28,
    stdio: ["ignore", "pipe", "pipe"],
  });
}

/** The entries with these names, or all in the full lane. */
export function inLane(all, ...usual) {
  return Object.entries(all).filter(([name]) => process.env.GNOMON_FULL_TESTS || usual.includes(name));
}

/** The command line of a job: a built-in scene or a file's path, the image's size, and settings by key. */
export function job(scene, width, height, settings = {}) {
  const keys = { "image.width": width, "image.height": height, ...settings };
  return [...(scene.includes("/") ? [scene] : ["--builtin", scene]), ...options("--set", keys)];
}

/** The command line of a sweep's axes, by key. */
export const axes = (values) => options("--axis", values);

function options(name, values) {
  return Object.entries(values).flatMap(([key, value]) => [name, `${key}=${value}`]);
}

/**
 * Makes a run and its page.
 * @param {string} name  of the run's folder
 * @param {string} command  compare, sweep or evaluate
 * @param {...string} words  the rest of its command line
 * @return {{run: string, page: string}}
 */
export function makeReport(name, command, ...words) {
  const run = join(workFolder, name);
  gnomon(command, ...words, "--out", run);
  gnomon("report", run, "--out", `${run} report`);
  return { run, page: join(`${run} report`, "report.html") };
}

let browser = null;

/** Starts the browser once per test file. */
export async function startBrowser() {
  const sandbox = process.getuid() === 0 ? ["--no-sandbox"] : [];
  browser ??= await chromium.launch({ executablePath: process.env.GNOMON_CHROMIUM, args: sandbox });
  return browser;
}

export async function stopBrowser() {
  await browser?.close();
  browser = null;
}

/**
 * Opens a page from the disk and waits until its scripts have filled it.
 * @return {Promise<Page>}  with `page.faults`: requests, messages of the console, errors and dialogs
 */
export async function openPage(
  file,
  { width = 1280, height = 900, colorScheme = "light", hasTouch = false } = {},
) {
  const started = await startBrowser();
  const viewport = { width, height };
  const context = await started.newContext({ viewport, colorScheme, hasTouch, reducedMotion: "reduce" });
  const page = await context.newPage();
  const address = pathToFileURL(file).href;
  page.faults = [];
  page.on("request", (request) => {
    const url = request.url();
    if (!/^(data|blob):/.test(url) && url !== address) {
      page.faults.push(`request ${url}`);
    }
  });
  page.on("console", (message) => page.faults.push(`console ${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => page.faults.push(`error ${error.stack}`));
  page.on("dialog", (dialog) => {
    page.faults.push(`dialog ${dialog.message()}`);
    dialog.dismiss();
  });
  await page.goto(address);
  await page.waitForSelector("html[data-ready=true]", { timeout: 60000 });
  return page;
}

/** Waits two frames, so that work postponed to the next frame is done. */
export function settle(page) {
  return page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

/** The texts of the pixel's numbers by key. */
export function readFacts(page) {
  return page.evaluate(() =>
    Object.fromEntries(
      [...document.querySelectorAll("#inspector dd[data-key]")].map((dd) => [dd.dataset.key, dd.textContent]),
    ),
  );
}

/** The screen position of a pixel's centre, with the whole image shown. */
export async function pixelPoint(page, { width, height }, x, y) {
  const box = await page.locator("#inspector .stage").boundingBox();
  const zoom = Math.min(box.width / width, box.height / height);
  return {
    x: box.x + (box.width - width * zoom) / 2 + (x + 0.5) * zoom,
    y: box.y + (box.height - height * zoom) / 2 + (y + 0.5) * zoom,
  };
}

/** Parses a number of the page. */
export function numberOf(text) {
  const plain = text.replace("\u2212", "-").replace(" m", "").replaceAll(",", "");
  return { "\u2013": NaN, "+\u221E": Infinity, "-\u221E": -Infinity }[plain] ?? Number(plain);
}

/** The stage as a data URL. */
export function stagePixels(page) {
  return page.evaluate(() => document.querySelector("#inspector .stage canvas").toDataURL());
}
