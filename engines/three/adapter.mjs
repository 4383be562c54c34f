#!/usr/bin/env node
// three.js as a renderer that Gnomon drives: docs/renderer_protocol.md. README.md says how it is made to say what it does.
import { existsSync } from "node:fs";
import { dirname, join } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { Browser } from "../common/browser.mjs";
import { writeFrame } from "./frame.mjs";
import { keys, plan } from "./settings.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const names = { webgl: "three.js", webgpu: "three.js WebGPU" };
let browser;

/** Ends Chromium, and then this program, with a sentence on standard error if there is one. */
async function end(status, sentence) {
  if (sentence) process.stderr.write(`three: ${sentence}\n`);
  await browser?.close();
  process.exit(status);
}

function readOptions(words) {
  const options = { api: "webgl", rasterizer: "system" };
  const allowed = { api: ["webgl", "webgpu"], rasterizer: ["system", "swiftshader"] };
  for (const word of words) {
    const [, name, value] = /^--(\w+)=(\w+)$/.exec(word) ?? [];
    if (!allowed[name]?.includes(value)) throw new Error(`unknown option ${word}; --api=webgl|webgpu and --rasterizer=system|swiftshader are known`);
    options[name] = value;
  }
  return options;
}

/** Answers one request after the other, all by one page. */
class Adapter {
  constructor(api) {
    this.api = api;
  }

  async hello() {
    const { version, ...device } = await browser.call("hello", null);
    this.device = device;
    return { protocol: 1, name: names[this.api], version, device: device.name.slice(0, 124), keys };
  }

  async open(scene) {
    this.scene = undefined;
    if (!existsSync(scene.mesh.file)) return { error: `${scene.mesh.file} does not exist` };
    await browser.call("open", { ...scene, address: browser.give("mesh.glb", scene.mesh.file) });
    this.scene = scene;
    return { ok: true };
  }

  async draw(order, file) {
    if (!this.scene) return { error: "there is no scene yet: open comes before draw" };
    if (!this.device) return { error: "hello comes before draw" };
    const { light, image } = this.scene;
    const { problems, settings, tables, filter } = plan(this.scene, order, this.device);
    if (Object.keys(problems).length > 0) return { error: problems };
    const began = performance.now();
    const posts = await browser.call("draw", { settings, withUnmoved: filter === "hardware" || (filter && settings.normalBias !== 0), withMap: filter !== undefined });
    const seconds = (performance.now() - began) / 1000;
    const posted = Object.fromEntries(posts.map((name) => [name, browser.take(name)]));
    writeFrame(file, posted, image, { resolution: settings.resolution, isCube: light.type === "point", filter });
    return { ok: true, seconds, case: { ...tables, ...(posted.map && { map: { file: "map.exr" } }) } };
  }

  async answer(request) {
    try {
      if (request.hello) return await this.hello();
      if (request.open) return await this.open(request.open);
      if (request.draw) return await this.draw(request.draw, request.frame);
      return { error: "asked for something else than hello, open, draw or close" };
    } catch (problem) {
      return { error: problem.message };
    }
  }
}

async function main() {
  const { api, rasterizer } = readOptions(process.argv.slice(2));
  const three = join(here, "node_modules", "three");
  if (!existsSync(three)) throw new Error(`there is no ${three}; install it with: ./dev engines three, or npm ci in that folder`);
  browser = new Browser((sentence) => end(1, sentence));
  await browser.open({ folders: { page: join(here, "page"), three }, page: `${api}.html`, rasterizer });
  const adapter = new Adapter(api);
  for await (const line of createInterface({ input: process.stdin })) {
    const request = JSON.parse(line);
    if (request.close) return;
    const answer = await adapter.answer(request);
    process.stdout.write(JSON.stringify({ id: request.id, ...answer }) + "\n");
  }
}

["SIGINT", "SIGTERM", "SIGHUP"].forEach((signal) => process.once(signal, () => end(1)));
main().then(() => end(0), (problem) => end(1, problem.message));
