// The bias slider: a range over the biases that matter, a field for any float32, and buttons.

/** Where a curve's limits are, and why there is none. */
function biasGoals(image) {
  const curve = image.detail.bias_curve;
  const [low, high] = curve.best_interval;
  const best = low === null ? high : high === null ? low : (low + high) / 2;
  return [
    { name: "Job’s bias", bias: image.jobBias, reason: "" },
    { name: "Best bias", bias: best, reason: "all biases are equally good" },
    {
      name: "Acne-free",
      bias: curve.acne_free,
      reason: "there is no acne, or no bias removes all of it",
    },
    {
      name: "Peter-panning-free",
      bias: curve.peter_panning_free ?? null,
      reason: "no bias, or every bias, detaches a shadow",
    },
  ];
}

/** What a bias, in depth units of the first cascade, is in each; a job's metres are as long in all of them. */
function cascadeLengths(maps, bias, isInMetres) {
  const rangeM = ({ near_m: nearM, far_m: farM }) => farM - nearM;
  if (isInMetres || maps.every((map) => rangeM(map) === rangeM(maps[0]))) {
    const lengthM = bias * rangeM(maps[0]);
    const texels = maps.map(({ texel_m: texelM }) => fewDigits(lengthM / texelM));
    const all = `${texels.slice(0, -1).join(", ")} and ${texels.at(-1)} texels`;
    return `${lengthWords(lengthM)} along the light, ${all} of the cascades`;
  }
  const lengths = maps.map((map) => {
    const lengthM = bias * rangeM(map);
    return `${lengthWords(lengthM)} (${fewDigits(lengthM / map.texel_m)} texels)`;
  });
  return `along the light ${lengths.slice(0, -1).join(", ")} and ${lengths.at(-1)} in the cascades`;
}

/** A bias in metres and texels; of a perspective light these depend on the distance. */
function biasLengths(image, bias) {
  const { frustum } = image;
  const { by_map: maps, job } = image.detail;
  if (maps && areCascades(maps)) {
    return cascadeLengths(maps, bias, "bias.constant_m" in job);
  }
  if (frustum.projection === "perspective") {
    const lightDistanceM = image.medianDistanceM;
    const lengthM = biasLengthM(frustum, bias, lightDistanceM);
    const texels = fewDigits(lengthM / texelWidthM(frustum, lightDistanceM));
    const distance = `${lengthWords(lightDistanceM)} from the light, the pixels’ median distance`;
    return `${lengthWords(lengthM)} or ${texels} texels at ${distance}`;
  }
  const lengthM = biasLengthM(frustum, bias, 0);
  return `${lengthWords(lengthM)} along the light, ${fewDigits(lengthM / texelWidthM(frustum, 0))} texels`;
}

/** The slider of one image with a bias curve; calls onBias(float32) whenever the bias changes. */
class BiasSlider {
  constructor(image, onBias) {
    this.image = image;
    this.onBias = onBias;
    this.scale = new SliderScale(image.depthStep?.step ?? 2 ** -24, image.counts.finiteRange);
    this.range = element("input", {
      type: "range",
      min: this.scale.lowestPosition,
      max: this.scale.highestPosition,
      step: 1,
      class: "bias-range",
      on: { input: () => this.setBias(this.scale.biasAt(Number(this.range.value)), this.range) },
    });
    this.field = element("input", {
      type: "text",
      inputmode: "text",
      autocomplete: "off",
      spellcheck: "false",
      class: "bias-field",
      on: { change: () => this.readField(), keydown: (event) => event.key === "Enter" && this.readField() },
    });
    this.problem = element("p", {
      class: "problem",
      role: "alert",
      hidden: true,
      text: "Enter a number that a float32 can hold, such as 0.0012 or -3e-5.",
    });
    this.lengths = element("p", { class: "hint" });
    this.root = this.layOut();
  }

  layOut() {
    const goals = biasGoals(this.image).map((goal) => this.goalButton(goal));
    const range = labelled("Constant bias", this.range, "control grow");
    return element(
      "div",
      { class: "bias" },
      element("div", { class: "bias-row" }, range, labelled("Exactly", this.field)),
      element("div", { class: "bias-goals" }, element("div", { class: "buttons" }, ...goals), this.lengths),
      this.problem,
    );
  }

  goalButton({ name, bias, reason }) {
    const exists = bias !== null;
    const made = button(name, () => this.setBias(bias), {
      title: exists ? `${shortestFloat32(Math.fround(bias))}` : `None: ${reason}`,
    });
    if (!exists) {
      made.disabled = true;
      made.append(element("span", { class: "reason", text: ` (none: ${reason})` }));
    }
    return made;
  }

  readField() {
    const bias = Math.fround(Number(this.field.value.trim().replace(minus, "-") || NaN));
    const isBias = Number.isFinite(bias);
    this.problem.hidden = isBias;
    this.field.setAttribute("aria-invalid", String(!isBias));
    if (isBias) {
      this.setBias(bias, this.field);
    }
  }

  /**
   * @param {number} bias  rounded to float32
   * @param {?HTMLElement} source  the control that asked, and keeps its own position
   */
  setBias(bias, source = null) {
    this.bias = Math.fround(bias);
    const text = shortestFloat32(this.bias);
    if (source !== this.range) {
      this.range.value = Math.round(this.scale.positionOf(this.bias));
    }
    this.field.value = text;
    this.field.setAttribute("aria-invalid", "false");
    this.problem.hidden = true;
    this.range.setAttribute("aria-valuetext", `bias ${text}`);
    this.lengths.textContent = `That is ${biasLengths(this.image, this.bias)}.`;
    this.onBias(this.bias);
  }
}
