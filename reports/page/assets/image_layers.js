// The layers that the inspector shows. A layer gives each pixel a code of 0 to 255, and each code a colour.

const litCode = 8;
const jobBiasNote = "at the job’s bias";

/** Class, and the verdict at a bias: class + 8 where it is lit; (pixels). */
function verdictCodes(image, bias, codes) {
  const { class: classes, critical_bias: criticals, verdict } = image.layers;
  if (criticals === undefined) {
    for (let i = 0; i < codes.length; ++i) {
      codes[i] = classes[i] | (verdict[i] >= 0.5 ? litCode : 0);
    }
    return codes;
  }
  for (let i = 0; i < codes.length; ++i) {
    // The critical bias of a pixel that is not scored is NaN, which no bias reaches.
    codes[i] = classes[i] | (criticals[i] <= bias ? litCode : 0);
  }
  return codes;
}

/** Codes 1 to 255 along a colour scale, 0 without a value; (pixels). */
function scaleCodes(scale, values) {
  const { forward } = scale.layout;
  const low = forward(scale.low);
  const factor = 254 / (forward(scale.high) - low);
  return Uint8Array.from(values, (value) => {
    if (Number.isNaN(value)) {
      return 0;
    }
    return 1 + Math.round(Math.min(254, Math.max(0, (forward(value) - low) * factor)));
  });
}

/** 256 packed colours from colours by code. */
function paletteOf(colours) {
  const palette = new Uint32Array(256).fill(packedColour(channels(noValueColour)));
  colours.forEach((colour, code) => {
    palette[code] = packedColour(channels(colour));
  });
  return palette;
}

/** The palette of a colour scale's codes. */
function scalePalette(scale) {
  const palette = new Uint32Array(256).fill(packedColour(channels(noValueColour)));
  for (let code = 1; code < 256; ++code) {
    palette[code] = packedColour(mixStops(scale.stops, (code - 1) / 254));
  }
  return palette;
}

/** Colours of verdictCodes: what each class looks like where it is shadowed and where it is lit. */
function verdictColours(colours, shadowedAs, litAs) {
  const ofClass = [colours.background, colours.outOfLight, colours.attached, colours.outOfLight,
    colours.outOfLight, colours.shadowed, colours.shadowed];
  const all = [...ofClass, colours.background, ...ofClass, colours.background];
  Object.entries(shadowedAs).forEach(([code, colour]) => { all[code] = colour; });
  Object.entries(litAs).forEach(([code, colour]) => { all[Number(code) + litCode] = colour; });
  return all;
}

function surfaceEntries(colours, lit, shadowed) {
  return [{ name: lit, colour: colours.lit }, { name: shadowed, colour: colours.shadowed },
    { name: "turned from the light", colour: colours.attached },
    { name: "not compared", colour: colours.outOfLight }, { name: "background", colour: colours.background }];
}

/** What the shadow map shows, at the slider's bias. */
function glLayer(image) {
  const { lit } = surfaceColours;
  return {
    id: "gl", title: "GL’s shadows", note: image.hasCurve ? "at the slider’s bias" : jobBiasNote, followsBias: true,
    codes: (bias, codes) => verdictCodes(image, bias, codes),
    palette: paletteOf(verdictColours(surfaceColours, {}, { 5: lit, 6: lit })),
    legend: () => swatchLegend(surfaceEntries(surfaceColours, "lit", "in shadow")),
  };
}

function truthLayer(image) {
  const { lit, shadowed } = surfaceColours;
  const palette = verdictColours(surfaceColours, { 5: lit, 6: shadowed }, {});
  return {
    id: "truth", title: "Truth", note: "shadow rays", codes: () => image.layers.class, palette: paletteOf(palette),
    legend: () => swatchLegend(surfaceEntries(surfaceColours, "lit", "in shadow")),
  };
}

