// The matrix of a map that covers the same volume as Gnomon's.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** The coefficients of one axis: `row` applies to the position; `shift` to the distance (perspective) or to 1. */
function across(way, position, low, high) {
  const scale = 2 / (high - low);
  return { row: [...way.map((w) => w * scale), -dot(way, position) * scale], shift: -(high + low) / (high - low) };
}

/**
 * The rows of clip from world. z is -w at the near plane and w at the far plane.
 * @param camera  `light_camera` of docs/renderer_protocol.md: sides at distance 1 (perspective), or in metres.
 */
export function clipFromWorld({ projection, position, forward, up, left, right, bottom, top }, near, far) {
  const along = [...forward, -dot(forward, position)];
  const [x, y] = [across(cross(forward, up), position, left, right), across(up, position, bottom, top)];
  const isPerspective = projection === "perspective";
  const w = isPerspective ? along : [0, 0, 0, 1];
  const [scale, offset] = isPerspective ? [(far + near) / (far - near), (-2 * far * near) / (far - near)] : [2 / (far - near), -(far + near) / (far - near)];
  const z = along.map((value, k) => value * scale + (k === 3 ? offset : 0));
  return [...[x, y].map(({ row, shift }) => row.map((value, k) => value + w[k] * shift)), z, w];
}
