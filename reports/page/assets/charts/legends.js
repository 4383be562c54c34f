// Legends in HTML: swatches for categories, a ramp with ticks for fixed scales.

/** A small square of a colour. */
function swatchElement(colour) {
  const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
  swatch.style.backgroundColor = colour;
  return swatch;
}

/** @param {{name: string, colour: ?string, className: ?string}[]} entries  a class of the style for one without colour */
function swatchLegend(entries) {
  const items = entries.map(({ name, colour, className }) => {
    const classed = () => element("span", { class: `swatch ${className}`, "aria-hidden": "true" });
    return element("li", {}, colour === undefined ? classed() : swatchElement(colour), name);
  });
  return element("ul", { class: "swatches" }, ...items);
}

/** The ticks of a scale that have room: 0 first, then from the ends inwards. */
function spacedTicks(scale) {
  const ticks = scale.layout.ticks(scale.low, scale.high);
  const placed = [];
  for (const value of ticks.sort((a, b) => (a === 0 ? -1 : b === 0 ? 1 : Math.abs(b) - Math.abs(a)))) {
    const share = shareOnScale(scale, value);
    if (placed.every((other) => Math.abs(shareOnScale(scale, other) - share) >= 0.1)) {
      placed.push(value);
    }
  }
  return placed;
}

/**
 * @param {ColourScale} scale
 * @param {{low: string, high: string}} ends  what the two ends mean, may be empty
 */
function rampLegend(scale, ends) {
  const ramp = element("div", { class: "ramp", "aria-hidden": "true" });
  const colours = Array.from({ length: 33 }, (_, i) => cssColour(mixStops(scale.stops, i / 32)));
  ramp.style.backgroundImage = `linear-gradient(to right, ${colours.join(", ")})`;
  const ticks = element("div", { class: "ramp-ticks", "aria-hidden": "true" });
  for (const value of spacedTicks(scale)) {
    const tick = element("span", { text: scale.layout.format(value) });
    tick.style.left = `${100 * shareOnScale(scale, value)}%`;
    ticks.append(tick);
  }
  const words = element(
    "p",
    { class: "ramp-ends" },
    element("span", { text: ends.low }),
    element("span", { text: scale.unit }),
    element("span", { text: ends.high }),
  );
  const format = (value) => `${scale.layout.format(value)} ${scale.unit}`;
  const said = `Colour scale from ${format(scale.low)} to ${format(scale.high)}`;
  return element("div", { class: "ramp-legend", role: "img", "aria-label": said }, ramp, ticks, words);
}
