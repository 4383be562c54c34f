// Translates Gnomon's requests to three.js, and three.js's settings to Gnomon's terms.

import { boolean, choice, inCamera, integer, number, only, refuse, refuseOthers } from "../common/settings.mjs";
import { writeSeen } from "../common/frame.mjs";
import { writeFrame } from "./frame.mjs";

const title = "three.js";

/** The keys of the job's [engine] table, with three.js's own names and defaults. */
export const keys = [
  choice("type", ["basic", "pcf", "vsm"], "pcf",
    "renderer.shadowMap.type: one texel, five turned samples of 2 × 2 texels, or blurred moments"),
  choice("side", ["front", "back", "double"], "front",
    "the material's side: what is seen; front lets back faces cast, back the front, double both, with vsm what is seen"),
  number("bias", [-1, 1], 0, "depth", "shadow.bias: added to the receiver's depth, so that against acne it is negative"),
  number("normalBias", [-1000, 1000], 0, "m", "shadow.normalBias: moves the lookup along the vertex's normal"),
  number("radius", [0, 64], 1, "texels", "shadow.radius: how far pcf's samples lie, and vsm's blur reaches"),
  integer("blurSamples", [1, 64], 8, "", "shadow.blurSamples: of vsm's blur"),
  boolean("castShadow", true, "light.castShadow: false draws no shadows"),
];

// The sides that cast, by `cull`.
const sideThatCasts = { none: "double", front: "back", back: "front" };
const cullOf = { front: "front", back: "back", double: "none" };

const leastKernelRadius = 0.25; // lower limit of method.radius_texels

/** The lookup as tables of case.toml; undefined if Gnomon has no equivalent. */
function lookupOf({ type, radius }, light) {
  if (type === "basic") return { lookup: { filter: "nearest" } };
  if (type !== "pcf") return undefined;
  if (radius === 0) return { lookup: { filter: "hardware" } };
  // A point light's samples lie perpendicular to its direction, not on a face of the cube.
  if (light.type === "point" || radius < leastKernelRadius) return undefined;
  return { method: { name: "pcf", pattern: "vogel_areas", taps: 5, radius_texels: radius, tap: "bilinear", turned: true } };
}

function checkMap(problems, map, light, engine, device) {
  only(problems, "shadow_map.layout", map.layout, [light.type === "point" ? "cube" : "single"], "a light has one map, or a point light's cube");
  only(problems, "shadow_map.content", map.content, ["depth"], "maps hold depths");
  only(problems, "shadow_map.reversed", map.reversed, [false], "depths grow from the light here");
  only(problems, "shadow_map.depth_format", map.depth_format, [engine.type === "vsm" ? "d32f" : device.depthFormat],
    "three.js chooses the format by engine.type, and the device what it stores");
  only(problems, "shadow_map.cull", map.cull, Object.keys(sideThatCasts), "faces cast or do not");
  refuseOthers(problems, "shadow_map", map, [...inCamera, "layout", "content", "reversed", "depth_format", "cull"], title);
}

function checkLookup(problems, lookup, light, engine) {
  const filter = lookupOf(engine, light)?.lookup?.filter;
  only(problems, "lookup.filter", lookup.filter, filter ? [filter] : [],
    filter ? 'engine.type filters: "basic" is nearest, "pcf" with engine.radius = 0 is hardware'
      : 'engine.type filters as no lookup.filter does');
  only(problems, "lookup.outside", lookup.outside, ["lit"], "beyond the map all is lit");
  only(problems, "lookup.position", lookup.position, [light.type === "point" ? "pixel" : "vertex"], "three.js chooses by the light");
  refuseOthers(problems, "lookup", lookup, ["filter", "outside", "position"], title);
}

