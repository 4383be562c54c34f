// Clusters of wrong pixels, and what they are called.

/** What an error is called after "58 pixels of". */
const errorNouns = {
  acne: "acne",
  peter_panning: "peter panning",
  leak: "light leak",
  edge: "edge error",
  overshadow: "overshadow",
  bleed: "light bleed",
};

/**
 * Collects the marked pixels that are 8-connected to one, and clears their marks.
 * @return {Int32Array}
 */
function takeCluster(marked, width, first) {
  const lastRow = marked.length / width - 1;
  const found = [first];
  marked[first] = 0;
  for (let next = 0; next < found.length; ++next) {
    const x = found[next] % width;
    const y = (found[next] - x) / width;
    const [left, right] = [x > 0 ? x - 1 : x, x < width - 1 ? x + 1 : x];
    for (let row = Math.max(0, y - 1); row <= Math.min(lastRow, y + 1); ++row) {
      for (let at = row * width + left; at <= row * width + right; ++at) {
        if (marked[at] !== 0) {
          marked[at] = 0;
          found.push(at);
        }
      }
    }
  }
  return Int32Array.from(found);
}

/**
 * The clusters of 8-connected marked pixels, the largest first, those of a size in reading order.
 * @param {Uint8Array} marked  (width × height) 1 at marked pixels; cleared
 * @param {number} width
 * @return {Int32Array[]}  the pixels of each cluster
 */
function findClusters(marked, width) {
  const clusters = [];
  for (let first = marked.indexOf(1); first >= 0; first = marked.indexOf(1, first + 1)) {
    clusters.push(takeCluster(marked, width, first));
  }
  return clusters.sort((a, b) => b.length - a.length);
}

/** Clusters of the pixels that are wrong at a float32 bias. */
function errorClusters(image, bias) {
  const { litFrom } = image;
  const marked = image.layers.class.map((pixelClass, i) => {
    const isLit = litFrom[i] <= bias;
    return (pixelClass === classLit && !isLit) || (pixelClass === classBlocked && isLit) ? 1 : 0;
  });
  return findClusters(marked, image.width);
}

/**
 * Where some pixels are.
 * @return {{left: number, top: number, right: number, bottom: number}}  right and bottom are beyond the last
 */
function boxOf(pixels, width) {
  const box = { left: Infinity, top: Infinity, right: 0, bottom: 0 };
  for (const index of pixels) {
    const x = index % width;
    const y = (index - x) / width;
    box.left = Math.min(box.left, x);
    box.top = Math.min(box.top, y);
    box.right = Math.max(box.right, x + 1);
    box.bottom = Math.max(box.bottom, y + 1);
  }
  return box;
}

/** The pixel of a cluster that is nearest to its centre. */
function middlePixel(pixels, width) {
  const centre = { x: 0, y: 0 };
  const places = Array.from(pixels, (index) => ({ x: index % width, y: Math.floor(index / width) }));
  for (const { x, y } of places) {
    centre.x += x / places.length;
    centre.y += y / places.length;
  }
  const gap = ({ x, y }) => (x - centre.x) ** 2 + (y - centre.y) ** 2;
  return places.reduce((best, place) => (gap(place) < gap(best) ? place : best));
}

/** The value that most pixels of a cluster have, of equally frequent ones the first, and how many have it. */
function mostFrequent(pixels, valueOf) {
  const counts = new Map();
  for (const index of pixels) {
    const value = valueOf(index);
    counts.set(value, (counts.get(value) ?? 0) + 1);
  }
  const [value, count] = [...counts].reduce((best, entry) => (entry[1] > best[1] ? entry : best));
  return { value, count };
}

/** What most wrong pixels of a cluster are: their name, or the kind of error where the page knows no name. */
function clusterNoun(causes, pixels, bias) {
  const { image } = causes;
  const { class: classes, label: labels } = image.layers;
  const code = labels === undefined ? null : mostFrequent(pixels, (i) => causes.labelAt(i, bias));
  if (code !== null && code.value !== unknownCode && code.value !== 0) {
    return { noun: errorNouns[labelNames[code.value]], count: code.count };
  }
  const kind = mostFrequent(pixels, (i) => classes[i]);
  return { noun: kind.value === classLit ? "false shadow" : "false lit", count: kind.count };
}

/**
 * What a cluster is: "58 pixels of acne", and the object that most of it is on.
 * @param {ErrorCauses} causes
 * @return {{text: string, object: ?string}}
 */
function describeCluster(causes, pixels, bias) {
  const { layers, objects, step } = causes.image;
  const { noun, count } = clusterNoun(causes, pixels, bias);
  const size = `${grouped(pixels.length)} ${step === 1 ? "" : "shown "}${pixels.length === 1 ? "pixel" : "pixels"}`;
  const object = layers.object === undefined ? null : mostFrequent(pixels, (i) => layers.object[i]).value;
  return {
    text: count === pixels.length ? `${size} of ${noun}` : `${size}, mostly ${noun},`,
    object: objects?.[object] ?? null,
  };
}
