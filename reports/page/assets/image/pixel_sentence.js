// What happened to a pixel, in one sentence that is made of its stored layers alone.

const unitPrefixes = [
  { below: 1e-5, factor: 1e6, name: "µm" },
  { below: 0.01, factor: 1e3, name: "mm" },
  { below: 1, factor: 100, name: "cm" },
  { below: 1000, factor: 1, name: "m" },
  { below: Infinity, factor: 1e-3, name: "km" },
];

/** A number to two significant digits, to three from 100 on; "0" and "<0.001" near zero. */
function fewDigits(value) {
  const size = Math.abs(value);
  if (!Number.isFinite(size)) {
    return readable(value);
  }
  if (size === 0) {
    return "0";
  }
  const sign = value < 0 ? minus : "";
  if (size < 0.001) {
    return value < 0 ? `>${minus}0.001` : "<0.001";
  }
  const rounded = Number(size < 99.5 ? size.toPrecision(2) : Math.round(size).toPrecision(3));
  if (rounded >= 10) {
    return sign + grouped(rounded);
  }
  return sign + (rounded >= 1 ? rounded.toFixed(1) : String(rounded));
}

/** A length in the scene's unit, with a prefix that suits it: "0.8 mm", "3.4 cm", "12 units". */
function lengthWords(length) {
  if (sceneUnit() !== "m") {
    return `${fewDigits(length)} ${sceneUnit()}`;
  }
  const rounded = Number(Math.abs(length).toPrecision(2));
  const { factor, name } = unitPrefixes.find(({ below }) => rounded < below) ?? unitPrefixes.at(-1);
  return length === 0 ? "0 m" : `${fewDigits(length * factor)} ${name}`;
}

/** The frustum in whose depths a pixel was compared: a cascade's own one. */
function frustumAt({ frustum, layers, detail }, index) {
  const maps = detail?.by_map;
  if (layers.map_index === undefined || !maps || !areCascades(maps)) {
    return frustum;
  }
  const map = maps[layers.map_index[index]];
  return map === undefined ? frustum : { ...frustum, range_m: map.far_m - map.near_m, texel_m: map.texel_m };
}

/** Whether the layer map_depth has depths that the map stores: other methods store none, and `linear` interpolates. */
function storesDepths({ detail, filter }) {
  const method = detail?.job?.["method.name"];
  return filter !== "linear" && (method === undefined || method === "depth" || method === "pcf");
}

/**
 * How much nearer to the light than the receiver the surface in its texel is, along the light's axis [m].
 * @return {number}  negative if it is farther; NaN if that is not known
 */
function nearerM(image, index) {
  const { receiver_depth: receivers, map_depth: stored, light_distance_m: distances } = image.layers;
  if (!storesDepths(image) || receivers === undefined || stored === undefined) {
    return NaN;
  }
  const frustum = frustumAt(image, index);
  const above = receivers[index] - stored[index];
  const lengthM = biasLengthM(frustum, frustum.reversed ? -above : above, distances?.[index] ?? NaN);
  return Number.isFinite(lengthM) ? lengthM : NaN;
}

/** Where in the map a pixel is looked up; null where the page does not know it. */
function texelOf({ layers }, index) {
  const { texel_x: columns, texel_y: rows, class: classes } = layers;
  const isRead = columns !== undefined && hasReceiver(classes[index]);
  return isRead && columns[index] !== noTexel && rows[index] !== noTexel ? { x: columns[index], y: rows[index] } : null;
}

function texelWords(texel) {
  return texel === null ? "" : `at texel ${texel.x}, ${texel.y}`;
}

/** A bias as "1.1 mm (0.07 texels)"; depth units where lengths are not stored. */
function biasWords({ layers }, index, bias) {
  const length = layers.needed_bias_m?.[index];
  const texels = layers.needed_bias_texels?.[index];
  if (length === undefined || !Number.isFinite(length)) {
    return fewDigits(bias);
  }
  return Number.isFinite(texels) ? `${lengthWords(length)} (${fewDigits(texels)} texels)` : lengthWords(length);
}

