// Draws world positions and three.js's own shadow mask into targets of 32-bit floats.
import * as THREE from "three";

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

// seen: P and the mask; compared: receiver's depth, texel; known: place of the mesh, face, and map's depth if the map can be
// sampled without comparison. The w of both is the direction of the kernel's (1, 0) after the turn of getShadow().
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
  seen = receiveShadow ? vec4(worldOfPixel, getShadowMask()) : vec4(uintBitsToFloat(0x7fc00000u)); // non-receivers are not judged
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

/** A material that paints data instead of shading. The caller sets its sides. */
export function makeMaterial() {
  return new THREE.ShaderMaterial({ vertexShader, fragmentShader, glslVersion: THREE.GLSL3, lights: true,
    uniforms: THREE.UniformsUtils.clone(THREE.UniformsLib.lights) });
}

/** A target with `count` pictures of 32-bit floats; the material above needs three. */
export function makeTarget(width, height, count = 3) {
  return new THREE.WebGLRenderTarget(width, height, {
    count, type: THREE.FloatType, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter,
    depthTexture: new THREE.DepthTexture(width, height, THREE.FloatType),
  });
}

/** A renderer without automatic clears; `shaderErrors` receives compile errors. */
export function makeRenderer(shaderErrors) {
  const renderer = new THREE.WebGLRenderer({ antialias: false, powerPreference: "high-performance" });
  renderer.autoClear = false;
  renderer.shadowMap.enabled = true;
  renderer.debug.onShaderError = (context, program, ...shaders) => {
    shaderErrors.push(shaders.map((shader) => context.getShaderInfoLog(shader)).join(" ").trim() || "it does not link");
  };
  return renderer;
}

/** Draws into the targets, with NaN for background; returns them with the bottom row first. */
export function drawTargets(renderer, { scene, target, camera }) {
  const gl = renderer.getContext();
  const { width, height, textures: { length: count } } = target;
  renderer.setRenderTarget(target);
  for (let i = 0; i < count; ++i) gl.clearBufferfv(gl.COLOR, i, [NaN, NaN, NaN, NaN]);
  renderer.state.buffers.depth.setMask(true);
  gl.clearBufferfv(gl.DEPTH, 0, [1]);
  renderer.render(scene, camera);
  const pixels = new Float32Array(count * 4 * width * height);
  for (let i = 0; i < count; ++i) {
    renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels.subarray(4 * width * height * i, 4 * width * height * (i + 1)), undefined, i);
  }
  return pixels;
}

/** @throws Error if the context was lost or a shader did not compile. */
export function requireSound(renderer, shaderErrors) {
  if (renderer.getContext().isContextLost()) throw new Error("the WebGL context was lost");
  const [error] = shaderErrors.splice(0);
  if (error) throw new Error(`a shader does not compile: ${error}`);
}
