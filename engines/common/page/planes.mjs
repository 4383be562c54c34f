// How near and how far a camera must see.

/** The least and the greatest corner of all objects [m]. */
export function boundsOf(objects) {
  const least = [Infinity, Infinity, Infinity];
  const most = [-Infinity, -Infinity, -Infinity];
  objects.forEach(({ positions }) => positions.forEach((value, i) => {
    least[i % 3] = Math.min(least[i % 3], value);
    most[i % 3] = Math.max(most[i % 3], value);
  }));
  return { least, most };
}

/**
 * The distances [m] of a camera's planes: near, a thousandth of the diagonal, and far, behind everything; of an orthographic
 * camera as far behind it as before.
 */
export function planesOf({ eye, orthographic_height: height }, objects) {
  const { least, most } = boundsOf(objects);
  const diagonal = Math.hypot(...most.map((value, k) => value - least[k]));
  const outside = Math.hypot(...eye.map((value, k) => Math.max(least[k] - value, 0, value - most[k])));
  const far = (outside + diagonal) * 1.01;
  return { near: height === undefined ? diagonal * 1e-3 : -far, far };
}
