// Draws a project's own scene with three.js's WebGL renderer. The project's module exports `makeProject()`, which returns scene,
// camera, the light to judge, and `shadowMapType`. Only the shading of materials is replaced.
import * as THREE from "three";
import { deviceOf } from "../common/device.mjs";
import { post } from "../common/post.mjs";
import { drawTargets, makeMaterial, makeRenderer, makeTarget, requireSound } from "./targets.mjs";
import { versionOf } from "./version.mjs";

const types = { basic: THREE.BasicShadowMap, pcf: THREE.PCFShadowMap, vsm: THREE.VSMShadowMap };
const lightTypes = { DirectionalLight: "directional", SpotLight: "spot", PointLight: "point" };

const shaderErrors = [];
const renderer = makeRenderer(shaderErrors);
let opened;

/** Loads the project, updates its matrices, and turns off the shadows of other lights. */
async function load() {
  const file = new URLSearchParams(globalThis.location.search).get("module");
  const { makeProject } = await import(`../project/${file}`);
  if (!makeProject) throw new Error(`${file} exports no makeProject()`);
  const project = await makeProject();
  const { scene, camera, light, shadowMapType } = project;
  if (!lightTypes[light?.type]) throw new Error(`${file}: makeProject().light is none of ${Object.keys(lightTypes).join(", ")}`);
  if (!Object.values(types).includes(shadowMapType)) throw new Error(`${file}: makeProject().shadowMapType is none of THREE.BasicShadowMap, PCFShadowMap, VSMShadowMap`);
  scene.updateMatrixWorld(true);
  [camera, light, light.target].forEach((object) => object?.updateWorldMatrix(true, false));
  scene.traverse((object) => { if (object.isLight && object !== light) object.castShadow = false; });
  return project;
}

const kinds = { isSkinnedMesh: "skinned", isInstancedMesh: "instanced", isBatchedMesh: "batched" };

/** Why a mesh is not drawn as its plain triangles; undefined if it is. */
function problemOf(mesh) {
  const kind = Object.keys(kinds).find((name) => mesh[name]);
  if (kind) return kinds[kind];
  if (Object.keys(mesh.geometry.morphAttributes).length > 0) return "morphed";
  const has = (test) => [mesh.material].flat().some(test);
  if (has(({ alphaTest, alphaMap, alphaHash }) => alphaTest > 0 || alphaMap || alphaHash)) return "cut out by its material's alpha";
  if (has(({ displacementMap, clippingPlanes }) => displacementMap || clippingPlanes?.length)) return "displaced or clipped by its material";
  if ((mesh.castShadow || mesh.receiveShadow) && has(({ isShaderMaterial }) => isShaderMaterial)) return "placed by a vertex shader of its own";
  return undefined;
}

/** The visible meshes. Hides lines, points and sprites, which have no triangles. */
function meshesOf(scene) {
  const meshes = [];
  scene.traverseVisible((object) => {
    if (object.isLine || object.isPoints || object.isSprite) object.layers.disableAll();
    if (!object.isMesh) return;
    const problem = problemOf(object);
    if (problem) throw new Error(`"${object.name || object.type}" is ${problem}: the truth only supports the triangles of plain meshes`);
    meshes.push(object);
  });
  return meshes;
}

function lightOf(light) {
  const place = (object) => object.getWorldPosition(new THREE.Vector3()).toArray();
  const type = lightTypes[light.type];
  if (type === "directional") return { type, direction: place(light.target).map((value, k) => value - place(light)[k]) };
  if (type === "point") return { type, position: place(light) };
  return { type, position: place(light), target: place(light.target), cone_deg: (light.angle * 360) / Math.PI };
}

/** Version, device, and the project's own settings. */
async function hello() {
  const name = deviceOf(renderer.getContext());
  const { light, shadowMapType } = await load();
  const { bias, normalBias, radius, blurSamples, camera } = light.shadow;
  const type = Object.keys(types).find((word) => types[word] === shadowMapType);
  return { version: versionOf(THREE.REVISION), name,
    project: { settings: { type, bias, normalBias, radius, blurSamples, castShadow: light.castShadow },
      light: lightOf(light), map: { near: camera.near, far: (!light.isDirectionalLight && light.distance) || camera.far } } };
}

