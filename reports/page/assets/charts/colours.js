// Colours that any colour vision can tell apart: Okabe and Ito's, and for names of errors some of Tol's beside
// them. The same for a thing everywhere.

const okabeIto = {
  black: "#000000",
  orange: "#E69F00",
  sky: "#56B4E9",
  green: "#009E73",
  yellow: "#F0E442",
  blue: "#0072B2",
  vermilion: "#D55E00",
  purple: "#CC79A7",
};

/** As in the pictures of `gnomon compare --picture`. */
const errorColours = {
  falseShadow: okabeIto.vermilion,
  falseLit: okabeIto.blue,
  unmatched: okabeIto.purple,
  indeterminate: okabeIto.black,
};
/** As in the figures and in `--heat-map`. */
const causeColours = {
  bias: okabeIto.orange,
  precision: okabeIto.green,
  resolution: okabeIto.sky,
  coverage: okabeIto.purple,
  filter: okabeIto.blue,
};
/** As in `--heat-map`; none is that of a cause. */
const labelColours = {
  acne: okabeIto.vermilion,
  peter_panning: "#332288",
  leak: okabeIto.black,
  edge: "#882255",
  overshadow: okabeIto.yellow,
  bleed: "#8C8C8C",
};
const classColours = {
  background: "#E4E9F0",
  unmatched: okabeIto.purple,
  attached: "#5B6068",
  out_of_light: okabeIto.sky,
  indeterminate: okabeIto.black,
  lit: okabeIto.yellow,
  blocked: okabeIto.blue,
};
/**
 * Of a light's several maps, by their place: Tol's light scheme, made for areas. None means anything else, and
 * neighbours differ in lightness or in hue for any colour vision.
 */
const mapColours = ["#77AADD", "#EE8866", "#EEDD88", "#FFAABB", "#99DDFF", "#44BB99", "#BBCC33", "#AAAA00"];
const noValueColour = "#E9E9E7";

// From blue over white to vermilion, and from dark to light: both change in lightness all the way.
const divergingStops = [
  "#08306B",
  "#0072B2",
  "#6BAED6",
  "#C6DBEF",
  "#FAFAF8",
  "#FBD3B4",
  "#F09A5C",
  "#D55E00",
  "#7A2E00",
];
const sequentialStops = [
  "#00224E",
  "#123570",
  "#3B496C",
  "#575D6D",
  "#707173",
  "#8A8678",
  "#A59C74",
  "#C3B369",
  "#E1CC55",
  "#FEE838",
];
const errorStops = ["#FFFFF8", "#FEE6B8", "#FDBE6F", "#F08A3C", "#D55E00", "#9C3A00", "#5A1E00"];

/** @return {number[]}  red, green, blue of "#RRGGBB", 0 to 255 */
function channels(colour) {
  return [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
}

/** @return {number[]}  the colour of evenly spaced stops at `share`, 0 to 1 */
function mixStops(stops, share) {
  const place = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const first = Math.min(Math.floor(place), stops.length - 2);
  const [a, b] = [channels(stops[first]), channels(stops[first + 1])];
  return a.map((value, i) => Math.round(value + (b[i] - value) * (place - first)));
}

/** @return {string}  for CSS */
function cssColour([red, green, blue]) {
  return `rgb(${red}, ${green}, ${blue})`;
}

const isLittleEndian = new Uint8Array(Uint32Array.of(1).buffer)[0] === 1;

/** @return {number}  a colour as a pixel of ImageData seen as uint32 */
function packedColour([red, green, blue]) {
  const packed = isLittleEndian
    ? (255 << 24) | (blue << 16) | (green << 8) | red
    : (red << 24) | (green << 16) | (blue << 8) | 255;
  return packed >>> 0;
}

/**
 * A fixed, named colour scale, the same for every image.
 * @typedef {{layout: Layout, low: number, high: number, stops: string[], unit: string}} ColourScale
 */

/** Texels, logarithmic beyond 0.01, from −100 to 100. */
const texelScale = {
  layout: symlogLayout(0.01),
  low: -100,
  high: 100,
  stops: divergingStops,
  unit: "texels",
};
/** Depth errors in metres, logarithmic beyond 1 µm, from −1 m to 1 m. */
const depthErrorScale = { layout: symlogLayout(1e-6), low: -1, high: 1, stops: divergingStops, unit: "m" };
/** Error rates, logarithmic beyond 0.001 %. */
const rateScale = { layout: rateLayout(), low: 0, high: 1, stops: errorStops, unit: "" };

/**
 * Distances between the planes of the shadow map, of several between the nearest and the farthest.
 * @param {?object[]} maps  "by_map" of `gnomon compare --json`
 */
function distanceScale(frustum, maps) {
  const planes = maps?.length ? maps : [frustum];
  return {
    layout: linearLayout(),
    low: Math.min(...planes.map(({ near_m: nearM }) => nearM)),
    high: Math.max(...planes.map(({ far_m: farM }) => farM)),
    stops: sequentialStops,
    unit: "m",
  };
}

/** @return {number}  where a value stands on a colour scale, 0 to 1 */
function shareOnScale(scale, value) {
  const { forward } = scale.layout;
  const low = forward(scale.low);
  return Math.min(1, Math.max(0, (forward(value) - low) / (forward(scale.high) - low)));
}
