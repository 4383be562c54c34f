// Writes meshes for Gnomon: binary glTF with positions and indices.

const kinds = { positions: { componentType: 5126, type: "VEC3", width: 3 }, indices: { componentType: 5125, type: "SCALAR", width: 1 } };

function padded(buffer, byte) {
  return Buffer.concat([buffer, Buffer.alloc((4 - (buffer.length % 4)) % 4, byte)]);
}

function chunk(type, bytes) {
  const head = Buffer.alloc(8);
  head.writeUInt32LE(bytes.length, 0);
  head.writeUInt32LE(type, 4);
  return Buffer.concat([head, bytes]);
}

/** The bounds of each coordinate, which glTF requires for positions. */
function boundsOf(positions) {
  const all = [0, 1, 2].map((k) => positions.filter((_, i) => i % 3 === k));
  return { min: all.map((values) => values.reduce((a, b) => Math.min(a, b))), max: all.map((values) => values.reduce((a, b) => Math.max(a, b))) };
}

/** The bytes of a .glb file. @param meshes  with `name`, `positions` (Float32Array, world space [m]) and `indices` (Uint32Array). */
export function encodeGlb(meshes) {
  const [accessors, bufferViews, parts] = [[], [], []];
  let byteOffset = 0;
  const add = (kind, values) => {
    const { width, ...described } = kinds[kind];
    const bytes = Buffer.from(values.buffer, values.byteOffset, values.byteLength);
    bufferViews.push({ buffer: 0, byteOffset, byteLength: bytes.length });
    accessors.push({ bufferView: bufferViews.length - 1, count: values.length / width, ...described, ...(kind === "positions" && boundsOf(values)) });
    parts.push(bytes);
    byteOffset += bytes.length;
    return accessors.length - 1;
  };
  const gltf = { asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: meshes.map((_, i) => i) }],
    nodes: meshes.map(({ name }, mesh) => ({ name, mesh })),
    meshes: meshes.map(({ positions, indices }) => ({ primitives: [{ attributes: { POSITION: add("positions", positions) }, indices: add("indices", indices) }] })),
    accessors, bufferViews, buffers: [{ byteLength: byteOffset }] };
  const body = Buffer.concat([chunk(0x4e4f534a, padded(Buffer.from(JSON.stringify(gltf)), 0x20)), chunk(0x004e4942, Buffer.concat(parts))]);
  const head = Buffer.alloc(12);
  head.write("glTF", 0, "latin1");
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(12 + body.length, 8);
  return Buffer.concat([head, body]);
}
