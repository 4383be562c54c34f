// A headless Chromium with one page, controlled over DevTools' pipe, and a local server for the page's files.
import { spawn } from "node:child_process";
import { randomBytes } from "node:crypto";
import { createReadStream, existsSync, mkdtempSync, rmSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";
import { setTimeout as delay } from "node:timers/promises";

const types = { ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript" };
const rasterizers = {
  system: ["--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist"],
  swiftshader: ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
};
const socketName = "/org.chromium.Chromium.XXXXXX/SingletonSocket";
const longestSocketPath = 107; // sun_path of sockaddr_un without its final zero
const programs = ["chromium", "chromium-browser", "google-chrome"];

/**
 * Serves the page's files under a secret path, and receives its posts.
 * `folders` maps the first part of a path to a folder; `given` maps names to single files.
 */
async function serve(folders, given, receive) {
  const secret = randomBytes(16).toString("hex");
  const server = createServer((request, response) => {
    const [, word, first, ...rest] = new URL(request.url, "http://localhost").pathname.split("/");
    if (word !== secret) return response.writeHead(404).end();
    if (request.method === "POST") {
      const parts = [];
      request.on("data", (part) => parts.push(part));
      return request.on("end", () => {
        receive(first, Buffer.concat(parts));
        response.end();
      });
    }
    const path = given.get(first) ?? (folders[first] && join(folders[first], normalize("/" + rest.join("/"))));
    if (!path || !statSync(path, { throwIfNoEntry: false })?.isFile()) return response.writeHead(404).end();
    response.writeHead(200, { "Content-Type": types[extname(path)] ?? "application/octet-stream", "Cache-Control": "no-store" });
    return createReadStream(path).pipe(response);
  });
  await new Promise((resolve, reject) => server.once("error", reject).listen(0, "127.0.0.1", resolve));
  return { server, address: `http://127.0.0.1:${server.address().port}/${secret}` };
}

/** DevTools' protocol over two pipes, with zero-terminated JSON messages. */
class DevTools {
  #waiting = new Map();
  #number = 0;
  #rest = "";

  constructor(child, onEvent) {
    this.pipe = child.stdio[3];
    child.stdio[4].setEncoding("utf8").on("data", (text) => {
      const messages = (this.#rest + text).split("\0");
      this.#rest = messages.pop();
      messages.map((message) => JSON.parse(message)).forEach((message) => this.#take(message, onEvent));
    });
    this.pipe.on("error", () => {}); // the end of the browser is handled elsewhere
  }

  #take(message, onEvent) {
    const waiting = this.#waiting.get(message.id);
    if (!waiting) return onEvent(message);
    this.#waiting.delete(message.id);
    if (message.error) return waiting.reject(new Error(`DevTools: ${message.error.message}`));
    return waiting.resolve(message.result);
  }

  send(method, params = {}, sessionId = undefined) {
    this.#number += 1;
    const id = this.#number;
    this.pipe.write(JSON.stringify({ id, method, params, sessionId }) + "\0");
    return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
  }
}

function start(program, profile, rasterizer) {
  const folders = { HOME: profile, XDG_CONFIG_HOME: profile, XDG_CACHE_HOME: profile, TMPDIR: profile };
  return spawn(program, [
    "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--no-first-run", "--disable-extensions",
    "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-default-browser-check",
    `--user-data-dir=${profile}`, "--remote-debugging-pipe", "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader",
    ...rasterizers[rasterizer], "about:blank",
  ], { stdio: ["ignore", "ignore", "pipe", "pipe", "pipe"], env: { ...process.env, ...folders } });
}

/** Chromium with one page, `page/NAME.html`, whose functions can be called. */
export class Browser {
  #received = new Map();
  #given = new Map();
  #lastWords = "";
  #isClosing = false;
  #onEnd;
  #onLoad;

  /** @param onEnd  called with a sentence if Chromium or its page ends unexpectedly. */
  constructor(onEnd) {
    this.#onEnd = onEnd;
  }

  /** @throws Error if Chromium is missing, or the page cannot be loaded. */
  async open({ folders, page, rasterizer }) {
    this.profile = mkdtempSync(join(tmpdir(), "chromium-"));
    if (this.profile.length + socketName.length > longestSocketPath) {
      throw new Error(`${tmpdir()} is too long a path for Chromium's sockets; set TMPDIR to a shorter one`);
    }
    await this.#launch(rasterizer);
    const { server, address } = await serve(folders, this.#given, (name, bytes) => this.#received.set(name, bytes));
    Object.assign(this, { server, address });
    const { targetInfos } = await this.devTools.send("Target.getTargets");
    const { targetId } = targetInfos.find(({ type }) => type === "page");
    ({ sessionId: this.session } = await this.devTools.send("Target.attachToTarget", { targetId, flatten: true }));
    await this.devTools.send("Page.enable", {}, this.session);
    const loaded = new Promise((resolve) => { this.#onLoad = resolve; });
    await this.devTools.send("Page.navigate", { url: `${address}/page/${page}` }, this.session);
    await loaded;
  }

  async #launch(rasterizer) {
    const asked = process.env.CHROMIUM ? [process.env.CHROMIUM] : programs;
    for (const program of asked) {
      const child = start(program, this.profile, rasterizer);
      const isThere = await new Promise((resolve) => {
        child.once("spawn", () => resolve(true)).once("error", () => resolve(false));
      });
      if (isThere) {
        this.child = child;
        break;
      }
    }
    if (!this.child) throw new Error(`${asked.join(", ")} not found: apt-get install chromium, or name one in CHROMIUM`);
    this.child.stderr.setEncoding("utf8").on("data", (text) => { this.#lastWords = (this.#lastWords + text).slice(-2000); });
    this.child.once("exit", (status, signal) => {
      const words = this.#lastWords.trim().split("\n").at(-1);
      this.#ended(`Chromium ended (${signal ?? `status ${status}`})${words && `; its last words: ${words}`}`);
    });
    this.devTools = new DevTools(this.child, ({ method }) => {
      if (method === "Page.loadEventFired") this.#onLoad();
      if (method === "Inspector.targetCrashed") this.#ended("Chromium's page crashed");
      if (method === "Target.detachedFromTarget") this.#ended("Chromium's page is gone");
    });
  }

  #ended(sentence) {
    if (!this.#isClosing) this.#onEnd(sentence);
  }

  /** Lets the page fetch a file; returns its address. */
  give(name, file) {
    this.#given.set(name, file);
    return `${this.address}/${name}`;
  }

  /**
   * Calls the page's function `name` with one argument, and returns its awaited result.
   * @throws Error with the message that the page threw.
   */
  async call(name, argument) {
    const { result, exceptionDetails } = await this.devTools.send("Runtime.evaluate", {
      expression: `page.${name}(${JSON.stringify(argument)})`, awaitPromise: true, returnByValue: true,
    }, this.session);
    if (exceptionDetails) {
      throw new Error((exceptionDetails.exception?.description ?? exceptionDetails.text).split("\n    at ")[0].replaceAll("\n", " "));
    }
    return result.value;
  }

  /** The 32-bit floats that the page posted under a name. */
  take(name) {
    const bytes = this.#received.get(name);
    this.#received.delete(name);
    return new Float32Array(bytes.buffer, bytes.byteOffset, bytes.byteLength / 4);
  }

  /** Kills Chromium and removes its files. */
  async close() {
    this.#isClosing = true;
    this.server?.close();
    this.server?.closeAllConnections();
    if (this.child && this.child.exitCode === null && this.child.signalCode === null) {
      const ended = new Promise((resolve) => { this.child.once("exit", resolve); });
      this.child.kill("SIGKILL");
      await ended;
    }
    // Chromium's child processes end later than the main one, and may still write.
    for (let i = 0; this.profile && i < 40 && existsSync(this.profile); ++i) {
      try {
        rmSync(this.profile, { recursive: true, force: true });
      } catch {
        // A folder got another file meanwhile: try again.
      }
      await delay(50);
    }
  }
}
