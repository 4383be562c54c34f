// Charts over bins: errors by distance and by angle, depth error by distance with the formula's envelope.

const middleOf = (bin) => (bin.lower + bin.upper) / 2;

/** A series over bins; bins without the value are gaps. */
function binSeries(name, colour, bins, valueOf, more = {}) {
  return {
    name,
    colour,
    points: bins.map((bin) => [middleOf(bin), valueOf(bin) ?? null]),
    radius: 2,
    ...more,
  };
}

/** The largest of the values that exist, else 0. */
function largestOf(values) {
  return values.reduce((most, value) => Math.max(most, value ?? 0), 0);
}

/** Where a rate is largest, in words. */
function worstBin(bins, valueOf, unit) {
  const worst = bins.reduce((a, b) => ((valueOf(b) ?? -1) > (valueOf(a) ?? -1) ? b : a), bins[0]);
  return `${percent(valueOf(worst) ?? 0)} at ${readable(middleOf(worst))} ${unit}`;
}

function rateChart(host, title, bins, x) {
  return new PageChart(host, {
    title,
    summary:
      `Largest false-shadow rate ${worstBin(bins, (bin) => bin.falseShadowRate, x.unit)}, ` +
      `largest false-lit rate ${worstBin(bins, (bin) => bin.falseLitRate, x.unit)}.`,
    x,
    y: { label: "share of the bin’s lit or blocked pixels", layout: rateLayout(), low: 0, high: 1 },
    series: [
      binSeries("false shadow, of the lit", errorColours.falseShadow, bins, (bin) => bin.falseShadowRate),
      binSeries("false lit, of the blocked", errorColours.falseLit, bins, (bin) => bin.falseLitRate, {
        dash: [6, 3],
      }),
    ],
  });
}

/** The smallest and the largest bias that charts of these bins show; `low` is at most 0. */
function neededRange(bins) {
  const values = bins.flatMap(({ needed }) => [needed.p95, needed.median]).filter(Number.isFinite);
  return { low: Math.min(0, ...values), high: largestOf(values) };
}

function neededChart(host, title, bins, x, step, range = neededRange(bins)) {
  if (bins.every(({ needed }) => needed.p95 === null || needed.p95 === undefined)) {
    const text = "The bias that lit pixels need is not known: nothing tells of this lookup’s other biases.";
    host.replaceChildren(element("p", { class: "hint", text }));
    return null;
  }
  const largest = largestOf(bins.flatMap(({ needed }) => [needed.p95, needed.median]));
  return new PageChart(host, {
    title,
    summary: `95 % of a bin’s lit pixels need a bias of at most ${readable(largest)}.`,
    x,
    y: {
      label: "needed bias [depth units]",
      layout: symlogLayout(step),
      low: range.low,
      high: Math.max(range.high, step),
    },
    series: [
      binSeries("95th percentile", okabeIto.vermilion, bins, ({ needed }) => needed.p95),
      binSeries("median", okabeIto.black, bins, ({ needed }) => needed.median, { dash: [2, 3] }),
    ],
  });
}

/** The lines of the depth error, each in units of 1 m / factor. */
function depthErrorSeries(bins, factor) {
  const sized = (value) => (value === null || value === undefined ? null : factor * Math.abs(value));
  const beyond = (value) => (value === null || value === undefined ? null : factor * Math.max(0, value));
  const line = (name, colour, valueOf, dash) =>
    binSeries(name, colour, bins, ({ mapError }) => valueOf(mapError), { dash });
  return [
    line("most beyond", okabeIto.vermilion, ({ max }) => beyond(max), []),
    line("most before", okabeIto.blue, ({ min }) => (min === null ? null : beyond(-min)), [6, 3]),
    line("|95th percentile|", okabeIto.orange, ({ p95 }) => sized(p95), [8, 2, 2, 2]),
    line("|median|", okabeIto.black, ({ median }) => sized(median), [2, 3]),
  ];
}

/** The bins with an envelope, which a logarithmic axis can show. */
function binsWithEnvelope(bins) {
  return bins.filter(({ envelope }) => envelope !== null && envelope > 0);
}

/**
 * The scale of the depth errors of bins.
 * @return {{largest: number, envelope: number, smallest: number}}  the largest error, and the largest and the
 *     smallest envelope [m]
 */
function depthErrorRange(bins) {
  const largest = largestOf(bins.flatMap(({ mapError: { min, max } }) => [-(min ?? 0), max]));
  const envelope = largestOf(bins.map((bin) => bin.envelope));
  const smallest = binsWithEnvelope(bins).reduce(
    (least, bin) => Math.min(least, bin.envelope),
    envelope || largest || 1,
  );
  return { largest, envelope, smallest };
}

/**
 * |stored − exact| depth over distance, above the envelope of the formula.
 * @param {object} range  of all bins that the axis has room for
 */
