// Draws world position and three.js's own shadow by WebGPU, into a target of 32-bit floats.
import * as THREE from "three/webgpu";
import { float, pointShadow, positionWorld, shadow, vec4 } from "three/tsl";
import { loadObjects } from "../common/glb.mjs";
import { post } from "../common/post.mjs";
import { makeCamera, makeLight, makeMeshes, placeShadow } from "./scene.mjs";
import { versionOf } from "./version.mjs";

const types = { basic: THREE.BasicShadowMap, pcf: THREE.PCFShadowMap, vsm: THREE.VSMShadowMap };
const sides = { front: THREE.FrontSide, back: THREE.BackSide, double: THREE.DoubleSide };
const nothing = 1e30; // background; WebGPU does not accept NaN as clear colour

let opened;

/** A new renderer for each frame, because a renderer keeps shaders of an earlier shadow type. */
async function makeRenderer(type) {
  const renderer = new THREE.WebGPURenderer({ antialias: false });
  await renderer.init();
  if (!renderer.backend.isWebGPUBackend) throw new Error("this Chromium has no WebGPU adapter");
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = types[type];
  renderer.setClearColor(new THREE.Color(nothing, nothing, nothing), nothing);
  return renderer;
}

/** Version and device. */
async function hello() {
  const adapter = await navigator.gpu?.requestAdapter();
  if (!adapter) throw new Error("this Chromium has no WebGPU adapter");
  const { vendor, architecture, description } = adapter.info;
  return { version: versionOf(THREE.REVISION), name: `WebGPU (${[vendor, architecture, description].filter(Boolean).join(", ")})`, readsDepths: false };
}

/** Replaces the scene. */
async function open(scene) {
  opened = { ...scene, objects: await loadObjects(scene) };
}

/** A material that paints world position and three.js's own shadow. */
function seenMaterial(lamp, { castShadow }) {
  const material = new THREE.MeshBasicNodeMaterial();
  const mask = !castShadow ? float(1) : float(lamp.isPointLight ? pointShadow(lamp) : shadow(lamp));
  return Object.assign(material, { lights: true, blending: THREE.NoBlending, fragmentNode: vec4(positionWorld, mask) });
}

/** @param makeMaterial  creates the material of all objects from the light and the settings. */
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

/** Removes the padding of a WebGPU target's rows to 256 bytes, and puts the bottom row first. */
function packed(values, width, height) {
  const stride = values.length / height >= width * 4 ? Math.ceil((width * 16) / 256) * 64 : width * 4;
  const pixels = new Float32Array(4 * width * height);
  for (let y = 0; y < height; ++y) pixels.set(values.subarray(y * stride, y * stride + 4 * width), 4 * (height - 1 - y) * width);
  return pixels.map((value) => (value === Math.fround(nothing) ? NaN : value));
}

const white = () => new THREE.MeshLambertNodeMaterial();

/** Draws and posts `frame`; for a mask from pictures also `shadowed` and `unshadowed`. Returns their names. */
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
