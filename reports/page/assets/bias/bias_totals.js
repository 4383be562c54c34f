// How many pixels are wrong at the slider's bias.

/** The counts of an image at any bias. */
class BiasTotals {
  /** @param {PixelImage} image */
  constructor(image) {
    this.image = image;
    this.counts = element("div", { class: "bias-counts", role: "status", "aria-live": "polite" });
    this.amounts = element("p", { class: "hint bias-amounts", hidden: image.amounts === null });
    const heading = image.hasCurve ? "Wrong at the slider’s bias" : "Wrong at the job’s bias";
    this.root = element("div", { class: "totals" }, element("h3", { text: heading }), this.counts, this.amounts);
  }

  /** @param {number} bias  float32 */
  show(bias) {
    const { falseShadow, falseLit } = this.image.countsAt(bias);
    const { lit, blocked } = this.image.detail.pixels;
    const about = this.image.isCountedAt(bias) ? "" : "about ";
    const row = (name, key, count, whole, noun) =>
      element(
        "p",
        { class: `count count-${key}` },
        element("span", {}, element("span", { class: `swatch swatch-${key}`, "aria-hidden": "true" }), `${name} `),
        element(
          "span",
          { class: "number" },
          about,
          element("strong", { "data-count": key, text: grouped(count) }),
          " ",
        ),
        element(
          "span",
          { class: "share" },
          `${percent(rate(count, whole))} of ${grouped(whole)}`,
          element("span", { class: "noun", text: ` ${noun}` }),
        ),
      );
    this.counts.replaceChildren(
      row("wrong", "wrong", falseShadow + falseLit, lit + blocked, "scored"),
      row("false shadow", "false_shadow", falseShadow, lit, "lit"),
      row("false lit", "false_lit", falseLit, blocked, "blocked"),
    );
    if (this.image.amounts !== null) {
      this.showAmounts(bias);
    }
  }

  /** By how much verdicts are off, where that is not told by how many are wrong. */
  showAmounts(bias) {
    const { shadow, light, isStored } = this.image.amountsAt(bias);
    const { lit, blocked } = this.image.detail.pixels;
    const about = isStored ? "" : "about ";
    this.amounts.textContent =
      `By amount: ${about}${grouped(Math.round(shadow))} pixels of false shadow, ` +
      `${percent(rate(shadow, lit))} of lit; ${about}${grouped(Math.round(light))} of false light, ` +
      `${percent(rate(light, blocked))} of blocked.`;
  }
}