/** The material that paints position and shadow on the sides where this one shades. */
function tellingMaterial({ side, shadowSide, visible }) {
  return Object.assign(makeMaterial(), { side, shadowSide, visible });
}

function placeCamera(camera, { eye, target, up, vertical_fov_deg: fov, orthographic_height: height }, aspect) {
  const { near, far } = camera;
  const placed = height === undefined ? new THREE.PerspectiveCamera(fov, aspect, near, far)
    : new THREE.OrthographicCamera((-height * aspect) / 2, (height * aspect) / 2, height / 2, -height / 2, near, far);
  placed.layers.mask = camera.layers.mask;
  placed.up.set(...up);
  placed.position.set(...eye);
  placed.lookAt(...target);
  return placed;
}

/** Loads the project's scene, seen from the job's camera. */
async function open({ camera, image: { width, height } }) {
  opened?.target.dispose();
  const { scene, light, camera: own } = await load();
  const meshes = meshesOf(scene);
  meshes.forEach((mesh) => {
    mesh.material = Array.isArray(mesh.material) ? mesh.material.map(tellingMaterial) : tellingMaterial(mesh.material);
  });
  Object.assign(scene, { background: null, environment: null, fog: null, overrideMaterial: null });
  opened = { scene, light, materials: meshes.flatMap(({ material }) => material), target: makeTarget(width, height), camera: placeCamera(own, camera, width / height) };
}

/** Draws and posts `frame`; returns its name. */
async function draw({ settings: { type, castShadow, resolution, ...shadow } }) {
  const { light, materials } = opened;
  renderer.shadowMap.type = types[type];
  light.castShadow = castShadow;
  light.shadow.map?.dispose();
  light.shadow.mapPass?.dispose();
  Object.assign(light.shadow, { map: null, mapPass: null, ...shadow });
  light.shadow.mapSize.set(resolution, resolution);
  materials.forEach((material) => { material.needsUpdate = true; });
  const frame = drawTargets(renderer, opened);
  requireSound(renderer, shaderErrors);
  return post({ frame: frame.subarray(0, frame.length / 3) });
}

function cameraOf(camera) {
  const eye = camera.getWorldPosition(new THREE.Vector3());
  const target = camera.getWorldDirection(new THREE.Vector3()).add(eye);
  const up = new THREE.Vector3(0, 1, 0).applyQuaternion(camera.getWorldQuaternion(new THREE.Quaternion()));
  const lens = camera.isPerspectiveCamera ? { vertical_fov_deg: camera.getEffectiveFOV() } : { orthographic_height: (camera.top - camera.bottom) / camera.zoom };
  return { eye: eye.toArray(), target: target.toArray(), up: up.toArray(), ...lens };
}

/** Posts the meshes' `positions` and `indices` in world space; returns their names, and the project's settings for a job. */
async function describe() {
  const { scene, camera, light } = await load();
  const meshes = meshesOf(scene).map((mesh, number) => {
    const at = new THREE.Vector3();
    const { position, index } = { ...mesh.geometry.attributes, index: mesh.geometry.index };
    const corners = Array.from({ length: position.count }, (_, i) => at.fromBufferAttribute(position, i).applyMatrix4(mesh.matrixWorld).toArray());
    return { name: `${mesh.name || mesh.type}_${number}`, casts: mesh.castShadow, positions: corners.flat(),
      indices: index ? [...index.array] : corners.map((_, i) => i) };
  });
  const names = await post(Object.fromEntries(meshes.flatMap(({ positions, indices }, i) => [[`positions${i}`, new Float32Array(positions)],
    [`indices${i}`, new Float32Array(new Uint32Array(indices).buffer)]])));
  return { names, meshes: meshes.map(({ name, casts }) => ({ name, casts })), camera: cameraOf(camera), light: lightOf(light), aspect: camera.aspect ?? (camera.right - camera.left) / (camera.top - camera.bottom),
    resolution: light.shadow.mapSize.x };
}

globalThis.page = { hello, open, draw, describe };
