// An engine in a page of a headless Chromium, as a renderer that Gnomon drives: docs/renderer_protocol.md.
import { existsSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { Browser } from "./browser.mjs";

const common = join(dirname(fileURLToPath(import.meta.url)), "page");
const rasterizers = ["system", "swiftshader"];
const masks = ["shader", "picture"];

/** The words `--name=value` as an object; `allowed` has for each option its values, the default first. */
function readOptions(words, allowed) {
  const options = Object.fromEntries(Object.entries(allowed).map(([name, [first]]) => [name, first]));
  for (const word of words) {
    const [, name, value] = /^--(\w+)=(\w+)$/.exec(word) ?? [];
    if (!allowed[name]?.includes(value)) {
      const known = Object.entries(allowed).map(([option, values]) => `--${option}=${values.join("|")}`).join(" and ");
      throw new Error(`unknown option ${word}; known: ${known}`);
    }
    options[name] = value;
  }
  return options;
}

/** The version of an engine's first module, for a page that does not know. */
function installedVersion({ folder, modules: [first] }) {
  return JSON.parse(readFileSync(join(folder, "node_modules", first, "package.json"), "utf8")).version;
}

/** Answers one request after the other, all by one page. */
class Adapter {
  constructor(engine, options, browser) {
    Object.assign(this, { engine, options, browser });
  }

  async hello() {
    const { version = installedVersion(this.engine), ...device } = await this.browser.call("hello", null);
    this.device = device;
    return { protocol: 1, name: this.engine.title(this.options), version, device: device.name.slice(0, 124), keys: this.engine.keys };
  }

  async open(scene) {
    this.scene = undefined;
    if (!existsSync(scene.mesh.file)) return { error: `${scene.mesh.file} does not exist` };
    const refusal = this.engine.refusal?.(scene);
    if (refusal) return { error: refusal };
    await this.browser.call("open", { ...scene, address: this.browser.give("mesh.glb", scene.mesh.file) });
    this.scene = scene;
    return { ok: true };
  }

  async draw(order, file) {
    if (!this.scene) return { error: "there is no scene yet: open comes before draw" };
    if (!this.device) return { error: "hello comes before draw" };
    const { problems, task, tables, write } = this.engine.plan(this.scene, order, { ...this.device, mask: this.options.mask });
    if (Object.keys(problems).length > 0) return { error: problems };
    const began = performance.now();
    const names = await this.browser.call("draw", { ...task, mask: this.options.mask });
    const seconds = (performance.now() - began) / 1000;
    const posted = Object.fromEntries(names.map((name) => [name, this.browser.take(name)]));
    write(file, posted, this.scene.image);
    return { ok: true, seconds, case: typeof tables === "function" ? tables(posted) : tables };
  }

  /** What goes wrong ends the engine: refusals alone are answers, and a lost device or a full disk is none. */
  async answer(request) {
    if (request.hello) return this.hello();
    if (request.open) return this.open(request.open);
    if (request.draw) return this.draw(request.draw, request.frame);
    return { error: "asked for something else than hello, open, draw or close" };
  }
}

async function serve(engine, browser) {
  const options = readOptions(process.argv.slice(2), { ...engine.options, rasterizer: rasterizers, mask: masks });
  const modules = Object.fromEntries(engine.modules.map((name) => [name, join(engine.folder, "node_modules", name)]));
  const missing = Object.values(modules).find((folder) => !existsSync(folder));
  if (missing) throw new Error(`there is no ${missing}; install it with: ./dev engines ${engine.name}, or npm ci in that folder`);
  await browser.open({ folders: { page: join(engine.folder, "page"), common, ...modules }, page: engine.page(options), rasterizer: options.rasterizer });
  const adapter = new Adapter(engine, options, browser);
  for await (const line of createInterface({ input: process.stdin })) {
    const request = JSON.parse(line);
    if (request.close) return;
    const answer = await adapter.answer(request);
    process.stdout.write(JSON.stringify({ id: request.id, ...answer }) + "\n");
  }
}

/**
 * Speaks the protocol on standard input and output until `close`, and leaves no process and no file.
 * @param engine  name: its folder's; folder: where it stands; modules: what of node_modules it needs, each of which the page
 *                finds under its name; options: further words of the command, the defaults first; title, page: of the
 *                options, the engine's name and the page's file; keys: those of hello; refusal: of a scene, a sentence where
 *                it cannot be drawn; plan: of scene, order and device (with `mask`: what the mask is made of), `problems` by
 *                key, or the page's `task`, the case's `tables` (or of what is posted, a function), and `write(file, posted, image)`.
 */
export function drive(engine) {
  const browser = new Browser((sentence) => end(1, sentence));
  async function end(status, sentence) {
    if (sentence) process.stderr.write(`${engine.name}: ${sentence}\n`);
    await browser.close();
    process.exit(status);
  }
  ["SIGINT", "SIGTERM", "SIGHUP"].forEach((signal) => process.once(signal, () => end(1)));
  serve(engine, browser).then(() => end(0), (problem) => end(1, problem.message));
}
