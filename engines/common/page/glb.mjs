// Reads Gnomon's mesh files: binary glTF with positions and indices.

const array = { 5126: Float32Array, 5125: Uint32Array, 5123: Uint16Array };
const width = { VEC3: 3, SCALAR: 1 };

function values(gltf, blob, index) {
  const { bufferView, byteOffset = 0, componentType, count, type } = gltf.accessors[index];
  const start = (gltf.bufferViews[bufferView].byteOffset ?? 0) + byteOffset;
  return new array[componentType](blob, start, count * width[type]);
}

/** Three unshared corners for each triangle. */
function corners(shared, indices) {
  const positions = new Float32Array(3 * indices.length);
  indices.forEach((index, i) => positions.set(shared.subarray(3 * index, 3 * index + 3), 3 * i));
  return positions;
}

/** The unit normal of its triangle for each corner; zeros for degenerate triangles. */
function normalsOf(positions) {
  const normals = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; i += 9) {
    const [a, b, c] = [0, 3, 6].map((k) => positions.subarray(i + k, i + k + 3));
    const [u, v] = [b, c].map((p) => [0, 1, 2].map((k) => p[k] - a[k]));
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const length = Math.hypot(...normal) || 1;
    for (let k = 0; k < 9; ++k) normals[i + k] = normal[k % 3] / length;
  }
  return normals;
}

/**
 * The objects of a .glb file: `name`, `place` in the file, `positions` [m] with three corners for each triangle, flat `normals`,
 * and `casts` and `isSeen` from the scene's `no_cast` and `no_receive`.
 */
export async function loadObjects({ address, mesh: { no_cast: noCast = [], no_receive: noReceive = [] } }) {
  const data = await (await fetch(address)).arrayBuffer();
  const length = new DataView(data).getUint32(12, true);
  const gltf = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 20, length)));
  const blob = data.slice(28 + length);
  return gltf.nodes.flatMap(({ name, mesh }, place) => gltf.meshes[mesh].primitives.map(({ attributes, indices }) => {
    const positions = corners(values(gltf, blob, attributes.POSITION), values(gltf, blob, indices));
    return { name, place, positions, normals: normalsOf(positions), casts: !noCast.includes(name), isSeen: !noReceive.includes(name) };
  }));
}
