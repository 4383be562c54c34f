// Translates Gnomon's requests to Babylon.js.
import { writeSeen } from "../common/frame.mjs";
import { boolean, choice, inCamera, integer, number, only, refuseAllButOwn, refuseOthers } from "../common/settings.mjs";

const title = "Babylon.js";
const blurs = ["BLUREXPONENTIALSHADOWMAP", "BLURCLOSEEXPONENTIALSHADOWMAP"];

/** The keys of the job's [engine] table, with Babylon.js's own names and defaults. */
export const keys = [
  choice("filter", ["NONE", "POISSONSAMPLING", "EXPONENTIALSHADOWMAP", "BLUREXPONENTIALSHADOWMAP", "CLOSEEXPONENTIALSHADOWMAP",
    "BLURCLOSEEXPONENTIALSHADOWMAP", "PCF", "PCSS"], "NONE", "shadowGenerator.filter: ShadowGenerator.FILTER_…"),
  choice("filteringQuality", ["HIGH", "MEDIUM", "LOW"], "HIGH",
    "shadowGenerator.filteringQuality: of PCF 5 × 5, 3 × 3 or 1 taps, of PCSS 64, 32 or 16 samples"),
  number("bias", [-1, 1], 5e-5, "depth", "shadowGenerator.bias: added to the caster's depth, so that against acne it is positive"),
  number("normalBias", [-1000, 1000], 0, "m",
    "shadowGenerator.normalBias: moves casters against their normals, by it times the sine of the light's angle; positive is against acne"),
  number("depthScale", [0, 1000], 50, "", "shadowGenerator.depthScale: the exponent of the exponential maps"),
  number("contactHardeningLightSizeUVRatio", [0, 1], 0.1, "map sides", "shadowGenerator.contactHardeningLightSizeUVRatio: of PCSS, the light's size"),
  number("frustumEdgeFalloff", [0, 1], 0, "", "shadowGenerator.frustumEdgeFalloff: fades shadows towards the map's border"),
  number("blurScale", [1, 16], 2, "", "shadowGenerator.blurScale: how much coarser the blurred map is"),
  integer("blurBoxOffset", [0, 16], 1, "texels", "shadowGenerator.blurBoxOffset: how far the box blur reaches"),
  boolean("useKernelBlur", false, "shadowGenerator.useKernelBlur: a Gaussian blur in place of the box"),
  integer("blurKernel", [1, 128], 1, "texels", "shadowGenerator.blurKernel: of the Gaussian blur"),
  boolean("useFloat32TextureType", false, "shadowGenerator.useFloat32TextureType: 32-bit floats in the map in place of halves"),
  boolean("forceBackFacesOnly", false, "shadowGenerator.forceBackFacesOnly: back faces cast"),
  boolean("backFaceCulling", true, "material.backFaceCulling: front faces are seen and cast; without it both sides"),
  boolean("shadowEnabled", true, "light.shadowEnabled: false draws no shadows"),
];

/** The culled faces of the map, in Gnomon's terms. */
function cullOf({ forceBackFacesOnly, backFaceCulling }) {
  if (forceBackFacesOnly) return "front";
  return backFaceCulling ? "back" : "none";
}

function checkMap(problems, map, light, engine) {
  only(problems, "shadow_map.layout", map.layout, [light.type === "point" ? "cube" : "single"], "a light has one map, or a point light's cube");
  only(problems, "shadow_map.reversed", map.reversed, [false], "depths grow from the light here");
  only(problems, "shadow_map.cull", map.cull, [cullOf(engine)], "engine.forceBackFacesOnly and engine.backFaceCulling say which faces cast");
  refuseOthers(problems, "shadow_map", map, [...inCamera, "layout", "reversed", "cull"], title);
}

/** Babylon.js replaces some filters for the distance cubes of point lights. */
function checkFilter(problems, { filter }, light) {
  const replaced = [...blurs, "PCF", "PCSS"];
  if (light.type === "point" && replaced.includes(filter)) problems["engine.filter"] = "Babylon.js has neither blurred maps nor PCF or PCSS for point lights";
}

/**
 * Translates a draw request.
 * @return `problems` by key; without problems also the page's `task`, the `tables` of case.toml, and `write` for the frame.
 */
export function plan({ light }, order) {
  const { shadow_map: map, engine } = order;
  const problems = {};
  refuseAllButOwn(problems, order, keys, title, "engine.bias and engine.normalBias are Babylon.js's, and of another kind");
  checkMap(problems, map, light, engine);
  checkFilter(problems, engine, light);
  if (Object.keys(problems).length > 0) return { problems };
  const { resolution, near, far, light_camera: camera } = map;
  const tables = { shadow_map: { resolution, near, far, cull: cullOf(engine) }, channels: { fractions: true } };
  return { problems, task: { engine, resolution, near, far, camera: light.type === "point" ? undefined : camera }, tables, write: writeSeen };
}
