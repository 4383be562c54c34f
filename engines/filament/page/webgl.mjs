// Draws world position and Filament's own shadow by WebGL, into a target of 32-bit floats.
import { deviceOf } from "../common/device.mjs";
import { loadObjects } from "../common/glb.mjs";
import { post } from "../common/post.mjs";
import { divert, lookupsFound } from "./hooks.mjs";
import { makeView } from "./scene.mjs";

const canvas = document.createElement("canvas");
const started = new Promise((resolve) => { Filament.init(["../filament/filament.wasm"], resolve); }).then(() => {
  const engine = Filament.Engine.create(canvas, { antialias: false, preserveDrawingBuffer: true });
  return { engine, gl: canvas.getContext("webgl2"), swapChain: engine.createSwapChain(), renderer: engine.createRenderer(), loader: engine.createAssetLoader() };
});
let opened;

/** The device. Filament's JavaScript does not know its version; the adapter reads it from the package. */
async function hello() {
  const { gl } = await started;
  return { name: deviceOf(gl) };
}

/** Replaces the scene. */
async function open(description) {
  opened = { ...description, objects: await loadObjects(description) };
  Object.assign(canvas, description.image);
}

/** Converts the shaders' output, which is relative position and 2 + shadow, to world position and shadow. */
function seen(pixels, eye) {
  for (let i = 0; i < pixels.length; i += 4) {
    if (pixels[i + 3] < 2) pixels.fill(NaN, i, i + 4);
    else for (let k = 0; k < 4; ++k) pixels[i + k] += k < 3 ? eye[k] : -2;
  }
  return pixels;
}

/** Draws a new scene; returns the shaders' output. */
async function painted(task) {
  const { engine, gl, swapChain, renderer, loader } = await started;
  const { view, release } = await makeView(engine, loader, opened, task);
  const target = divert(gl, opened.image);
  try {
    for (let i = 0; i < 4; ++i) { // late resources are loaded by the third frame
      renderer.render(swapChain, view);
      engine.execute();
      await new Promise((resolve) => { setTimeout(resolve, 20); });
    }
    const looksUp = task.engine.castShadows && opened.objects.some(({ casts }) => casts); // without casters, other shaders are used
    if (looksUp && lookupsFound === 0) throw new Error("Filament's shaders do not contain the known shadow lookup");
    if (gl.isContextLost()) throw new Error("the WebGL context was lost");
    return target.read();
  } finally {
    target.release();
    release();
  }
}

/** Draws and posts `frame`; for a mask from pictures `shadowed` and `unshadowed` instead. Returns their names. */
async function draw(task) {
  if (task.mask !== "picture") return post({ frame: seen(await painted(task), opened.camera.eye) });
  const off = { ...task, engine: { ...task.engine, castShadows: false } };
  return post({ shadowed: await painted(task), unshadowed: await painted(off) });
}

globalThis.page = { hello, open, draw };
