// The layers that the inspector shows: each paints packed colours, one a pixel.

const jobBiasNote = "at the job’s bias";

/** 256 packed colours of a scale, code 0 for no value. */
function scalePalette(scale) {
  const palette = new Uint32Array(256).fill(packedColour(channels(noValueColour)));
  for (let code = 1; code < 256; ++code) {
    palette[code] = packedColour(mixStops(scale.stops, (code - 1) / 254));
  }
  return palette;
}

/** The packed colour of each value, or of none; (pixels). */
function scaleColours(scale, values) {
  const palette = scalePalette(scale);
  const { forward } = scale.layout;
  const low = forward(scale.low);
  const factor = 254 / (forward(scale.high) - low);
  const colours = new Uint32Array(values.length);
  for (let i = 0; i < colours.length; ++i) {
    const place = Math.min(254, Math.max(0, (forward(values[i]) - low) * factor));
    colours[i] = palette[Number.isNaN(place) ? 0 : 1 + Math.round(place)];
  }
  return colours;
}

/** A layer whose colours do not follow the slider: they are made when it is first shown. */
function stillLayer({ id, title, note, legend }, makeColours) {
  let colours = null;
  const paint = (packed) => {
    colours ??= makeColours();
    packed.set(colours);
  };
  return { id, title, note, legend, paint, followsBias: false };
}

function surfaceLegend() {
  return swatchLegend([
    { name: "lit", colour: legendColours.lit },
    { name: "in shadow, or turned from the light", colour: legendColours.shadowed },
    { name: "background", colour: legendColours.background },
  ]);
}

/** What the shadow map shows, at the slider's bias. */
function glLayer(image, scene) {
  return {
    id: "gl",
    title: image.detail?.evaluate ? `Shadows of ${image.detail.evaluate.renderer}` : "GL’s shadows",
    note: image.hasCurve ? "at the slider’s bias" : jobBiasNote,
    followsBias: true,
    legend: surfaceLegend,
    paint: (packed, bias) => {
      const { litFrom } = image;
      for (let i = 0; i < packed.length; ++i) {
        packed[i] = litFrom[i] <= bias ? scene.lit[i] : scene.shadowed[i];
      }
    },
  };
}

function classLayer(image) {
  const palette = classNames.map((name) => packedColour(channels(classColours[name])));
  const legend = () =>
    swatchLegend(classNames.map((name) => ({ name: spoken(name), colour: classColours[name] })));
  return stillLayer({ id: "class", title: "Class of each pixel", note: "of the truth", legend }, () =>
    Uint32Array.from(image.layers.class, (pixelClass) => palette[pixelClass]),
  );
}

/** Which of a light's several maps each pixel reads, over the shaded truth; none where it has one. */
function mapLayers(image, scene) {
  const { map_index: maps } = image.layers;
  const { by_map: facts } = image.detail;
  if (maps === undefined || !facts) {
    return [];
  }
  const colours = Object.values(mapColoursByName(facts));
  const legend = () =>
    swatchLegend([
      ...facts.map((map, i) => ({ name: mapTitle(map), colour: colours[i] })),
      { name: "not compared", colour: legendColours.faded },
    ]);
  const note = areCascades(facts) ? "the cascade that a pixel reads, by view depth" : "the one that a pixel reads";
  return [
    stillLayer({ id: "maps", title: "Maps", note, legend }, () => {
      const lit = colours.map((colour) => packedColour(channels(colour)));
      const dark = colours.map((colour) => packedColour(shadedColour(channels(colour))));
      const classes = image.layers.class;
      return scene.faded.map((faded, i) =>
        maps[i] === noMap ? faded : (classes[i] === classLit ? lit : dark)[maps[i]],
      );
    }),
  ];
}

/** Shares of a filter's taps. */
const verdictScale = {
  layout: linearLayout(),
  low: 0,
  high: 1,
  stops: ["#2B2F36", "#EFE7D6"],
  unit: "lit share",
};

