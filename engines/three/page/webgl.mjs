// three.js's WebGL renderer: draws the world position and three.js's own shadow mask into targets of 32-bit floats.
import * as THREE from "three";
import { depthFormat, readDepths } from "./depths.mjs";
import { deviceOf } from "../common/device.mjs";
import { loadObjects } from "../common/glb.mjs";
import { post } from "../common/post.mjs";
import { makeCamera, makeLight, makeMeshes, placeShadow } from "./scene.mjs";
import { versionOf } from "./version.mjs";

const types = { basic: THREE.BasicShadowMap, pcf: THREE.PCFShadowMap, vsm: THREE.VSMShadowMap };
const sides = { front: THREE.FrontSide, back: THREE.BackSide, double: THREE.DoubleSide };

const vertexShader = `
#include <common>
#include <shadowmap_pars_vertex>
in float place;
out vec3 worldOfPixel;
flat out float placeOfPixel;
void main() {
  #include <beginnormal_vertex>
  #include <defaultnormal_vertex>
  #include <begin_vertex>
  #include <project_vertex>
  #include <worldpos_vertex>
  #include <shadowmap_vertex>
  worldOfPixel = (modelMatrix * vec4(position, 1.0)).xyz;
  placeOfPixel = place;
}`;

// seen: P and the mask; compared: receiver's depth, texel; known: place of the mesh, face, map's depth where the map can be
// sampled without comparing. The last of both is where a kernel's (1, 0) lies, as getShadow() of three.js turns it.
const fragmentShader = `
#include <common>
#include <packing>
#include <lights_pars_begin>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
in vec3 worldOfPixel;
flat in float placeOfPixel;
layout(location = 0) out vec4 seen;
layout(location = 1) out vec4 compared;
layout(location = 2) out vec4 known;

#if NUM_POINT_LIGHT_SHADOWS > 0
vec4 placeInCube(vec3 way) { // the face, and the texel on it from 0 to 1: OpenGL 4.6, table 8.19
  vec3 size = abs(way);
  if (size.x >= size.y && size.x >= size.z)
    return way.x > 0.0 ? vec4(0.0, vec2(-way.z, -way.y) / size.x * 0.5 + 0.5, size.x) : vec4(1.0, vec2(way.z, -way.y) / size.x * 0.5 + 0.5, size.x);
  if (size.y >= size.z)
    return way.y > 0.0 ? vec4(2.0, vec2(way.x, way.z) / size.y * 0.5 + 0.5, size.y) : vec4(3.0, vec2(way.x, -way.z) / size.y * 0.5 + 0.5, size.y);
  return way.z > 0.0 ? vec4(4.0, vec2(way.x, -way.y) / size.z * 0.5 + 0.5, size.z) : vec4(5.0, vec2(-way.x, -way.y) / size.z * 0.5 + 0.5, size.z);
}
#endif

void main() {
  seen = vec4(worldOfPixel, getShadowMask());
  known = vec4(placeOfPixel, 0.0, 0.0, 0.0);
  compared = vec4(0.0);
#if NUM_SPOT_LIGHT_SHADOWS > 0
  vec3 coord = vSpotLightCoord[0].xyz / vSpotLightCoord[0].w;
  compared = vec4(coord.z, coord.xy * spotLightShadows[0].shadowMapSize, 0.0);
  float kernelRadius = spotLightShadows[0].shadowRadius;
#elif NUM_DIR_LIGHT_SHADOWS > 0
  vec3 coord = vDirectionalShadowCoord[0].xyz / vDirectionalShadowCoord[0].w;
  compared = vec4(coord.z, coord.xy * directionalLightShadows[0].shadowMapSize, 0.0);
  float kernelRadius = directionalLightShadows[0].shadowRadius;
#elif NUM_POINT_LIGHT_SHADOWS > 0
  PointLightShadow s = pointLightShadows[0];
  vec4 at = placeInCube(vPointShadowCoord[0].xyz);
  float range = s.shadowCameraFar - s.shadowCameraNear;
  compared = vec4(s.shadowCameraFar * (at.w - s.shadowCameraNear) / (at.w * range), at.yz * s.shadowMapSize, 0.0);
  known.y = at.x;
#endif
#if defined(SHADOWMAP_TYPE_PCF) && NUM_SPOT_LIGHT_SHADOWS + NUM_DIR_LIGHT_SHADOWS > 0
  float turn = interleavedGradientNoise(gl_FragCoord.xy) * PI2;
  compared.w = kernelRadius * cos(turn);
  known.w = kernelRadius * sin(turn);
#endif
#if defined(SHADOWMAP_TYPE_BASIC) && NUM_SPOT_LIGHT_SHADOWS > 0
  known.z = texture(spotShadowMap[0], coord.xy).r;
#elif defined(SHADOWMAP_TYPE_BASIC) && NUM_DIR_LIGHT_SHADOWS > 0
  known.z = texture(directionalShadowMap[0], coord.xy).r;
#elif defined(SHADOWMAP_TYPE_BASIC) && NUM_POINT_LIGHT_SHADOWS > 0
  known.z = texture(pointShadowMap[0], normalize(vPointShadowCoord[0].xyz)).r;
#endif
}`;