/** The depth bias [depth units] and the offset along the normal [m] that [bias] adds, in Gnomon's signs. */
function biasOf(problems, bias, light, map) {
  const { constant = 0, constant_m: constantM = 0, normal_m: normalM = 0, ...others } = bias;
  for (const [key, value] of Object.entries(others)) {
    if (value !== 0 && value !== "off") problems[`bias.${key}`] = "three.js has a constant bias (depth units) and one along the normal (metres) alone";
  }
  if (constantM !== 0 && light.type !== "directional") problems["bias.constant_m"] = "depth is not linear in metres under this light; use bias.constant";
  return { constant: constant + (light.type === "directional" ? constantM / (map.far - map.near) : 0), normalM };
}

/** The map's coverage as job keys: symmetric sides are `fixed`; others were fitted by Gnomon. */
function fitOf({ fit, roll_deg: roll = 0, vertical_fov_deg: fov, light_camera: { projection, left, right, bottom, top } }) {
  if (projection === "perspective") return { fit: "fixed", fov_deg: fov, roll_deg: roll };
  const isFixed = right === -left && top === -bottom && right === top;
  return isFixed ? { fit: "fixed", half_extent: top, roll_deg: roll } : { fit: fit ?? "scene", roll_deg: roll };
}

/**
 * Translates a draw request.
 * @return `problems` by key; without problems also the page's `task`, the `tables` of case.toml, and `write` for the frame.
 */
export function plan({ light, mesh }, { shadow_map: map, lookup = {}, bias = {}, method = {}, engine }, device) {
  const problems = {};
  refuse(problems, "method", Object.keys(method), title);
  refuseOthers(problems, "engine", engine, keys.map(({ name }) => name), title);
  checkMap(problems, map, light, engine, device);
  checkLookup(problems, lookup, light, engine);
  const added = biasOf(problems, bias, light, map);
  if (engine.type === "vsm" && light.type === "point") problems["engine.type"] = "three.js has no vsm for point lights";
  else if (engine.type === "vsm" && mesh.no_cast?.length > 0) problems["engine.type"] = "with vsm three.js draws into the map whatever receives shadows, and scene.no_cast cannot be done";
  if (Object.keys(problems).length > 0) return { problems };

  const materialSide = { front: "back", back: "front", double: "double" }[engine.side];
  const casts = map.cull !== undefined ? sideThatCasts[map.cull] : engine.type === "vsm" ? engine.side : materialSide;
  const settings = { ...engine, casts, resolution: map.resolution, near: map.near, far: map.far,
    bias: engine.bias - added.constant, normalBias: engine.normalBias + added.normalM,
    camera: light.type === "point" ? undefined : map.light_camera };
  const isPicture = device.mask === "picture";
  const looked = isPicture ? undefined : lookupOf(engine, light); // a picture only shows shadows
  const known = device.readsDepths && engine.castShadow ? looked : undefined; // its depths can be reported
  const isNearest = looked?.lookup?.filter === "nearest";
  const tables = {
    shadow_map: { ...(light.type === "point" ? { layout: "cube" } : fitOf(map)), resolution: map.resolution, near: map.near, far: map.far, reversed: false,
      depth_format: engine.type === "vsm" ? "d32f" : device.depthFormat, cull: cullOf[{ front: "back", back: "front", double: "double" }[casts]] },
    lookup: { outside: "lit", position: light.type === "point" ? "pixel" : "vertex", ...looked?.lookup },
    ...(known?.method && { method: known.method }),
    bias: { constant: -Math.fround(settings.bias) + 0, slope: 0, normal_texels: 0,
      ...(settings.normalBias !== 0 && { normal_m: settings.normalBias }) },
    ...(!looked?.lookup && { channels: { fractions: true } }),
    ...(known && { map: { file: "map.exr" } }),
  };
  const task = { settings, withUnmoved: known !== undefined && (!isNearest || settings.normalBias !== 0), withMap: known !== undefined };
  const write = isPicture ? writeSeen : (file, posted, image) => writeFrame(file, posted, image, { resolution: map.resolution, isCube: light.type === "point", isNearest,
    hasKernel: known?.method !== undefined });
  return { problems, task, tables, write };
}