const unscoredSentences = {
  background: "Background: the camera sees no surface here.",
  attached: "Not scored: this side of the surface faces away from the light.",
  out_of_light: "Not scored: the spot’s cone does not reach this surface.",
  indeterminate: "Not scored: the exact rays leave open whether this pixel is lit.",
};

function unscoredSentence({ layers }, index) {
  const name = classNames[layers.class[index]];
  if (name !== "unmatched") {
    return unscoredSentences[name];
  }
  return layers.prim?.[index] === noTriangle
    ? "Not scored: the exact ray hits a surface that GL does not draw here."
    : "Not scored: GL and the exact ray hit different triangles.";
}

/** What shadows a lit pixel, as far as its texel tells. */
function shadowWords(causes, index, bias) {
  const { image } = causes;
  const texel = texelOf(image, index);
  const nearer = nearerM(image, index);
  if (!(nearer > 0)) {
    return "";
  }
  const label = causes.hasOneTexel && image.layers.label !== undefined ? labelNames[causes.labelAt(index, bias)] : "";
  const subject = { acne: "its own surface", edge: "another surface" }[label] ?? "a surface";
  const place = texel === null ? "" : `, ${texelWords(texel)},`;
  return `: ${subject}${place} is ${lengthWords(nearer)} nearer`;
}

function falseShadowSentence(causes, index, bias) {
  const { image } = causes;
  const start = `Lit, but shadowed${shadowWords(causes, index, bias)}`;
  const critical = image.layers.critical_bias?.[index];
  if (critical === undefined) {
    return `${start}.`;
  }
  return critical === Infinity
    ? `${start}; no bias frees it.`
    : `${start}; a bias of ${biasWords(image, index, critical)} frees it.`;
}

/** What the map has of the blocker of a pixel in shadow. */
function missedWords(causes, index) {
  const { image } = causes;
  const texel = texelOf(image, index);
  const nearer = nearerM(image, index);
  if (Number.isNaN(nearer)) {
    return "";
  }
  if (nearer <= 0) {
    return texel === null ? ": its texel holds nothing nearer" : `: texel ${texel.x}, ${texel.y} holds nothing nearer`;
  }
  const place = texel === null ? "" : `, ${texelWords(texel)},`;
  return `: a surface${place} is ${causes.hasOneTexel ? "only " : ""}${lengthWords(nearer)} nearer`;
}

/** Up to which bias a pixel stays in shadow; "" where that is not known. */
function keptWords(image, index) {
  const critical = image.layers.critical_bias?.[index];
  if (critical === undefined || critical === Infinity) {
    return "";
  }
  if (critical === -Infinity) {
    return "; no bias shadows it";
  }
  const allowed = neededBias(classBlocked, critical);
  return allowed < 0
    ? "; even a bias of 0 leaves it lit"
    : `; a bias of at most ${biasWords(image, index, allowed)} keeps the shadow`;
}

function litSentence({ layers }, index) {
  const critical = layers.critical_bias?.[index];
  const needs = critical > 0 ? ` It needs a bias of ${biasWords({ layers }, index, critical)}.` : "";
  return `Lit, and drawn lit.${needs}`;
}

function blockedSentence({ layers }, index) {
  const critical = layers.critical_bias?.[index];
  const allowed = critical === undefined ? -1 : neededBias(classBlocked, critical);
  const isTold = allowed >= 0 && Number.isFinite(allowed);
  const most = isTold ? ` A bias of more than ${biasWords({ layers }, index, allowed)} lights it.` : "";
  return `In shadow, and drawn in shadow.${most}`;
}

/**
 * What happened to a pixel at a float32 bias.
 * @param {ErrorCauses} causes
 * @return {string}  a sentence, of right pixels with a second one of the bias
 */
function pixelSentence(causes, index, bias) {
  const { image } = causes;
  const pixelClass = image.layers.class[index];
  if (!isScored(pixelClass)) {
    return unscoredSentence(image, index);
  }
  const isWrong = image.isWrongAt(index, bias);
  if (pixelClass === classLit) {
    return isWrong ? falseShadowSentence(causes, index, bias) : litSentence(image, index);
  }
  return isWrong
    ? `In shadow, but lit${missedWords(causes, index)}${keptWords(image, index)}.`
    : blockedSentence(image, index);
}
