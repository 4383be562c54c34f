// The numbers of one pixel, in a definition list.

/** A float32 with all its digits, or a dash. */
function exact(value) {
  return value === undefined || Number.isNaN(value) ? noValue : shortestFloat32(value);
}

/** A length, its exact digits or as many as it is known to. */
function lengthText(value, format) {
  return value === undefined || Number.isNaN(value) ? noValue : `${format(value)} ${sceneUnit()}`;
}

function indexText(value, none) {
  return value === undefined || value === none ? noValue : String(value);
}

function truthText(pixelClass) {
  const others = pixelClass === classBackground ? noValue : "not scored";
  return { [classLit]: "lit", [classBlocked]: "blocked" }[pixelClass] ?? others;
}

/** The pixel's verdict at the bias, and what is wrong with it; of the background there is none. */
function verdictText(image, index, bias) {
  if (image.layers.class[index] === classBackground) {
    return noValue;
  }
  const isLit = image.isShownLit(index, bias);
  const pixelClass = image.layers.class[index];
  const wrong = { [`${classLit}${false}`]: ", false shadow", [`${classBlocked}${true}`]: ", false lit" };
  return (isLit ? "lit" : "shadowed") + (wrong[`${pixelClass}${isLit}`] ?? "");
}

/** Which of a light's several maps the pixel reads; no fact where it has one. */
function mapFacts({ layers, detail }, index) {
  const { map_index: maps } = layers;
  if (maps === undefined || !detail.by_map) {
    return [];
  }
  const title = areCascades(detail.by_map) ? "Cascade" : "Map";
  return [["map", title, maps[index] === noMap ? noValue : mapTitle(detail.by_map[maps[index]])]];
}

/**
 * @param {PixelImage} image
 * @param {number} index  of the pixel, row by row
 * @param {number} bias  the slider's, float32
 * @return {[string, string, string][]}  key, title and text of each number
 */
function pixelFacts(image, index, bias) {
  const { layers } = image;
  const value = (name) => layers[name]?.[index];
  const pixelClass = value("class");
  const critical = value("critical_bias");
  const needs = pixelClass === classBlocked ? "Allowed bias" : "Needed bias";
  const object = value("object");
  const name = (names, code) =>
    code === undefined || !isScored(pixelClass) ? noValue : spoken(names[code]);
  return [
    ["class", "Class", spoken(classNames[pixelClass])],
    ["truth", "Truth", truthText(pixelClass)],
    ["shown", image.hasCurve ? "Verdict (slider’s bias)" : "Verdict", verdictText(image, index, bias)],
    ["verdict", "Verdict (job’s bias)", pixelClass === classBackground ? noValue : exact(value("verdict"))],
    ...mapFacts(image, index),
    ["receiver_depth", "Receiver depth r", exact(value("receiver_depth"))],
    ["map_depth", "Map depth d", exact(value("map_depth"))],
    ["critical_bias", "Critical bias", exact(critical)],
    ["needed_bias", needs, critical === undefined ? noValue : exact(neededBias(pixelClass, critical))],
    ["needed_bias_m", `${needs} [${sceneUnit()}]`, exact(value("needed_bias_m"))],
    ["needed_bias_texels", `${needs} [texels]`, exact(value("needed_bias_texels"))],
    ["cause", "Cause (job’s bias)", name(causeNames, value("cause"))],
    ["label", "Name (job’s bias)", name(labelNames, value("label"))],
    ["object", "Object", object === undefined || object === noObject ? noValue : image.objects[object]],
    ["prim", "Triangle", indexText(value("prim"), noTriangle)],
    ["witness", "Witness (a blocking triangle)", indexText(value("witness"), noTriangle)],
    ["light_distance_m", "Light distance", lengthText(value("light_distance_m"), shortestFloat32)],
    ["map_error_m", "Depth error", lengthText(value("map_error_m"), readable)],
  ];
}

/** Where a pixel of the page is in the image that was measured. */
function imagePlace({ step }, { x, y }) {
  return [step * x, step * y];
}

/** The list of a pixel's numbers; `show` fills it. */
class PixelDetails {
  constructor() {
    this.heading = element("h3", { text: "Pixel" });
    this.list = element("dl", { class: "facts" });
    this.hint = element("p", {
      class: "hint screen",
      text: "Point at a pixel, or move the cursor with the arrow keys. Click or tap to pin it. Zoom with Ctrl and the wheel.",
    });
    this.said = element("p", { class: "visually-hidden", role: "status" });
    this.root = element("div", { class: "pixel" }, this.heading, this.hint, this.list, this.said);
    this.entries = new Map();
  }

  /**
   * @param {PixelImage} image
   * @param {?{x: number, y: number}} pixel
   * @param {number} bias
   * @param {boolean} isPinned
   */
  show(image, pixel, bias, isPinned) {
    this.hint.hidden = pixel !== null;
    this.list.hidden = pixel === null;
    if (pixel === null) {
      this.heading.textContent = "Pixel";
      return;
    }
    const [x, y] = imagePlace(image, pixel);
    this.heading.textContent = `Pixel ${x}, ${y}${isPinned ? " (pinned)" : ""}`;
    const facts = pixelFacts(image, pixel.y * image.width + pixel.x, bias);
    this.keepKeys(facts.map(([key]) => key).join(" "));
    for (const [key, title, text] of [["x", "x", String(x)], ["y", "y", String(y)], ...facts]) {
      this.set(key, title, text);
    }
  }

  /** Empties the list where the image that is shown has other facts than the one before. */
  keepKeys(keys) {
    if (this.keys !== keys) {
      this.keys = keys;
      this.entries.clear();
      this.list.replaceChildren();
    }
  }

  set(key, title, text) {
    if (!this.entries.has(key)) {
      const made = { title: element("dt"), text: element("dd", { "data-key": key, class: "name" }) };
      this.entries.set(key, made);
      this.list.append(element("div", { class: `fact fact-${key}` }, made.title, made.text));
    }
    const entry = this.entries.get(key);
    entry.title.textContent = title;
    entry.text.textContent = text;
    entry.text.title = text.length > 24 ? text.slice(0, 1000) : "";
  }

  /** Tells a screen reader what the keyboard's cursor stands on. */
  say(image, pixel, bias) {
    const facts = pixelFacts(image, pixel.y * image.width + pixel.x, bias);
    const told = facts.filter(([key]) => ["class", "shown", "critical_bias"].includes(key));
    this.said.textContent = [
      imagePlace(image, pixel).join(", "),
      ...told.map(([, title, text]) => `${title} ${text}`),
    ].join("; ");
  }
}
