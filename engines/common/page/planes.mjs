// Near and far planes of a camera.

/** The lower and upper corner of the bounding box of all objects [m]. */
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
 * The distances of a camera's planes [m]. Far lies behind all objects; near is a thousandth of the scene's diagonal, or -far for an
 * orthographic camera.
 */
export function planesOf({ eye, orthographic_height: height }, objects) {
  const { least, most } = boundsOf(objects);
  const diagonal = Math.hypot(...most.map((value, k) => value - least[k]));
  const outside = Math.hypot(...eye.map((value, k) => Math.max(least[k] - value, 0, value - most[k])));
  const far = (outside + diagonal) * 1.01;
  return { near: height === undefined ? diagonal * 1e-3 : -far, far };
}