function errorLayer(image) {
  const { falseShadow, falseLit, unmatched, indeterminate } = errorColours;
  const unscored = { 1: unmatched, 4: indeterminate };
  const colours = verdictColours(fadedColours, { ...unscored, 5: falseShadow },
    { ...unscored, 5: fadedColours.lit, 6: falseLit });
  return {
    id: "errors", title: "Errors", note: image.hasCurve ? "at the slider’s bias" : jobBiasNote, followsBias: true,
    codes: (bias, codes) => verdictCodes(image, bias, codes), palette: paletteOf(colours),
    legend: () => swatchLegend([
      { name: "false shadow", colour: falseShadow }, { name: "false lit", colour: falseLit },
      { name: "unmatched", colour: unmatched }, { name: "indeterminate", colour: indeterminate },
      { name: "right", colour: fadedColours.shadowed }]),
  };
}

/** A layer of categories, by the values 1, 2, … of `values`; others are shown faded. */
function categoryLayer(image, { id, title, names, colours, note }) {
  const faded = verdictColours(fadedColours, {}, {}).slice(0, litCode);
  faded[classLit] = fadedColours.lit;
  const marked = names.slice(1).map((name) => colours[name]);
  let codes = null;
  return {
    id, title, note, palette: paletteOf([...faded, ...marked]),
    codes: () => {
      codes ??= image.layers[id].map((value, i) => (value === 0 ? image.layers.class[i] : litCode + value - 1));
      return codes;
    },
    legend: () => swatchLegend([...names.slice(1).map((name) => ({ name: spoken(name), colour: colours[name] })),
      { name: "right or not compared", colour: fadedColours.shadowed }]),
  };
}

/** A layer of numbers on a fixed scale. */
function scaleLayer(image, { id, values, title, note, scale, ends }) {
  let codes = null;
  return {
    id, title, note, palette: scalePalette(scale),
    codes: () => {
      codes ??= scaleCodes(scale, values);
      return codes;
    },
    legend: () => rampLegend(scale, ends),
  };
}

function classLayer(image) {
  return {
    id: "class", title: "Class of each pixel", note: "of the truth", codes: () => image.layers.class,
    palette: paletteOf(classNames.map((name) => classColours[name])),
    legend: () => swatchLegend(classNames.map((name) => ({ name: spoken(name), colour: classColours[name] }))),
  };
}

function numberLayers(image) {
  const { layers, frustum } = image;
  const ends = { low: "", high: "" };
  const all = [
    { id: "needed", values: layers.needed_bias_texels, title: "Needed bias", scale: texelScale,
      note: "lit pixels need it, blocked ones allow up to it", ends: { low: "less", high: "more" } },
    { id: "depth_error", values: layers.map_error_m, title: "Depth error", scale: depthErrorScale,
      note: "stored minus exact depth", ends: { low: "stored too near", high: "too far" } },
    { id: "distance", values: layers.light_distance_m, title: "Light distance", scale: distanceScale(frustum),
      note: "of the receiver", ends: { low: "the map’s near plane", high: "far plane" } },
    { id: "verdict", values: image.filter === "nearest" ? undefined : layers.verdict, title: "Filtered verdict",
      note: jobBiasNote, scale: { layout: linearLayout(), low: 0, high: 1, stops: ["#2B2F36", "#EFE7D6"], unit: "lit share" }, ends },
  ];
  return all.filter(({ values }) => values !== undefined).map((layer) => scaleLayer(image, layer));
}

/**
 * @param {PixelImage} image
 * @return {object[]}  layers: id, title, note, codes(bias, scratch) → (pixels), palette (256), legend()
 */
function imageLayers(image) {
  const categories = [
    { id: "cause", title: "Causes of errors", names: causeNames, colours: causeColours, note: jobBiasNote },
    { id: "label", title: "Names of errors", names: labelNames, colours: labelColours, note: jobBiasNote },
  ].filter(({ id }) => image.layers[id] !== undefined);
  return [glLayer(image), truthLayer(image), errorLayer(image),
    ...categories.map((category) => categoryLayer(image, category)), ...numberLayers(image), classLayer(image)];
}