function depthErrorChart(host, bins, x, range) {
  const { largest, envelope } = depthErrorRange(bins);
  const [factor, unit] = lengthUnit(range.largest || 1);
  const withEnvelope = binsWithEnvelope(bins);
  const band = {
    name: "the formula’s envelope: storage alone",
    colour: okabeIto.green,
    points: withEnvelope.map((bin) => [middleOf(bin), 0, factor * bin.envelope]),
  };
  return new PageChart(host, {
    title: "Depth error by light distance",
    summary:
      `Largest depth error ${readable(factor * largest)} ${unit}; ` +
      `storing depths alone accounts for at most ${readable(factor * envelope)} ${unit}.`,
    x,
    y: {
      label: `|stored − exact depth| [${unit}]`,
      layout: symlogLayout(10 ** Math.floor(Math.log10(factor * range.smallest))),
      low: 0,
      high: factor * Math.max(range.largest, range.envelope, range.smallest),
    },
    series: depthErrorSeries(bins, factor),
    bands: withEnvelope.length === 0 ? [] : [band],
  });
}

function distanceAxis(bins) {
  return {
    label: `distance ζ from the light’s camera plane [${sceneUnit()}]`,
    name: `distance [${sceneUnit()}]`,
    unit: sceneUnit(),
    layout: linearLayout(),
    low: bins.reduce((least, { lower }) => Math.min(least, lower), Infinity),
    high: largestOf(bins.map(({ upper }) => upper)),
  };
}

/** Bins by angle in degrees: radians are for the program. */
function inDegrees(bins) {
  const degrees = (angleRad) => Number(((angleRad * 180) / Math.PI).toPrecision(6));
  return bins.map((bin) => ({ ...bin, lower: degrees(bin.lower), upper: degrees(bin.upper) }));
}

function angleAxis() {
  return {
    label: "angle between receiver and light [°]",
    name: "angle [°]",
    unit: "°",
    layout: linearLayout((x) => `${readable(x)}°`),
    low: 0,
    high: 90,
  };
}

const ownDistancesAreMissing =
  "Errors by distance were not stored at this configuration’s own bias. These charts show the same shadow map at the best bias.";

/** Fills section#distance for a configuration. */
class DistanceCharts {
  constructor(section) {
    this.section = section;
  }

  /**
   * @param {?{bias: ?number, bins: Bin[]}} own  at the configuration's bias; null: not stored
   * @param {?{bias: number, bins: Bin[]}} best  at the best bias of its curve
   * @param {string} caption  of the configuration
   */
  show({ own, best }, caption) {
    const blocks = [
      ["own", "its own bias", own],
      ["best", "the best bias", best],
    ].filter(([, , block]) => block?.bins.length);
    this.section.hidden = blocks.length === 0;
    if (this.section.hidden) {
      return;
    }
    const hosts = [1, 2, 3].map(() => element("div", { class: "chart-host" }));
    // Every axis has one range for both biases, so that they compare.
    const all = blocks.flatMap(([, , { bins }]) => bins);
    const x = distanceAxis(all);
    const draw = (chosen) => {
      const [, where, { bias, bins }] = blocks.find(([id]) => id === chosen);
      const at = bias === null ? where : `${where}, ${readable(bias)}`;
      rateChart(hosts[0], `Errors by light distance, at ${at}`, bins, x);
      neededChart(hosts[1], "Bias that lit pixels need, by light distance", bins, x, 1e-6, neededRange(all));
      depthErrorChart(hosts[2], bins, x, depthErrorRange(all));
      dropDeadCharts();
    };
    const [[first]] = blocks;
    const select = choice(
      blocks.map(([id, where]) => [id, where]),
      first,
      draw,
    );
    refill(
      this.section,
      element("p", { class: "caption name", text: caption }),
      ...(first === "own" ? [] : [element("p", { class: "hint", text: ownDistancesAreMissing })]),
      element("div", { class: "bar" }, labelled("Errors at", select)),
      element("div", { class: "chart-grid" }, ...hosts),
    );
    draw(first);
  }
}

/** Fills section#slope for a configuration; hides it without bins. */
function showSlopeCharts(section, bins, caption) {
  section.hidden = !bins?.length;
  if (section.hidden) {
    return;
  }
  const hosts = [1, 2].map(() => element("div", { class: "chart-host" }));
  refill(
    section,
    element("p", { class: "caption name", text: caption }),
    element("div", { class: "chart-grid" }, ...hosts),
  );
  const degrees = inDegrees(bins);
  rateChart(hosts[0], "Errors by receiver angle, at its own bias", degrees, angleAxis());
  neededChart(hosts[1], "Bias that lit pixels need, by receiver angle", degrees, angleAxis(), 1e-6);
}
