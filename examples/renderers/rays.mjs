#!/usr/bin/env node
// A renderer that Gnomon drives. It traces a ray through each pixel, and one from the hit to the light. Only needs node.
// docs/renderer_protocol.md describes requests and answers; README.md explains how to adapt it.
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { createInterface } from "node:readline";

const keys = [{ name: "bias_m", type: "number", range: [0, 1e6], default: 0.001, unit: "m",
  help: "how far from the surface, along the ray, a shadow ray begins to look for what it hits" }];
const ofMaps = ["resolution", "near", "far", "light_clip_from_world", "vertical_fov_deg", "half_extent", "light_camera", "maps"];
let opened; // what `open` said, and `groups`

const add = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
const sub = (a, b) => add(a, b, -1);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

/** The triangles of a .glb file in groups of 64 of one object, with bounding boxes, because most rays miss most boxes. */
function readGroups(file) {
  const data = readFileSync(file);
  const length = data.readUInt32LE(12);
  const gltf = JSON.parse(data.toString("utf8", 20, 20 + length));
  const values = (accessor, read) => {
    const { byteOffset = 0, byteLength } = gltf.bufferViews[gltf.accessors[accessor].bufferView];
    return Array.from({ length: byteLength / 4 }, (_, i) => data[read](28 + length + byteOffset + 4 * i));
  };
  return gltf.nodes.flatMap(({ name, mesh }) => {
    const [{ attributes, indices }] = gltf.meshes[mesh].primitives;
    const positions = values(attributes.POSITION, "readFloatLE");
    const corners = values(indices, "readUInt32LE").map((i) => positions.slice(3 * i, 3 * i + 3));
    return Array.from({ length: Math.ceil(corners.length / 192) }, (_, i) => {
      const group = corners.slice(192 * i, 192 * (i + 1));
      const [low, high] = [[Math.min, -1e-6], [Math.max, 1e-6]].map(([end, more]) => [0, 1, 2].map((k) => end(...group.map((c) => c[k])) + more));
      return { name, low, high, triangles: group.flatMap((a, j) => (j % 3 ? [] : [[a, sub(group[j + 1], a), sub(group[j + 2], a)]])) };
    });
  });
}

/** The distance of the first triangle between `least` and `most`, in lengths of the direction; else `most`. */
function firstHit(origin, direction, groups, least = 0, most = Infinity) {
  for (const { low, high, triangles } of groups) {
    let [enters, leaves] = [least, most];
    for (let k = 0; k < 3; ++k) {
      const [one, other] = [(low[k] - origin[k]) / direction[k], (high[k] - origin[k]) / direction[k]];
      [enters, leaves] = [Math.max(enters, Math.min(one, other)), Math.min(leaves, Math.max(one, other))];
    }
    if (!(enters <= leaves)) continue;
    for (const [a, e, f] of triangles) {
      const [p, s] = [cross(direction, f), sub(origin, a)];
      const [q, det] = [cross(s, e), dot(e, p)];
      const [u, v, t] = [dot(s, p) / det, dot(direction, q) / det, dot(f, q) / det];
      if (u >= 0 && v >= 0 && u + v <= 1 && t > least && t < most) most = t;
    }
  }
  return most;
}

/** Writes a NumPy file of 32-bit floats. */
function writeNpy(file, shape, values) {
  const words = `{'descr': '<f4', 'fortran_order': False, 'shape': (${shape.join(", ")}), }`.padEnd(117) + "\n";
  writeFileSync(file, Buffer.concat([Buffer.from("\x93NUMPY\x01\x00v\x00" + words, "latin1"), Buffer.from(values.buffer)]));
}

/** Writes the world position of each pixel, NaN for background, and 1 for lit, 0 for shadowed pixels. */
function draw({ mesh, camera, light, image: { width, height }, groups }, biasM, folder) {
  const [seen, casting] = [mesh.no_receive, mesh.no_cast].map((no = []) => groups.filter(({ name }) => !no.includes(name)));
  const forward = unit(sub(camera.target, camera.eye));
  const right = unit(cross(forward, camera.up));
  const isFlat = "orthographic_height" in camera;
  const half = isFlat ? camera.orthographic_height / 2 : Math.tan((camera.vertical_fov_deg * Math.PI) / 360);
  const [position, shadow] = [new Float32Array(width * height * 3).fill(NaN), new Float32Array(width * height).fill(1)];
  for (let i = 0; i < width * height; ++i) {
    const [x, y] = [(2 * ((i % width) + 0.5)) / width - 1, 1 - (2 * (Math.floor(i / width) + 0.5)) / height];
    const aside = add(right.map((c) => c * x * (width / height) * half), cross(right, forward), y * half);
    const [origin, direction] = isFlat ? [add(camera.eye, aside), forward] : [camera.eye, add(forward, aside)];
    const distance = firstHit(origin, direction, seen);
    if (distance === Infinity) continue;
    position.set(add(origin, direction, distance), 3 * i);
    const point = [...position.subarray(3 * i, 3 * i + 3)]; // rounded, as it is read from a target
    const way = light.type === "directional" ? light.direction.map((c) => -c) : sub(light.position, point);
    const far = light.type === "directional" ? Infinity : Math.hypot(...way);
    shadow[i] = firstHit(point, unit(way), casting, biasM, far) === far ? 1 : 0;
  }
  writeNpy(join(folder, "position.npy"), [height, width, 3], position);
  writeNpy(join(folder, "shadow.npy"), [height, width], shadow);
}

function answerTo({ hello, open, draw: order, frame }) {
  if (hello) return { protocol: 1, name: "rays.mjs", version: "1", device: `node ${process.version}`, keys };
  if (open) {
    opened = { ...open, groups: readGroups(open.mesh.file) };
    return { ok: true };
  }
  const asked = ["shadow_map", "lookup", "bias", "method", "engine"].flatMap((table) => Object.keys(order[table] ?? {}).map((key) => `${table}.${key}`));
  const refused = asked.filter((key) => !["engine.bias_m", ...ofMaps.map((name) => `shadow_map.${name}`)].includes(key));
  if (refused.length) return { error: Object.fromEntries(refused.map((key) => [key, "rays have no such setting"])) };
  const began = performance.now();
  draw(opened, order.engine.bias_m, dirname(frame));
  return { ok: true, seconds: (performance.now() - began) / 1000, files: { position: "position.npy", shadow: "shadow.npy" } };
}

for await (const line of createInterface({ input: process.stdin })) {
  const request = JSON.parse(line);
  if (request.close) break;
  let answer;
  try {
    answer = answerTo(request);
  } catch (problem) {
    answer = { error: String(problem.message).split("\n")[0] };
  }
  process.stdout.write(JSON.stringify({ id: request.id, ...answer }) + "\n");
}
process.stdin.destroy();
