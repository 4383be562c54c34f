// Babylon.js's WebGL engine: draws the world position and Babylon.js's own shadow into a target of 32-bit floats.
import "./samplers.mjs";
import { deviceOf } from "../common/device.mjs";
import { loadObjects } from "../common/glb.mjs";
import { post } from "../common/post.mjs";
import { makeCamera, makeLight, makeMeshes, makeShadows } from "./scene.mjs";

const B = globalThis.BABYLON;
const engine = new B.Engine(document.createElement("canvas"), false, { useHighPrecisionMatrix: true });
engine.getCaps().parallelShaderCompile = undefined; // a frame waits for its shaders
const gl = engine._gl;
let opened;

/** Who draws. */
function hello() {
  return { version: B.Engine.Version, name: deviceOf(gl) };
}

/** Keeps a scene in place of the one before. */
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
    gl.clearBufferfv(gl.COLOR, 0, [NaN, NaN, NaN, NaN]); // of pixels that show nothing; Babylon.js's own clear makes 0 of it
  });
  scene.customRenderTargets.push(target);
  return target;
}

/** Draws, and posts `frame`; returns its name. Each frame has a scene of its own. */
async function draw(task) {
  const { objects, camera: description, light: lamp, image } = opened;
  const scene = new B.Scene(engine);
  try {
    engine.setSize(image.width, image.height); // the projection has the canvas's aspect, whatever the target's
    scene.useRightHandedSystem = true;
    const meshes = makeMeshes(objects, task.engine, scene);
    const camera = makeCamera(description, image.width / image.height, objects, scene);
    const shadows = makeShadows(makeLight(lamp, task, scene), task, meshes);
    const target = makeTarget(meshes, camera, image, scene);
    scene.activeCamera = camera;
    await scene.whenReadyAsync(true);
    for (let i = 0; i < 2; ++i) scene.render(); // the first may draw the target before the map
    const pixels = await target.readPixels();
    shadows.dispose();
    if (gl.isContextLost()) throw new Error("the WebGL context was lost");
    return await post({ frame: new Float32Array(pixels.buffer, pixels.byteOffset, 4 * image.width * image.height) });
  } finally {
    scene.dispose();
  }
}

globalThis.page = { hello, open, draw };
