// The shadow map's texels around a pixel, as far as the image's pixels read them.

/** How many texels the picture shows on each side of the pixel's own. */
const texelReach = 4;
const texelSide = 2 * texelReach + 1;
const texelPx = 16;

/** How a texel's depth compares with a receiver. */
const texelStates = [
  { name: "read by no pixel" },
  { name: "nearer by more than the bias", colour: okabeIto.vermilion },
  { name: "equal, within the bias", colour: "#EFE7D6" },
  { name: "farther", colour: okabeIto.sky },
];

/**
 * The depths of the texels around a pixel's own, from what the image's pixels read.
 * @return {?Float32Array}  (texelSide × texelSide) the map's upper rows first, NaN where no pixel reads a texel; null
 *     if a texel is not known, or if pixels read different depths from one, as interpolating lookups do
 */
function texelDepths(image, index) {
  const { texel_x: columns, texel_y: rows, map_depth: depths, map_index: maps, class: classes } = image.layers;
  const own = texelOf(image, index);
  if (own === null || !storesDepths(image) || Number.isNaN(depths[index])) {
    return null;
  }
  const found = new Float32Array(texelSide * texelSide).fill(NaN);
  for (let i = 0; i < columns.length; ++i) {
    const dx = columns[i] - own.x + texelReach;
    const dy = own.y - rows[i] + texelReach;
    const isNear = dx >= 0 && dx < texelSide && dy >= 0 && dy < texelSide;
    if (!isNear || !hasReceiver(classes[i]) || maps?.[i] !== maps?.[index] || Number.isNaN(depths[i])) {
      continue;
    }
    const place = dy * texelSide + dx;
    if (!Number.isNaN(found[place]) && found[place] !== depths[i]) {
      return null;
    }
    found[place] = depths[i];
  }
  return found;
}

/** What a bias of the slider is in the depths of the map that a pixel reads: metres are as long in all cascades. */
function biasScale({ layers, detail }, index) {
  const maps = detail?.by_map;
  if (layers.map_index === undefined || !maps || !areCascades(maps) || !("bias.constant_m" in detail.job)) {
    return 1;
  }
  const [first, own] = [maps[0], maps[layers.map_index[index]] ?? maps[0]];
  return (first.far_m - first.near_m) / (own.far_m - own.near_m);
}

/**
 * By how much a surface must be nearer than a pixel's receiver to shadow it [depth units of its map]: a single
 * comparison tells all that its lookup adds, of others this is the constant bias.
 */
function wholeBias(causes, index, bias) {
  const { critical_bias: criticals, receiver_depth: receivers, map_depth: depths } = causes.image.layers;
  const critical = criticals?.[index] ?? NaN;
  const scale = biasScale(causes.image, index);
  if (!causes.hasOneTexel || !Number.isFinite(critical)) {
    return scale * bias;
  }
  const above = receivers[index] - depths[index];
  return (causes.image.frustum.reversed ? -above : above) + scale * (bias - critical);
}

/**
 * How the texels around a pixel compare with its receiver, at a float32 bias.
 * @param {ErrorCauses} causes
 * @return {?Uint8Array}  (texelSide × texelSide) places in `texelStates`; null as `texelDepths`
 */
function texelStatesAround(causes, index, bias) {
  const { image } = causes;
  const depths = texelDepths(image, index);
  if (depths === null) {
    return null;
  }
  const receiver = image.layers.receiver_depth[index];
  const within = Math.abs(wholeBias(causes, index, bias));
  return Uint8Array.from(depths, (depth) => {
    const nearer = image.frustum.reversed ? depth - receiver : receiver - depth;
    return Number.isNaN(nearer) ? 0 : nearer > within ? 1 : nearer < -within ? 3 : 2;
  });
}

/** The picture of the texels around a pixel, with its legend. */
class TexelPicture {
  constructor() {
    this.canvas = element("canvas", { class: "texels-canvas", role: "img" });
    this.context = this.canvas.getContext("2d");
    this.legend = element("div", { class: "texels-legend" });
    this.root = element("div", { class: "texels" }, this.canvas, this.legend);
  }

  /**
   * @param {ErrorCauses} causes
   * @param {number} index  of the pixel
   * @param {number} bias  the slider's, float32
   */
  show(causes, index, bias) {
    const states = texelStatesAround(causes, index, bias);
    this.root.hidden = states === null;
    if (states === null) {
      return;
    }
    this.draw(states);
    const { x, y } = texelOf(causes.image, index);
    const counts = texelStates.map(({ name }, state) => `${states.filter((of) => of === state).length} ${name}`);
    this.canvas.setAttribute("aria-label", `Texels of the shadow map around ${x}, ${y}: ${counts.join("; ")}`);
    const entries = texelStates.slice(1).map(({ name, colour }) => ({ name, colour }));
    this.legend.replaceChildren(
      element("p", { text: `Around texel ${x}, ${y}` }),
      swatchLegend([...entries, { name: texelStates[0].name, className: "swatch-unread" }]),
    );
  }

  draw(states) {
    const { context, canvas } = this;
    const dense = window.devicePixelRatio || 1;
    canvas.width = Math.round(texelSide * texelPx * dense);
    canvas.height = canvas.width;
    context.setTransform(dense, 0, 0, dense, 0, 0);
    states.forEach((state, place) => {
      const left = (place % texelSide) * texelPx;
      const top = Math.floor(place / texelSide) * texelPx;
      if (state === 0) {
        this.hatch(left, top);
      } else {
        context.fillStyle = texelStates[state].colour;
        context.fillRect(left, top, texelPx - 1, texelPx - 1);
      }
    });
    const own = texelReach * texelPx;
    for (const [width, colour] of [
      [4, "#FFFFFF"],
      [2, "#000000"],
    ]) {
      context.lineWidth = width;
      context.strokeStyle = colour;
      context.strokeRect(own - 0.5, own - 0.5, texelPx, texelPx);
    }
  }

  hatch(left, top) {
    const { context } = this;
    const side = texelPx - 1;
    context.strokeStyle = themeColour("control");
    context.lineWidth = 1;
    context.beginPath();
    for (const from of [side / 3, (2 * side) / 3, side, (4 * side) / 3, (5 * side) / 3]) {
      context.moveTo(left + Math.min(from, side), top + Math.max(0, from - side));
      context.lineTo(left + Math.max(0, from - side), top + Math.min(from, side));
    }
    context.stroke();
  }
}
