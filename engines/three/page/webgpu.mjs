// three.js's WebGPU renderer: draws the world position and three.js's own shadow into a target of 32-bit floats.
import * as THREE from "three/webgpu";
import { float, pointShadow, positionWorld, shadow, vec4 } from "three/tsl";
import { loadObjects } from "../common/glb.mjs";
import { post } from "../common/post.mjs";
import { makeCamera, makeLight, makeMeshes, placeShadow } from "./scene.mjs";
import { versionOf } from "./version.mjs";

const types = { basic: THREE.BasicShadowMap, pcf: THREE.PCFShadowMap, vsm: THREE.VSMShadowMap };
const sides = { front: THREE.FrontSide, back: THREE.BackSide, double: THREE.DoubleSide };
const nothing = 1e30; // of pixels that show nothing: WebGPU takes no NaN for a clear colour

let opened;

/** A renderer of its own for each frame: what one has compiled for a type of shadows it keeps. */
async function makeRenderer(type) {
  const renderer = new THREE.WebGPURenderer({ antialias: false });
  await renderer.init();
  if (!renderer.backend.isWebGPUBackend) throw new Error("this Chromium has no WebGPU adapter");
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = types[type];
  renderer.setClearColor(new THREE.Color(nothing, nothing, nothing), nothing);
  return renderer;
}

/** Who draws. */
async function hello() {
  const adapter = await navigator.gpu?.requestAdapter();
  if (!adapter) throw new Error("this Chromium has no WebGPU adapter");
  const { vendor, architecture, description } = adapter.info;
  return { version: versionOf(THREE.REVISION), name: `WebGPU (${[vendor, architecture, description].filter(Boolean).join(", ")})`, readsDepths: false };
}

/** Keeps a scene in place of the one before. */
async function open(scene) {
  opened = { ...scene, objects: await loadObjects(scene) };
}

/** A material that paints world position and three.js's own shadow. */
function seenMaterial(lamp, { castShadow }) {
  const material = new THREE.MeshBasicNodeMaterial();
  const mask = !castShadow ? float(1) : float(lamp.isPointLight ? pointShadow(lamp) : shadow(lamp));
  return Object.assign(material, { lights: true, blending: THREE.NoBlending, fragmentNode: vec4(positionWorld, mask) });
}

/** @param makeMaterial  what it returns of the light and the settings all is painted with. */
function makeScene({ objects, light }, settings, makeMaterial) {
  const lamp = makeLight(light);
  placeShadow(lamp, settings);
  Object.assign(lamp.shadow, { bias: settings.bias, normalBias: settings.normalBias });
  const material = Object.assign(makeMaterial(lamp, settings), { side: sides[settings.side], shadowSide: sides[settings.casts] });
  const meshes = makeMeshes(objects);
  meshes.forEach((object) => { object.material = material; });
  const scene = new THREE.Scene();
  scene.add(...meshes, lamp);
  if (lamp.target) scene.add(lamp.target);
  return scene;
}

/** Rows of a WebGPU target come from the top, each to a multiple of 256 bytes; here from below and without gaps. */
function packed(values, width, height) {
  const stride = values.length / height >= width * 4 ? Math.ceil((width * 16) / 256) * 64 : width * 4;
  const pixels = new Float32Array(4 * width * height);
  for (let y = 0; y < height; ++y) pixels.set(values.subarray(y * stride, y * stride + 4 * width), 4 * (height - 1 - y) * width);
  return pixels.map((value) => (value === Math.fround(nothing) ? NaN : value));
}

const white = () => new THREE.MeshLambertNodeMaterial();

/** Draws, and posts `frame`, and for a mask of pictures `shadowed` and `unshadowed`; returns their names. */
async function draw({ settings, mask }) {
  const { width, height } = opened.image;
  const renderer = await makeRenderer(settings.type);
  const target = new THREE.RenderTarget(width, height, { type: THREE.FloatType, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter });
  const painted = async (chosen, makeMaterial) => {
    renderer.setRenderTarget(target);
    await renderer.renderAsync(makeScene(opened, chosen, makeMaterial), makeCamera(opened.camera, width / height, opened.objects));
    return packed(await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height), width, height);
  };
  try {
    const frames = { frame: await painted(settings, seenMaterial) };
    if (mask === "picture") {
      Object.assign(frames, { shadowed: await painted(settings, white), unshadowed: await painted({ ...settings, castShadow: false }, white) });
    }
    return await post(frames);
  } finally {
    target.dispose();
    renderer.dispose();
  }
}

globalThis.page = { hello, open, draw };
