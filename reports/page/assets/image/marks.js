// Marks of wrong pixels over a quiet base, drawn larger where the screen has fewer pixels than the image.

/** How wide a mark is at least where a pixel of the screen covers more than one of the image [screen px]. */
const leastMarkPx = 1.8;

/** By how many pixels of the image a mark grows on each side, at a zoom in screen pixels per pixel of the image. */
function markGrowth(zoom) {
  return zoom < 1 ? Math.ceil((leastMarkPx / zoom - 1) / 2) : 0;
}

/** The places of marks by their colour, the rarest last. */
function marksByColour(marks) {
  const places = new Map();
  for (let i = 0; i < marks.length; ++i) {
    if (marks[i] !== 0) {
      if (!places.has(marks[i])) {
        places.set(marks[i], []);
      }
      places.get(marks[i]).push(i);
    }
  }
  return [...places].sort(([, a], [, b]) => b.length - a.length);
}

/** Paints a square around each place. */
function growMarks(packed, width, places, colour, growth) {
  const height = packed.length / width;
  for (const place of places) {
    const x = place % width;
    const y = (place - x) / width;
    const right = Math.min(width - 1, x + growth);
    for (let row = Math.max(0, y - growth); row <= Math.min(height - 1, y + growth); ++row) {
      for (let at = row * width + Math.max(0, x - growth); at <= row * width + right; ++at) {
        packed[at] = colour;
      }
    }
  }
}

/**
 * Paints marks over a base. Grown marks hide no mark, and the rarer colour hides the more frequent one.
 * @param {Uint32Array} packed  (pixels) written
 * @param {number} width  of the image
 * @param {Uint32Array} base  (pixels) packed colours
 * @param {Uint32Array} marks  (pixels) packed colours, 0 where there is no mark
 * @param {number} growth  by how many pixels on each side
 */
function paintMarks(packed, width, base, marks, growth) {
  packed.set(base);
  if (growth > 0) {
    for (const [colour, places] of marksByColour(marks)) {
      growMarks(packed, width, places, colour, growth);
    }
  }
  for (let i = 0; i < packed.length; ++i) {
    if (marks[i] !== 0) {
      packed[i] = marks[i];
    }
  }
}
