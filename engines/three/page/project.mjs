// A project's own scene, drawn by three.js's WebGL renderer. Its module exports `makeProject()`: scene, camera, the light whose
// shadow is judged, and `shadowMapType`. Of each mesh all stays as it is but what its material shades.
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

/** The project, anew, with its matrices up to date and no shadows but those of its light. */
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

/** The meshes that are seen or cast; refuses what is not where its vertices say. */
function meshesOf(scene) {
  const meshes = [];
  scene.traverseVisible((object) => {
    const is = ["isSkinnedMesh", "isInstancedMesh", "isBatchedMesh", "isLine", "isPoints", "isSprite"].find((name) => object[name]);
    const isMorphed = object.isMesh && Object.keys(object.geometry.morphAttributes).length > 0;
    if (is || isMorphed) throw new Error(`"${object.name || object.type}" is ${isMorphed ? "morphed" : `a ${is.slice(2)}`}: plain meshes alone are driven`);
    if (object.isMesh) meshes.push(object);
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

/** Who draws, and what the project sets itself. */
async function hello() {
  const name = deviceOf(renderer.getContext());
  const { light, shadowMapType } = await load();
  const { bias, normalBias, radius, blurSamples, camera } = light.shadow;
  const type = Object.keys(types).find((word) => types[word] === shadowMapType);
  return { version: versionOf(THREE.REVISION), name,
    project: { settings: { type, bias, normalBias, radius, blurSamples, castShadow: light.castShadow },
      light: lightOf(light), map: { near: camera.near, far: (!light.isDirectionalLight && light.distance) || camera.far } } };
}

/** The material that tells where this one shades. */
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

/** Makes the project's scene anew, seen from the job's camera. */
async function open({ camera, image: { width, height } }) {
  opened?.target.dispose();
  const { scene, light, camera: own } = await load();
  meshesOf(scene).forEach((mesh) => {
    mesh.material = Array.isArray(mesh.material) ? mesh.material.map(tellingMaterial) : tellingMaterial(mesh.material);
  });
  Object.assign(scene, { background: null, environment: null, fog: null, overrideMaterial: null });
  opened = { scene, light, target: makeTarget(width, height), camera: placeCamera(own, camera, width / height) };
}

/** Draws, and posts `frame`; returns its name. */
async function draw({ settings: { type, castShadow, resolution, ...shadow } }) {
  const { light, scene } = opened;
  renderer.shadowMap.type = types[type];
  light.castShadow = castShadow;
  light.shadow.map?.dispose();
  light.shadow.mapPass?.dispose();
  Object.assign(light.shadow, { map: null, mapPass: null, ...shadow });
  light.shadow.mapSize.set(resolution, resolution);
  meshesOf(scene).forEach(({ material }) => [material].flat().forEach((one) => { one.needsUpdate = true; }));
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

/** Posts each mesh's `positions` and `indices`, in world space; returns what a job says of the project, and the meshes' names. */
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
