// Translates Gnomon's requests to PlayCanvas.
import { writeSeen } from "../common/frame.mjs";
import { boolean, choice, inCamera, integer, number, only, refuseAllButOwn, refuseOthers } from "../common/settings.mjs";

const title = "PlayCanvas";

/** The keys of the job's [engine] table, with PlayCanvas's own names and defaults. */
export const keys = [
  choice("shadowType", ["PCF1_32F", "PCF3_32F", "PCF5_32F", "PCF1_16F", "PCF3_16F", "PCF5_16F", "VSM_16F", "VSM_32F", "PCSS_32F"], "PCF3_32F",
    "light.shadowType: SHADOW_…; with clustered lighting of spot and point lights scene.lighting.shadowType"),
  number("shadowBias", [0, 1], 0.05, "10 polygon offsets",
    "light.shadowBias: positive is against acne; PCSS_32F has none, nor have point lights without clustered lighting"),
  number("normalOffsetBias", [0, 10], 0, "m", "light.normalOffsetBias: moves the lookup along the normal; positive is against acne"),
  number("vsmBias", [0, 1], 0.0025, "", "light.vsmBias: of VSM, the least variance"),
  integer("vsmBlurSize", [1, 25], 11, "texels", "light.vsmBlurSize: of VSM"),
  choice("vsmBlurMode", ["BOX", "GAUSSIAN"], "GAUSSIAN", "light.vsmBlurMode: of VSM"),
  number("penumbraSize", [0, 100], 1, "", "light.penumbraSize: of PCSS, the light's size"),
  number("penumbraFalloff", [0, 10], 1, "", "light.penumbraFalloff: of PCSS"),
  integer("shadowSamples", [1, 32], 16, "", "light.shadowSamples: of PCSS"),
  integer("shadowBlockerSamples", [1, 32], 16, "", "light.shadowBlockerSamples: of PCSS"),
  number("shadowDistance", [0.1, 100000], 40, "m", "light.shadowDistance: of directional lights; further from the camera all is lit"),
  choice("cull", ["BACK", "FRONT", "NONE"], "BACK", "material.cull: CULLFACE_…; other faces are seen and cast"),
  boolean("clusteredLightingEnabled", true, "scene.clusteredLightingEnabled: spot and point lights share an atlas"),
  boolean("castShadows", true, "light.castShadows: false draws no shadows"),
];

const cullOf = { BACK: "back", FRONT: "front", NONE: "none" };

function checkMap(problems, map, light, engine) {
  only(problems, "shadow_map.layout", map.layout, [light.type === "point" ? "cube" : "single"], "a light has one map, or a point light's six faces");
  only(problems, "shadow_map.reversed", map.reversed, [false], "depths grow from the light here");
  only(problems, "shadow_map.cull", map.cull, [cullOf[engine.cull]], "engine.cull says which faces are seen and cast");
  if (map.roll_deg) problems["shadow_map.roll_deg"] = "PlayCanvas turns the map as it turns the light";
  refuseOthers(problems, "shadow_map", map, [...inCamera, "layout", "reversed", "cull"], title);
}

/** Refuses maps that PlayCanvas would silently replace by others. */
function checkFilter(problems, { shadowType: type, clusteredLightingEnabled: isClustered }, light) {
  if (light.type !== "directional" && isClustered && !type.startsWith("PCF")) {
    problems["engine.shadowType"] = "clustered lighting has PCF alone; engine.clusteredLightingEnabled = false has others";
  } else if (light.type === "point" && !isClustered && !/^PCF[13]|^PCSS/.test(type)) {
    problems["engine.shadowType"] = "PlayCanvas has no such map for point lights";
  }
}

/** The radius of a light's range that includes its whole map up to the far plane. */
function rangeOf({ type, cone_deg: cone }, far) {
  if (type === "directional") return undefined;
  return type === "spot" ? far / Math.cos((cone * Math.PI) / 360) : far * Math.sqrt(3); // a cube's corner
}

/** [shadow_map] of case.toml. PlayCanvas places near and far itself, and reports them for directional lights. */
function mapTable({ light }, { engine, resolution, range }, planes = range ? [range / 1000, range] : undefined) {
  return { resolution, ...(planes && { near: planes[0], far: planes[1] }), cull: cullOf[engine.cull], ...(light.type === "spot" && { fit: "fixed", fov_deg: light.cone_deg }) };
}

/**
 * Translates a draw request.
 * @return `problems` by key; without problems also the page's `task`, the `tables` of case.toml, and `write` for the frame.
 */
export function plan(scene, order) {
  const { shadow_map: map, engine } = order;
  const problems = {};
  refuseAllButOwn(problems, order, keys, title, "engine.shadowBias and engine.normalOffsetBias are PlayCanvas's, and of another kind");
  checkMap(problems, map, scene.light, engine);
  checkFilter(problems, engine, scene.light);
  if (Object.keys(problems).length > 0) return { problems };
  const task = { engine, resolution: map.resolution, range: rangeOf(scene.light, map.far) };
  return { problems, task, write: writeSeen,
    tables: ({ planes }) => ({ shadow_map: mapTable(scene, task, planes), channels: { fractions: true } }) };
}

/** Why a scene cannot be drawn, or undefined. */
export function refusal({ light }) {
  return light.type === "spot" && light.cone_deg >= 179 ? "PlayCanvas's map opens as wide as the cone, and 179 degrees are too wide" : undefined;
}
