// Writes objects as binary glTF for Filament, with flat normals and a white, rough material.

const magic = 0x46546c67;
const padded = (size) => Math.ceil(size / 4) * 4;

function chunk(type, bytes, filler) {
  const head = new Uint32Array([padded(bytes.length), type]);
  const body = new Uint8Array(padded(bytes.length)).fill(filler);
  body.set(bytes);
  return [new Uint8Array(head.buffer), body];
}

function joined(parts) {
  const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  parts.reduce((at, part) => { all.set(part, at); return at + part.length; }, 0);
  return all;
}

function bounds(positions) {
  const axis = (k) => positions.filter((_, i) => i % 3 === k);
  const least = (values) => values.reduce((a, b) => Math.min(a, b));
  const most = (values) => values.reduce((a, b) => Math.max(a, b));
  return { min: [0, 1, 2].map((k) => least(axis(k))), max: [0, 1, 2].map((k) => most(axis(k))) };
}

/** The bytes of a .glb file. Nodes are in the order of the objects, and named by their indices. */
export function writeGlb(objects, doubleSided) {
  const views = objects.flatMap(({ positions, normals }) => [positions, normals]);
  let offset = 0;
  const bufferViews = views.map(({ byteLength }) => { offset += byteLength; return { buffer: 0, byteOffset: offset - byteLength, byteLength }; });
  const accessors = views.map((values, i) => ({ bufferView: i, componentType: 5126, count: values.length / 3, type: "VEC3",
    ...(i % 2 === 0 && bounds(values)) }));
  const gltf = {
    asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: objects.map((_, i) => i) }],
    nodes: objects.map((_, i) => ({ mesh: i, name: String(i) })),
    meshes: objects.map((_, i) => ({ primitives: [{ attributes: { POSITION: 2 * i, NORMAL: 2 * i + 1 }, material: 0 }] })),
    materials: [{ doubleSided, pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 1 } }],
    accessors, bufferViews, buffers: [{ byteLength: offset }],
  };
  const blob = joined(views.map((values) => new Uint8Array(values.buffer, values.byteOffset, values.byteLength)));
  const chunks = [...chunk(0x4e4f534a, new TextEncoder().encode(JSON.stringify(gltf)), 0x20), ...chunk(0x004e4942, blob, 0)];
  const size = 12 + chunks.reduce((sum, part) => sum + part.length, 0);
  return joined([new Uint8Array(new Uint32Array([magic, 2, size]).buffer), ...chunks]);
}
