// Draws world position and three.js's own shadow mask of Gnomon's scenes by WebGL.
import * as THREE from "three";
import { depthFormat, readDepths } from "./depths.mjs";
import { deviceOf } from "../common/device.mjs";
import { loadObjects } from "../common/glb.mjs";
import { post } from "../common/post.mjs";
import { makeCamera, makeLight, makeMeshes, placeShadow } from "./scene.mjs";
import { drawTargets, makeMaterial, makeRenderer, makeTarget, requireSound } from "./targets.mjs";
import { versionOf } from "./version.mjs";

const types = { basic: THREE.BasicShadowMap, pcf: THREE.PCFShadowMap, vsm: THREE.VSMShadowMap };
const sides = { front: THREE.FrontSide, back: THREE.BackSide, double: THREE.DoubleSide };

const shaderErrors = [];
const renderer = makeRenderer(shaderErrors);
const gl = renderer.getContext();
let opened;

/** Version and device. */
function hello() {
  const name = deviceOf(gl);
  const format = depthFormat(gl);
  renderer.resetState();
  return { version: versionOf(THREE.REVISION), name, depthFormat: format, readsDepths: true };
}

/** Replaces the scene. */
async function open(description) {
  const { camera, light, image: { width, height } } = description;
  opened?.scene.traverse((object) => object.geometry?.dispose());
  opened?.target.dispose();
  opened?.light.dispose();
  const material = makeMaterial();
  const objects = await loadObjects(description);
  const meshes = makeMeshes(objects);
  meshes.forEach((object) => { object.material = material; });
  const scene = new THREE.Scene();
  const lamp = makeLight(light);
  scene.add(...meshes, lamp);
  opened = { scene, meshes, target: makeTarget(width, height), material, light: lamp, camera: makeCamera(camera, width / height, objects) };
}

/** three.js's own pictures with its white material, with and without shadows, in 32-bit floats. */
function picturesOf({ scene, meshes, target: { width, height }, material, light, camera }, { castShadow }) {
  const target = makeTarget(width, height, 1);
  const white = new THREE.MeshLambertMaterial({ side: material.side, shadowSide: material.shadowSide });
  meshes.forEach((object) => { object.material = white; });
  const [shadowed, unshadowed] = [castShadow, false].map((casts) => {
    light.castShadow = casts;
    return drawTargets(renderer, { scene, target, camera });
  });
  meshes.forEach((object) => { object.material = material; });
  white.dispose();
  target.dispose();
  return { shadowed, unshadowed };
}

/** Draws and posts `frame`; if `withUnmoved` also `unmoved` (without any bias), if `withMap` also `map`, for a mask from pictures also
 *  `shadowed` and `unshadowed`. Returns their names. */
async function draw({ settings, withUnmoved, withMap, mask }) {
  const { light, material } = opened;
  renderer.shadowMap.type = types[settings.type];
  Object.assign(material, { side: sides[settings.side], shadowSide: sides[settings.casts], needsUpdate: true });
  placeShadow(light, settings);
  Object.assign(light.shadow, { bias: settings.bias, normalBias: settings.normalBias });
  const frames = { frame: drawTargets(renderer, opened) };
  if (withUnmoved) {
    Object.assign(light.shadow, { bias: 0, normalBias: 0 });
    frames.unmoved = drawTargets(renderer, opened);
  }
  if (mask === "picture") Object.assign(frames, picturesOf(opened, settings));
  requireSound(renderer, shaderErrors);
  if (withMap) {
    const isCube = light.isPointLight === true;
    const texture = renderer.properties.get(light.shadow.map.depthTexture).__webglTexture;
    frames.map = readDepths(gl, texture, settings.resolution, isCube);
    renderer.resetState();
  }
  requireSound(renderer, shaderErrors);
  return post(frames);
}

globalThis.page = { hello, open, draw };
