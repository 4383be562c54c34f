// The images of a page, read without a browser by the page's own scripts.

import { readFileSync } from "node:fs";
import { loadScripts } from "./scripts.mjs";

export const imageScripts = [
  "image/pixel_names.js", "blocks.js", "bias/bias_order.js", "bias/bias_units.js", "bias/bias_counts.js", "numbers.js",
  "charts/scales.js", "charts/colours.js", "tables/maps.js", "image/image_data.js", "image/error_causes.js",
  "image/marks.js", "image/error_clusters.js", "image/pixel_sentence.js", "image/texel_grid.js",
];
export const imageNames = [
  "BlockReader", "PixelImage", "loadImage", "ErrorCauses", "unknownCode", "causeNames", "labelNames", "classNames",
  "markGrowth", "paintMarks", "findClusters", "errorClusters", "boxOf", "middlePixel", "describeCluster",
  "fewDigits", "lengthWords", "nearerM", "pixelSentence", "texelOf", "texelDepths", "texelStates", "texelStatesAround",
];
export const scripts = loadScripts(imageScripts, imageNames);

/**
 * @param {string} file  a report.html
 * @return {Promise<PixelImage[]>}  its images in their order
 */
export async function readImages(file) {
  const page = readFileSync(file, "utf8");
  const textOf = (id) => new RegExp(`id="${id}">(.*?)</script>`, "s").exec(page)[1];
  const reader = new scripts.BlockReader(textOf);
  const { images } = JSON.parse(textOf("gnomon-data"));
  return Promise.all(images.map((stored) => scripts.loadImage(stored, reader)));
}