const renderer = new THREE.WebGLRenderer({ antialias: false, powerPreference: "high-performance" });
const gl = renderer.getContext();
renderer.autoClear = false;
renderer.shadowMap.enabled = true;
renderer.debug.onShaderError = (context, program, vertexPart, fragmentPart) => {
  shaderError = [vertexPart, fragmentPart].map((shader) => context.getShaderInfoLog(shader)).join(" ").trim() || "it does not link";
};
const lost = "the WebGL context was lost";
let shaderError;
let opened;

/** Who draws. */
function hello() {
  const name = deviceOf(gl);
  const format = depthFormat(gl);
  renderer.resetState();
  return { version: versionOf(THREE.REVISION), name, depthFormat: format, readsDepths: true };
}

/** Loads a scene in place of the one before. */
async function open(description) {
  const { camera, light, image: { width, height } } = description;
  opened?.scene.traverse((object) => object.geometry?.dispose());
  opened?.target.dispose();
  opened?.light.dispose();
  const target = new THREE.WebGLRenderTarget(width, height, {
    count: 3, type: THREE.FloatType, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter,
    depthTexture: new THREE.DepthTexture(width, height, THREE.FloatType),
  });
  const material = new THREE.ShaderMaterial({ vertexShader, fragmentShader, glslVersion: THREE.GLSL3, lights: true,
    uniforms: THREE.UniformsUtils.clone(THREE.UniformsLib.lights) });
  const objects = await loadObjects(description);
  const meshes = makeMeshes(objects);
  meshes.forEach((object) => { object.material = material; });
  const scene = new THREE.Scene();
  const lamp = makeLight(light);
  scene.add(...meshes, lamp);
  opened = { scene, meshes, target, material, light: lamp, camera: makeCamera(camera, width / height, objects), width, height };
}

function renderTargets({ scene, target, camera }) {
  renderer.setRenderTarget(target);
  for (let i = 0; i < target.textures.length; ++i) gl.clearBufferfv(gl.COLOR, i, [NaN, NaN, NaN, NaN]);
  renderer.state.buffers.depth.setMask(true);
  gl.clearBufferfv(gl.DEPTH, 0, [1]);
  renderer.render(scene, camera);
}

function pixelsOf({ target, width, height }) {
  const pixels = new Float32Array(3 * 4 * width * height);
  for (let i = 0; i < 3; ++i) {
    renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels.subarray(4 * width * height * i, 4 * width * height * (i + 1)), undefined, i);
  }
  return pixels;
}

/** three.js's own picture of its white material, with shadows and without: a target of 32-bit floats each. */
function picturesOf({ scene, meshes, material, light, camera, width, height }, { castShadow }) {
  const target = new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter });
  const white = new THREE.MeshLambertMaterial({ side: material.side, shadowSide: material.shadowSide });
  meshes.forEach((object) => { object.material = white; });
  const [shadowed, unshadowed] = [castShadow, false].map((casts) => {
    light.castShadow = casts;
    renderTargets({ scene, target, camera });
    const pixels = new Float32Array(4 * width * height);
    renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
    return pixels;
  });
  meshes.forEach((object) => { object.material = material; });
  white.dispose();
  target.dispose();
  return { shadowed, unshadowed };
}

/** Draws, and posts `frame`, with `withUnmoved` also `unmoved` (without any bias), with `withMap` also `map`, for a mask of pictures
 *  `shadowed` and `unshadowed`; returns their names. */
async function draw({ settings, withUnmoved, withMap, mask }) {
  const { light, material } = opened;
  shaderError = undefined;
  renderer.shadowMap.type = types[settings.type];
  Object.assign(material, { side: sides[settings.side], shadowSide: sides[settings.casts], needsUpdate: true });
  placeShadow(light, settings);
  Object.assign(light.shadow, { bias: settings.bias, normalBias: settings.normalBias });
  renderTargets(opened);
  const frames = { frame: pixelsOf(opened) };
  if (withUnmoved) {
    Object.assign(light.shadow, { bias: 0, normalBias: 0 });
    renderTargets(opened);
    frames.unmoved = pixelsOf(opened);
  }
  if (mask === "picture") Object.assign(frames, picturesOf(opened, settings));
  if (gl.isContextLost()) throw new Error(lost);
  if (shaderError) throw new Error(`a shader does not compile: ${shaderError}`);
  if (withMap) {
    const isCube = light.isPointLight === true;
    const texture = renderer.properties.get(light.shadow.map.depthTexture).__webglTexture;
    frames.map = readDepths(gl, texture, settings.resolution, isCube);
    renderer.resetState();
  }
  if (gl.isContextLost()) throw new Error(lost);
  return post(frames);
}

globalThis.page = { hello, open, draw };
