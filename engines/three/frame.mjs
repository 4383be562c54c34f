// Writes posted data as the images of docs/evaluate.md.
import { dirname, join } from "node:path";
import { writeExr } from "../common/exr.mjs";
import { orZero, seenChannels, targetReader } from "../common/frame.mjs";

/** The channels of a lookup: depths of receiver and map, texel, and kernel axis. `map` is given if the shader cannot sample it. */
function lookupChannels(read, { resolution, isCube, hasKernel }, map) {
  const [r, u, v, face] = [read(1, 0), read(1, 1), read(1, 2), read(2, 1)];
  const isInside = (x, y) => [u(x, y), v(x, y)].every((at) => at >= 0 && at <= resolution);
  const texel = (at) => Math.min(Math.floor(at), resolution - 1);
  const mapDepth = (x, y) => map[((isCube ? face(x, y) * resolution : 0) + texel(v(x, y))) * resolution + texel(u(x, y))];
  const depth = map ? mapDepth : read(2, 2);
  return { "z.light": r, "z.map": (x, y) => (isInside(x, y) ? depth(x, y) : NaN), "texel.X": u, "texel.Y": v,
    ...(isCube && { map_index: orZero(face) }), ...(hasKernel && { "kernel_axis.X": read(1, 3), "kernel_axis.Y": read(2, 3) }) };
}

/**
 * Writes the frame, and the map beside it if there is one.
 * @param posted  `frame`, and `unmoved` and `map` if they are known.
 * @param lookup  size and kind of the map; `isNearest` if a shader read the texel; `hasKernel` if samples surround it.
 */
export function writeFrame(file, posted, { width, height }, lookup) {
  const { resolution, isNearest } = lookup;
  const seen = targetReader(posted.frame, width, height);
  const channels = seenChannels(seen);
  if (posted.frame.length === 12 * width * height) channels["id.geom"] = orZero(seen(2, 0));
  if (posted.map) {
    const sampled = isNearest ? undefined : posted.map;
    Object.assign(channels, lookupChannels(seen, lookup, sampled));
    if (posted.unmoved) {
      const unmoved = targetReader(posted.unmoved, width, height);
      const looked = { V: orZero(unmoved(0, 3)), ...lookupChannels(unmoved, lookup, sampled) };
      Object.entries(looked).forEach(([name, value]) => { channels[`unmoved.${name}`] = value; });
    }
    const rowFromBelow = (y) => y - (y % resolution) + resolution - 1 - (y % resolution);
    writeExr(join(dirname(file), "map.exr"), resolution, posted.map.length / resolution, {
      "map.d": (x, y) => posted.map[rowFromBelow(y) * resolution + x],
    });
  }
  writeExr(file, width, height, channels);
}
