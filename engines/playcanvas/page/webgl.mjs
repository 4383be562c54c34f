// Draws world position and PlayCanvas's own shadow by WebGL, into a target of 32-bit floats.
import * as pc from "playcanvas";
import { deviceOf } from "../common/device.mjs";
import { loadObjects } from "../common/glb.mjs";
import { post } from "../common/post.mjs";
import { addCamera, addLight, addMeshes, makeTarget, nothing } from "./scene.mjs";

const unseen = 100; // a layer that the camera does not see; PlayCanvas's own have lower numbers
const apps = new Map();
let opened;
let complaint; // PlayCanvas only reports errors on the console
console.error = (...words) => { complaint ??= words.join(" ").replace(/\s+/g, " ").slice(0, 300); };

/** An application with or without clustered lighting; PlayCanvas cannot turn it on again. */
function appWith(isClustered) {
  if (!apps.has(isClustered)) {
    const app = new pc.Application(document.createElement("canvas"), { graphicsDeviceOptions: { antialias: false } });
    app.autoRender = false;
    app.scene.clusteredLightingEnabled = isClustered;
    app.scene.layers.push(new pc.Layer({ name: "unseen", id: unseen }));
    app.start();
    apps.set(isClustered, app);
  }
  return apps.get(isClustered);
}

/** Version and device. */
function hello() {
  return { version: pc.version, name: deviceOf(appWith(true).graphicsDevice.gl) };
}

/** Replaces the scene. */
async function open(description) {
  opened = { ...description, objects: await loadObjects(description) };
}

function nextFrame(app) {
  app.renderNextFrame = true;
  return new Promise((resolve) => { app.once("frameend", resolve); });
}

/** Near and far of a directional light's map; empty for other lights. */
function planesOfMap(light, camera, type) {
  if (type !== "directional" || !light.castShadows) return {};
  const { nearClip, farClip } = light.light.getRenderData(camera.camera, 0).shadowCamera;
  return { planes: new Float32Array([nearClip, farClip]) };
}

/** Draws world position and shadow, or PlayCanvas's own picture if not `isNoted`; for directional lights also returns `planes`. */
async function painted(task, isNoted) {
  const { objects, camera: description, light: lamp, image: { width, height } } = opened;
  complaint = undefined;
  const app = appWith(task.engine.clusteredLightingEnabled);
  const target = makeTarget(app.graphicsDevice, { width, height });
  try {
    addMeshes(app, objects, task.engine, unseen, isNoted);
    const camera = addCamera(app, description, target, objects);
    const light = addLight(app, lamp, task, unseen);
    for (let i = 0; i < 3; ++i) await nextFrame(app); // maps and shaders are ready for the second frame
    const pixels = await target.colorBuffer.read(0, 0, width, height, { renderTarget: target });
    if (complaint) throw new Error(complaint);
    if (app.graphicsDevice.contextLost) throw new Error("the WebGL context was lost");
    for (let i = 0; i < pixels.length; i += 4) if (pixels[i] === nothing) pixels.fill(NaN, i, i + 4);
    return { pixels, ...planesOfMap(light, camera, lamp.type) };
  } finally {
    [...app.root.children].forEach((entity) => entity.destroy());
    target.destroyTextureBuffers();
    target.destroy();
  }
}

/**
 * Draws and posts `frame`; for directional lights also `planes`, for a mask from pictures also `shadowed` and `unshadowed`. Returns
 * their names.
 */
async function draw(task) {
  const { pixels: frame, ...others } = await painted(task, true);
  if (task.mask !== "picture") return post({ frame, ...others });
  const off = { ...task, engine: { ...task.engine, castShadows: false } };
  const [shadowed, unshadowed] = [(await painted(task, false)).pixels, (await painted(off, false)).pixels];
  return post({ frame, ...others, shadowed, unshadowed });
}

globalThis.page = { hello, open, draw };
