#!/usr/bin/env node
// A renderer that Gnomon drives: a ray through each pixel, and another from what it hits to the light. Needs node alone.
// docs/renderer_protocol.md says what is asked and answered, README.md here what to change to make it yours.
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { createInterface } from "node:readline";

const keys = [{ name: "bias_m", type: "number", range: [0, 1e6], default: 0.001, unit: "m",
  help: "how far from the surface, along the ray, a shadow ray begins to look for what it hits" }];
const alwaysSaid = ["resolution", "near", "far", "light_clip_from_world", "vertical_fov_deg", "half_extent",
  "light_camera", "maps"].map((key) => `shadow_map.${key}`);

const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const add = (a, b, k) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

/** The triangles of a .glb file in groups of 64 of one object, with the box around each group: most rays miss most boxes. */
function readGroups(file) {
  const data = readFileSync(file);
  const length = data.readUInt32LE(12);
  const gltf = JSON.parse(data.toString("utf8", 20, 20 + length));
  const values = (index) => {
    const { bufferView, byteOffset = 0, componentType, count, type } = gltf.accessors[index];
    const start = 28 + length + (gltf.bufferViews[bufferView].byteOffset ?? 0) + byteOffset;
    const [read, size] = { 5126: ["readFloatLE", 4], 5125: ["readUInt32LE", 4], 5123: ["readUInt16LE", 2] }[componentType];
    return Array.from({ length: count * (type === "VEC3" ? 3 : 1) }, (_, i) => data[read](start + i * size));
  };
  const groups = [];
  for (const { name, mesh } of gltf.nodes) {
    for (const { attributes, indices } of gltf.meshes[mesh].primitives) {
      const numbers = values(attributes.POSITION);
      const corners = values(indices).map((i) => numbers.slice(3 * i, 3 * i + 3));
      for (let i = 0; i < corners.length; i += 192) {
        const group = { name, low: [0, 1, 2].map((k) => Math.min(...corners.slice(i, i + 192).map((c) => c[k])) - 1e-6),
          high: [0, 1, 2].map((k) => Math.max(...corners.slice(i, i + 192).map((c) => c[k])) + 1e-6), triangles: [] };
        for (let j = i; j < Math.min(i + 192, corners.length); j += 3) {
          const [a, b, c] = corners.slice(j, j + 3);
          group.triangles.push([a, sub(b, a), sub(c, a)]);
        }
        groups.push(group);
      }
    }
  }
  return groups;
}

/** How many lengths of its direction a ray goes, beyond `least`, to the first triangle before `most`, or else `most`. */
function firstHit(origin, direction, groups, least = 0, most = Infinity) {
  for (const { low, high, triangles } of groups) {
    let enters = least;
    let leaves = most;
    for (let k = 0; k < 3; ++k) {
      const to = [(low[k] - origin[k]) / direction[k], (high[k] - origin[k]) / direction[k]];
      enters = Math.max(enters, Math.min(...to));
      leaves = Math.min(leaves, Math.max(...to));
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

/** A NumPy file of 32-bit floats. */
function writeNpy(file, shape, values) {
  const words = `{'descr': '<f4', 'fortran_order': False, 'shape': (${shape.join(", ")}), }`.padEnd(117) + "\n";
  writeFileSync(file, Buffer.concat([Buffer.from("\x93NUMPY\x01\x00v\x00", "latin1"), Buffer.from(words), Buffer.from(values.buffer)]));
}

/** Writes the world position of each pixel, NaN where it shows nothing, and 1 where it is lit, 0 where not. */
function draw({ mesh, camera, light, image: { width, height } }, groups, biasM, folder) {
  const [seen, casting] = [mesh.no_receive, mesh.no_cast].map((no = []) => groups.filter(({ name }) => !no.includes(name)));
  const forward = unit(sub(camera.target, camera.eye));
  const right = unit(cross(forward, camera.up));
  const isFlat = "orthographic_height" in camera;
  const half = isFlat ? camera.orthographic_height / 2 : Math.tan((camera.vertical_fov_deg * Math.PI) / 360);
  const [position, shadow] = [new Float32Array(width * height * 3).fill(NaN), new Float32Array(width * height).fill(1)];
  for (let i = 0; i < width * height; ++i) {
    const across = ((2 * ((i % width) + 0.5)) / width - 1) * (width / height) * half;
    const upward = (1 - (2 * (Math.floor(i / width) + 0.5)) / height) * half;
    const aside = add(add([0, 0, 0], right, across), cross(right, forward), upward);
    const [origin, direction] = isFlat ? [add(camera.eye, aside, 1), forward] : [camera.eye, add(forward, aside, 1)];
    const distance = firstHit(origin, direction, seen);
    if (distance === Infinity) continue;
    position.set(add(origin, direction, distance), 3 * i);
    const point = [...position.subarray(3 * i, 3 * i + 3)];
    const way = light.type === "directional" ? add([0, 0, 0], light.direction, -1) : sub(light.position, point);
    const far = light.type === "directional" ? Infinity : Math.hypot(...way);
    shadow[i] = firstHit(point, unit(way), casting, biasM, far) === far ? 1 : 0;
  }
  writeNpy(join(folder, "position.npy"), [height, width, 3], position);
  writeNpy(join(folder, "shadow.npy"), [height, width], shadow);
}

let scene, groups;
function answer({ hello, open, draw: order, frame }) {
  if (hello) return { protocol: 1, name: "rays.mjs", version: "1", device: `node ${process.version}`, keys };
  if (open) {
    [scene, groups] = [open, readGroups(open.mesh.file)];
    return { ok: true };
  }
  if (!order || !scene) return { error: "asked for something else than hello, open, draw, close, or to draw before a scene is open" };
  const refused = ["shadow_map", "lookup", "bias", "method", "engine"]
    .flatMap((table) => Object.keys(order[table] ?? {}).map((key) => `${table}.${key}`))
    .filter((key) => !alwaysSaid.includes(key) && key !== "engine.bias_m");
  if (refused.length) return { error: Object.fromEntries(refused.map((key) => [key, "rays have no such setting"])) };
  const began = performance.now();
  draw(scene, groups, order.engine.bias_m, dirname(frame));
  return { ok: true, seconds: (performance.now() - began) / 1000, files: { position: "position.npy", shadow: "shadow.npy" } };
}

for await (const line of createInterface({ input: process.stdin })) {
  const request = JSON.parse(line);
  if (request.close) break;
  let said;
  try {
    said = answer(request);
  } catch (problem) {
    said = { error: String(problem.message).split("\n")[0] };
  }
  process.stdout.write(JSON.stringify({ id: request.id, ...said }) + "\n");
}
process.stdin.destroy();
