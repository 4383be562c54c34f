// Draws world position and Babylon.js's own shadow by WebGL, into a target of 32-bit floats.
import "./samplers.mjs";
import { deviceOf } from "../common/device.mjs";
import { loadObjects } from "../common/glb.mjs";
import { post } from "../common/post.mjs";
import { makeCamera, makeLight, makeMaterial, makeMeshes, makeShadows } from "./scene.mjs";

const B = globalThis.BABYLON;
const engine = new B.Engine(document.createElement("canvas"), false, { useHighPrecisionMatrix: true });
engine.getCaps().parallelShaderCompile = undefined; // a frame waits for its shaders
const gl = engine._gl;
let opened;

/** Version and device. */
function hello() {
  return { version: B.Engine.Version, name: deviceOf(gl) };
}

/** Replaces the scene. */
async function open(description) {
  opened = { ...description, objects: await loadObjects(description) };
}

function makeTarget(meshes, camera, { width, height }, scene) {
  const target = new B.RenderTargetTexture("seen", { width, height }, scene, {
    type: B.Engine.TEXTURETYPE_FLOAT, generateMipMaps: false, samplingMode: B.Texture.NEAREST_SAMPLINGMODE });
  target.renderList = meshes.filter(({ metadata }) => metadata.isSeen);
  target.activeCamera = camera;
  target.onClearObservable.add(() => {
    engine.clear(null, false, true, false);
    gl.clearBufferfv(gl.COLOR, 0, [NaN, NaN, NaN, NaN]); // background; Babylon.js's own clear turns NaN into 0
  });
  scene.customRenderTargets.push(target);
  return target;
}

/** Draws a new scene: world position and shadow, or Babylon.js's own picture if not `isNoted`. */
async function painted(task, isNoted) {
  const { objects, camera: description, light: lamp, image } = opened;
  const scene = new B.Scene(engine);
  try {
    engine.setSize(image.width, image.height); // the projection takes the canvas's aspect, not the target's
    scene.useRightHandedSystem = true;
    const meshes = makeMeshes(objects, makeMaterial(task.engine, scene, isNoted), scene);
    const camera = makeCamera(description, image.width / image.height, objects, scene);
    const shadows = makeShadows(makeLight(lamp, task, scene), task, meshes);
    const target = makeTarget(meshes, camera, image, scene);
    scene.activeCamera = camera;
    await scene.whenReadyAsync(true);
    for (let i = 0; i < 2; ++i) scene.render(); // the first may draw the target before the map
    const pixels = await target.readPixels();
    shadows.dispose();
    if (gl.isContextLost()) throw new Error("the WebGL context was lost");
    return new Float32Array(pixels.buffer, pixels.byteOffset, 4 * image.width * image.height);
  } finally {
    scene.dispose();
  }
}

/** Draws and posts `frame`; for a mask from pictures also `shadowed` and `unshadowed`. Returns their names. */
async function draw(task) {
  const frames = { frame: await painted(task, true) };
  if (task.mask === "picture") {
    const off = { ...task, engine: { ...task.engine, shadowEnabled: false } };
    Object.assign(frames, { shadowed: await painted(task, false), unshadowed: await painted(off, false) });
  }
  return post(frames);
}

globalThis.page = { hello, open, draw };
