// Filament's WebGL backend: draws the world position and Filament's own shadow into a target of 32-bit floats.
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

/** Who draws. Filament's JavaScript does not know its version: the adapter knows what is installed. */
async function hello() {
  const { gl } = await started;
  return { name: deviceOf(gl) };
}

/** Keeps a scene in place of the one before. */
async function open(description) {
  opened = { ...description, objects: await loadObjects(description) };
  Object.assign(canvas, description.image);
}

/** World position and shadow, for what the shaders paint: position from the camera and 2 + shadow, or nothing. */
function seen(pixels, eye) {
  for (let i = 0; i < pixels.length; i += 4) {
    if (pixels[i + 3] < 2) pixels.fill(NaN, i, i + 4);
    else for (let k = 0; k < 4; ++k) pixels[i + k] += k < 3 ? eye[k] : -2;
  }
  return pixels;
}

/** What the shaders paint into 32-bit floats. Each frame has a scene of its own. */
async function painted(task) {
  const { engine, gl, swapChain, renderer, loader } = await started;
  const { view, release } = await makeView(engine, loader, opened, task);
  const target = divert(gl, opened.image);
  try {
    for (let i = 0; i < 4; ++i) { // what is loaded late is there for the third
      renderer.render(swapChain, view);
      engine.execute();
      await new Promise((resolve) => { setTimeout(resolve, 20); });
    }
    const looksUp = task.engine.castShadows && opened.objects.some(({ casts }) => casts); // where nothing casts the shaders are others
    if (looksUp && lookupsFound === 0) throw new Error("Filament's shaders look shadows up otherwise than is known here");
    if (gl.isContextLost()) throw new Error("the WebGL context was lost");
    return target.read();
  } finally {
    target.release();
    release();
  }
}

/** Draws, and posts `frame`, or for a mask of pictures `shadowed` and `unshadowed`, which show no positions; returns their names. */
async function draw(task) {
  if (task.mask !== "picture") return post({ frame: seen(await painted(task), opened.camera.eye) });
  const off = { ...task, engine: { ...task.engine, castShadows: false } };
  return post({ shadowed: await painted(task), unshadowed: await painted(off) });
}

globalThis.page = { hello, open, draw };
