// Settings for a project's own scene, which keeps its materials' sides, its light and its shadow.

import { writeSeen } from "../common/frame.mjs";
import { refuseAllButOwn, refuseOthers } from "../common/settings.mjs";
import { keys } from "./settings.mjs";

const title = "a three.js project";
const nearlyEqual = 1e-5; // tolerance of directions, and of positions by their size, which are 32-bit floats

/** The engine's keys with the project's settings as defaults. Each material decides which sides cast. */
export function keysOfProject({ settings }) {
  return keys.filter(({ name }) => name in settings).map((key) => ({ ...key, default: settings[key.name] }));
}

function isNear(a = [], b = []) {
  return a.length === b.length && a.every((value, k) => Math.abs(value - b[k]) <= nearlyEqual * Math.max(1, Math.hypot(...a)));
}

/** Refuses jobs whose light differs from the project's. */
export function refusalOfProject({ light }, { light: own }) {
  const unit = (way) => way?.map((value) => value / Math.hypot(...way));
  const isSame = light.type === own.type && isNear(unit(own.direction), unit(light.direction)) && isNear(own.position, light.position)
    && isNear(own.type === "spot" ? own.target : [], own.type === "spot" ? light.target : []) && isNear([own.cone_deg ?? 0], [light.cone_deg ?? 0]);
  return isSame ? undefined : "the job's light differs from the project's; write the job again with engines/three/export.mjs";
}

/** As `plan` of settings.mjs. The project places the map, and its depths are not reported. */
export function planProject(order, { project }) {
  const { shadow_map: map, engine } = order;
  const problems = {};
  refuseAllButOwn(problems, order, keysOfProject(project), title, "the biases of a project are engine.bias and engine.normalBias");
  refuseOthers(problems, "shadow_map", map, ["resolution", "near", "far", "light_clip_from_world", "vertical_fov_deg", "half_extent", "light_camera", "maps"], title);
  if (engine.type === "vsm" && project.light.type === "point") problems["engine.type"] = "three.js has no vsm for point lights";
  const { near, far } = project.map;
  return { problems, task: { settings: { ...engine, resolution: map.resolution } }, write: writeSeen,
    tables: { shadow_map: { resolution: map.resolution, near, far }, channels: { fractions: engine.type !== "basic" } } };
}
