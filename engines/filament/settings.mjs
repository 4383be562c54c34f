// Translates Gnomon's requests to Filament. Its wasm build binds no shadow options, so there is little to set.
import { writeSeen } from "../common/frame.mjs";
import { boolean, inCamera, only, refuseAllButOwn, refuseOthers } from "../common/settings.mjs";

const title = "Filament";
const resolution = 1024; // LightManager::ShadowOptions::mapSize, which JavaScript cannot set

/** The keys of the job's [engine] table, with Filament's own names and defaults. */
export const keys = [
  boolean("castShadows", true, "LightManager.Builder.castShadows: false draws no shadows"),
  boolean("doubleSided", false, "the glTF material's doubleSided: both sides are seen"),
];

/** The radius of a spot's falloff that includes the whole cone up to the map's far plane. */
function rangeOf({ type, cone_deg: cone }, far) {
  return type === "spot" ? far / Math.cos((cone * Math.PI) / 360) : undefined;
}

/** Why a scene cannot be drawn, or undefined. */
export function refusal({ light, mesh: { no_receive: unseen = [] } }) {
  if (light.type === "point") return "the shadows of Filament's point lights are not driven";
  if (light.type === "spot" && light.cone_deg >= 179) return "Filament's map opens as wide as the cone, and 179 degrees are too wide";
  return unseen.length > 0 ? "what Filament's camera does not see casts no shadow either: scene.no_receive cannot be done" : undefined;
}

/**
 * Translates a draw request.
 * @return `problems` by key; without problems also the page's `task`, the `tables` of case.toml, and `write` for the frame.
 */
export function plan({ light }, order) {
  const { shadow_map: map, engine } = order;
  const problems = {};
  refuseAllButOwn(problems, order, keys, title, "Filament's biases are its defaults: JavaScript cannot set them");
  only(problems, "shadow_map.layout", map.layout, ["single"], "a light has one map");
  refuseOthers(problems, "shadow_map", map, [...inCamera, "layout"], title);
  if (map.roll_deg) problems["shadow_map.roll_deg"] = "Filament turns the map itself";
  if (Object.keys(problems).length > 0) return { problems };
  return { problems, write: writeSeen, task: { engine, range: rangeOf(light, map.far) },
    tables: { shadow_map: { resolution }, channels: { fractions: true } } };
}
