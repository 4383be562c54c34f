// Lets Gnomon drive an engine in a headless Chromium (docs/renderer_protocol.md).
import { existsSync, readFileSync } from "node:fs";
import { dirname, join, relative, resolve } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { Browser } from "./browser.mjs";

const common = join(dirname(fileURLToPath(import.meta.url)), "page");
const rasterizers = ["system", "swiftshader"];
const masks = ["shader", "picture"];

/**
 * Parses `--name=value`. `allowed` lists the values of each option, the default first. If `takesModule`, one other word may name
 * the `module` of a project.
 */
function readOptions(words, allowed, takesModule) {
  const options = Object.fromEntries(Object.entries(allowed).map(([name, [first]]) => [name, first]));
  for (const word of words) {
    const [, name, value] = /^--(\w+)=(\w+)$/.exec(word) ?? [];
    if (takesModule && !word.startsWith("-") && !options.module) {
      options.module = resolve(word);
      if (!existsSync(options.module)) throw new Error(`there is no module ${options.module}`);
    } else if (allowed[name]?.includes(value)) {
      options[name] = value;
    } else {
      const known = Object.entries(allowed).map(([option, values]) => `--${option}=${values.join("|")}`).join(" and ");
      throw new Error(`unknown option ${word}; known: ${known}`);
    }
  }
  return options;
}

/** The folder of a module's project: the nearest one with a package.json or node_modules, else the module's own. */
function projectOf(module) {
  for (let folder = dirname(module); ; folder = dirname(folder)) {
    if (["package.json", "node_modules"].some((name) => existsSync(join(folder, name)))) return folder;
    if (folder === dirname(folder)) return dirname(module);
  }
}

/** The version of an engine's first module, for pages that do not know it. */
function installedVersion({ folder, modules: [first] }) {
  return JSON.parse(readFileSync(join(folder, "node_modules", first, "package.json"), "utf8")).version;
}

/** Answers requests with one page. */
class Adapter {
  constructor(engine, options, browser) {
    Object.assign(this, { engine, options, browser });
  }

  async hello() {
    const { version = installedVersion(this.engine), ...device } = await this.browser.call("hello", null);
    this.device = device;
    return { protocol: 1, name: this.engine.title(this.options), version, device: device.name.slice(0, 124),
      keys: typeof this.engine.keys === "function" ? this.engine.keys(device) : this.engine.keys };
  }

  async open(scene) {
    this.scene = undefined;
    if (!existsSync(scene.mesh.file)) return { error: `${scene.mesh.file} does not exist` };
    const refusal = this.engine.refusal?.(scene, this.device);
    if (refusal) return { error: refusal };
    await this.browser.call("open", { ...scene, address: this.browser.give("mesh.glb", scene.mesh.file) });
    this.scene = scene;
    return { ok: true };
  }

  async draw(order, file) {
    if (!this.scene) return { error: "no scene is open: send open before draw" };
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

  /** Only refusals are answers; any other failure, such as a lost device, ends the engine. */
  async answer(request) {
    if (request.hello) return this.hello();
    if (request.open) return this.open(request.open);
    if (request.draw) return this.draw(request.draw, request.frame);
    return { error: "unknown request; known are hello, open, draw and close" };
  }
}

/** The folders of the page's modules, by name: a project's own, else those installed for the engine. */
function modulesOf(engine, project) {
  return Object.fromEntries(engine.modules.map((name) => {
    const own = project && join(project, "node_modules", name);
    return [name, own && existsSync(own) ? own : join(engine.folder, "node_modules", name)];
  }));
}

/**
 * Opens the engine's page in the browser, and returns the options of the command line.
 * @throws Error if the engine is not installed, or the page cannot be loaded.
 */
export async function openPage(engine, words, browser) {
  const options = readOptions(words, { ...engine.options, rasterizer: rasterizers, mask: masks }, engine.takesModule);
  const project = options.module && projectOf(options.module);
  if (project && options.mask === "picture") throw new Error("--mask=picture: a project's materials are its own, and make no quotient");
  const modules = modulesOf(engine, project);
  const missing = Object.values(modules).find((folder) => !existsSync(folder));
  if (missing) throw new Error(`there is no ${missing}; install it with: ./dev engines ${engine.name}, or npm ci in that folder`);
  const folders = { page: join(engine.folder, "page"), common, ...modules, ...(project && { project }) };
  const query = project ? `?module=${encodeURIComponent(relative(project, options.module))}` : "";
  await browser.open({ folders, page: engine.page(options) + query, rasterizer: options.rasterizer });
  return options;
}

async function serve(engine, browser) {
  const options = await openPage(engine, process.argv.slice(2), browser);
  const adapter = new Adapter(engine, options, browser);
  for await (const line of createInterface({ input: process.stdin })) {
    const request = JSON.parse(line);
    if (request.close) return;
    const answer = await adapter.answer(request);
    process.stdout.write(JSON.stringify({ id: request.id, ...answer }) + "\n");
  }
}

/**
 * Serves the protocol on standard input and output until `close`; leaves no process and no file.
 * @param engine  name: of its folder; folder: its path; modules: needed from node_modules, which the page finds by their
 *                names; options: values of further options, the defaults first; takesModule: whether a word may name a
 *                project's module, which the page finds under `project`; title(options): the engine's name; page(options): the
 *                page's file; keys: for hello, or a function of the device; refusal(scene, device): why the scene cannot be
 *                drawn; plan(scene, order, device with `mask`): `problems` by key, or the page's `task`, the case's `tables`
 *                (or a function of the posted data), and `write(file, posted, image)`.
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
