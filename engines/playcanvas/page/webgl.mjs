// PlayCanvas's WebGL device: draws the world position and PlayCanvas's own shadow into a target of 32-bit floats.
import * as pc from "playcanvas";
import { deviceOf } from "../common/device.mjs";
import { loadObjects } from "../common/glb.mjs";
import { post } from "../common/post.mjs";
import { addCamera, addLight, addMeshes, makeTarget, nothing } from "./scene.mjs";

const unseen = 100; // a layer that the camera does not see; PlayCanvas's own have lower numbers
const apps = new Map();
let opened;
let complaint; // PlayCanvas says on the console, and nowhere else, what it cannot do
console.error = (...words) => { complaint ??= words.join(" ").replace(/\s+/g, " ").slice(0, 300); };

/** An application with clustered lighting or without: what is turned off PlayCanvas does not turn on again. */
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

/** Who draws. */
function hello() {
  return { version: pc.version, name: deviceOf(appWith(true).graphicsDevice.gl) };
}

/** Keeps a scene in place of the one before. */
async function open(description) {
  opened = { ...description, objects: await loadObjects(description) };
}

function nextFrame(app) {
  app.renderNextFrame = true;
  return new Promise((resolve) => { app.once("frameend", resolve); });
}

/** Near and far of a directional light's map, or nothing. */
function planesOfMap(light, camera, type) {
  if (type !== "directional" || !light.castShadows) return {};
  const { nearClip, farClip } = light.light.getRenderData(camera.camera, 0).shadowCamera;
  return { planes: new Float32Array([nearClip, farClip]) };
}

/** What the scene shows, and of directional lights `planes`: world position and shadow, or where it is not `noted` PlayCanvas's own picture. */
async function painted(task, isNoted) {
  const { objects, camera: description, light: lamp, image: { width, height } } = opened;
  complaint = undefined;
  const app = appWith(task.engine.clusteredLightingEnabled);
  const target = makeTarget(app.graphicsDevice, { width, height });
  try {
    addMeshes(app, objects, task.engine, unseen, isNoted);
    const camera = addCamera(app, description, target, objects);
    const light = addLight(app, lamp, task, unseen);
    for (let i = 0; i < 3; ++i) await nextFrame(app); // maps and what is compiled are there for the second
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
 * Draws, and posts `frame`, of directional lights `planes`, and for a mask of pictures `shadowed` and `unshadowed`; returns their
 * names.
 */
async function draw(task) {
  const { pixels: frame, ...others } = await painted(task, true);
  if (task.mask !== "picture") return post({ frame, ...others });
  const off = { ...task, engine: { ...task.engine, castShadows: false } };
  const [shadowed, unshadowed] = [(await painted(task, false)).pixels, (await painted(off, false)).pixels];
  return post({ frame, ...others, shadowed, unshadowed });
}

globalThis.page = { hello, open, draw };