/** How far a verdict is off: below 0 it lacks light, above it has too much. */
const amountScale = {
  layout: linearLayout(),
  low: -1,
  high: 1,
  stops: [errorColours.falseShadow, "#EDEDED", errorColours.falseLit],
  unit: "verdict minus truth",
};

/**
 * Verdict minus truth of the scored pixels, NaN elsewhere; (pixels).
 * @return {?Float32Array}  undefined where every verdict is 0 or 1: the errors say it
 */
function verdictErrors({ class: classes, verdict }) {
  if (verdict.every((value) => value === 0 || value === 1)) {
    return undefined;
  }
  return verdict.map((value, i) => (isScored(classes[i]) ? value - (classes[i] === classLit ? 1 : 0) : NaN));
}

/** What each layer of numbers is; its values are undefined where the image lacks them. */
function numberLayerSpecs({ layers, frustum, filter, detail }) {
  return [
    {
      id: "needed",
      values: layers.needed_bias_texels,
      title: "Needed bias",
      note: "lit pixels need it, blocked ones allow up to it",
      scale: texelScale,
      ends: { low: "less", high: "more" },
    },
    {
      id: "depth_error",
      values: layers.map_error_m,
      title: "Depth error",
      note: "stored minus exact depth",
      scale: depthErrorScale,
      ends: { low: "stored too near", high: "too far" },
    },
    {
      id: "distance",
      values: layers.light_distance_m,
      title: "Light distance",
      note: "of the receiver",
      scale: distanceScale(frustum, detail.by_map),
      ends: detail.by_map
        ? { low: "the maps’ nearest plane", high: "farthest plane" }
        : { low: "the map’s near plane", high: "far plane" },
    },
    {
      id: "amount",
      values: verdictErrors(layers),
      title: "Amount of error",
      note: jobBiasNote,
      scale: amountScale,
      ends: { low: "dark where lit", high: "lit where blocked" },
    },
    {
      id: "verdict",
      values: filter === "nearest" ? undefined : layers.verdict,
      title: "Filtered verdict",
      note: jobBiasNote,
      scale: verdictScale,
      ends: { low: "", high: "" },
    },
  ];
}

/** Layers of numbers on fixed scales. */
function numberLayers(image) {
  return numberLayerSpecs(image)
    .filter(({ values }) => values !== undefined)
    .map((layer) =>
      stillLayer({ ...layer, legend: () => rampLegend(layer.scale, layer.ends) }, () =>
        scaleColours(layer.scale, layer.values),
      ),
    );
}

/**
 * @param {PixelImage} image
 * @param {ErrorCauses} causes
 * @return {object[]}  layers: id, title, note, followsBias, marksErrors, paint(packed (pixels), bias, growth), legend()
 */
function imageLayers(image, causes) {
  const scene = new ShadedScene(image);
  return [
    glLayer(image, scene),
    stillLayer(
      { id: "truth", title: "Truth", note: "shadow rays", legend: surfaceLegend },
      () => scene.truth,
    ),
    errorLayer(image, scene),
    ...codeLayers(image, scene, causes),
    ...numberLayers(image),
    ...mapLayers(image, scene),
    classLayer(image),
  ];
}

/**
 * The shadows and the errors of an earlier run, at its own bias.
 * @param {?PixelImage} earlier  null without one
 * @param {PixelImage} image  the one that is shown; none of the layers fit another size
 */
function earlierLayers(earlier, image) {
  if (earlier === null || ["width", "height", "step"].some((name) => earlier[name] !== image[name])) {
    return [];
  }
  return imageLayers(earlier, new ErrorCauses(earlier))
    .filter(({ id }) => ["gl", "truth", "errors"].includes(id))
    .map((layer) =>
      Object.assign(Object.create(layer), {
        id: `earlier-${layer.id}`,
        title: `Before: ${layer.title}`,
        note: "of the earlier run, at its own bias",
        followsBias: false,
        legend: () => layer.legend(),
        paint: (packed, _, growth) => layer.paint(packed, earlier.jobBias, growth),
      }),
    );
}
