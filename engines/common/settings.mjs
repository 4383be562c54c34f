// Describes the settings of engines, and refuses unsupported keys.

/** A key of hello: a real number. */
export const number = (name, range, initial, unit, help) => ({ name, type: "number", range, default: initial, unit, help });

/** A key of hello: a whole number. */
export const integer = (name, range, initial, unit, help) => ({ name, type: "integer", range, default: initial, unit, help });

/** A key of hello: one of some words. */
export const choice = (name, values, initial, help) => ({ name, type: "choice", values, default: initial, unit: "", help });

/** A key of hello: true or false. */
export const boolean = (name, initial, help) => ({ name, type: "boolean", default: initial, unit: "", help });

/** Keys of [shadow_map] that the map's camera already implies. */
export const inCamera = ["resolution", "near", "far", "light_clip_from_world", "vertical_fov_deg", "half_extent", "light_camera",
  "maps", "fit", "fov_deg", "roll_deg"];

/** Refuses a key whose value is not `allowed`. */
export function only(problems, key, said, allowed, why) {
  if (said === undefined || allowed.includes(said)) return;
  const words = allowed.map((a) => JSON.stringify(a)).join(" or ");
  problems[key] = words ? `${why}; only ${words} is supported` : `${why}; omit the key`;
}

/** Refuses the keys of a table. */
export function refuse(problems, table, names, title) {
  names.forEach((key) => { problems[`${table}.${key}`] = `${title} has no such setting`; });
}

/** Refuses the keys of a table that are not `known`. */
export function refuseOthers(problems, table, said, known, title) {
  refuse(problems, table, Object.keys(said).filter((key) => !known.includes(key)), title);
}

/** Refuses bias terms that are not off. */
function refuseBias(problems, bias, why) {
  Object.entries(bias).filter(([, value]) => value !== 0 && value !== "off").forEach(([key]) => { problems[`bias.${key}`] = why; });
}

/** Refuses all keys except those of the map and the engine's own: methods, filters, biases and unknown keys. */
export function refuseAllButOwn(problems, { lookup = {}, bias = {}, method = {}, engine }, keys, title, whyNoBias) {
  refuse(problems, "method", Object.keys(method), title);
  refuseOthers(problems, "engine", engine, keys.map(({ name }) => name), title);
  refuseOthers(problems, "lookup", lookup, ["outside"], title);
  only(problems, "lookup.outside", lookup.outside, ["lit"], "beyond the map all is lit");
  refuseBias(problems, bias, whyNoBias);
}
