// What happened to one pixel: a sentence, the texels around it, and its numbers.

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

/** A cause or name at the slider's bias, or a dash. */
function codeText(names, code, isWrong) {
  if (code === unknownCode) {
    return "known at the job’s bias only";
  }
  return isWrong ? spoken(names[code]) : noValue;
}

/** Cause and name at the slider's bias; no facts where the page knows no other bias than the job's, or no causes. */
function errorFacts(causes, index, bias) {
  const { image } = causes;
  if (!image.hasCurve || image.layers.cause === undefined) {
    return [];
  }
  const isWrong = image.isWrongAt(index, bias);
  return [
    ["cause_here", "Cause (slider’s bias)", codeText(causeNames, causes.causeAt(index, bias), isWrong)],
    ["label_here", "Name (slider’s bias)", codeText(labelNames, causes.labelAt(index, bias), isWrong)],
  ];
}

/** Column and row of the texel, counted from the map's lower left. */
function texelFacts(image, index) {
  if (image.layers.texel_x === undefined) {
    return [];
  }
  const texel = texelOf(image, index);
  return [["texel", "Texel", texel === null ? noValue : `${texel.x}, ${texel.y}`]];
}

/**
 * @param {ErrorCauses} causes
 * @param {number} index  of the pixel, row by row
 * @param {number} bias  the slider's, float32
 * @return {[string, string, string][]}  key, title and text of each number
 */
function pixelFacts(causes, index, bias) {
  const { image } = causes;
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
    ...texelFacts(image, index),
    ["receiver_depth", "Receiver depth r", exact(value("receiver_depth"))],
    ["map_depth", "Map depth d", exact(value("map_depth"))],
    ["critical_bias", "Critical bias", exact(critical)],
    ["needed_bias", needs, critical === undefined ? noValue : exact(neededBias(pixelClass, critical))],
    ["needed_bias_m", `${needs} [${sceneUnit()}]`, exact(value("needed_bias_m"))],
    ["needed_bias_texels", `${needs} [texels]`, exact(value("needed_bias_texels"))],
    ["cause", "Cause (job’s bias)", name(causeNames, value("cause"))],
    ["label", "Name (job’s bias)", name(labelNames, value("label"))],
    ...errorFacts(causes, index, bias),
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

/** The card of a pixel; `show` fills it. */
class PixelDetails {
  constructor() {
    this.heading = element("h3", { text: "Pixel" });
    this.sentence = element("p", { class: "sentence", hidden: true });
    this.texels = new TexelPicture();
    this.list = element("dl", { class: "facts" });
    this.numbers = element("details", { class: "all-numbers" }, element("summary", { text: "All numbers" }), this.list);
    this.hint = element("p", {
      class: "hint screen",
      text: "Point at a pixel, or move the cursor with the arrow keys. Click or tap to pin it.",
    });
    this.said = element("p", { class: "visually-hidden", role: "status" });
    this.root = element(
      "div",
      { class: "pixel" },
      this.heading,
      this.hint,
      this.sentence,
      this.texels.root,
      this.numbers,
      this.said,
    );
    this.entries = new Map();
    this.showNothing();
  }

  showNothing() {
    this.heading.textContent = "Pixel";
    this.hint.hidden = false;
    for (const part of [this.sentence, this.texels.root, this.numbers]) {
      part.hidden = true;
    }
  }

  /**
   * @param {ErrorCauses} causes
   * @param {?{x: number, y: number}} pixel
   * @param {number} bias
   * @param {boolean} isPinned
   */
  show(causes, pixel, bias, isPinned) {
    if (pixel === null) {
      this.showNothing();
      return;
    }
    const { image } = causes;
    const index = pixel.y * image.width + pixel.x;
    const [x, y] = imagePlace(image, pixel);
    this.heading.textContent = `Pixel ${x}, ${y}${isPinned ? " (pinned)" : ""}`;
    this.hint.hidden = true;
    this.sentence.hidden = false;
    this.sentence.textContent = pixelSentence(causes, index, bias);
    this.texels.show(causes, index, bias);
    this.numbers.hidden = false;
    this.showFacts([["x", "x", String(x)], ["y", "y", String(y)], ...pixelFacts(causes, index, bias)]);
  }

  /** Fills the list, anew where the image that is shown has other facts than the one before. */
  showFacts(facts) {
    const keys = facts.map(([key]) => key).join(" ");
    if (this.keys !== keys) {
      this.keys = keys;
      this.entries.clear();
      this.list.replaceChildren();
    }
    for (const [key, title, text] of facts) {
      this.set(key, title, text);
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
  say(causes, pixel, bias) {
    const { image } = causes;
    const sentence = pixelSentence(causes, pixel.y * image.width + pixel.x, bias);
    this.said.textContent = `${imagePlace(image, pixel).join(", ")}: ${sentence}`;
  }
}
