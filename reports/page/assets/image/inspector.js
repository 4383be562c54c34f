// The pixel inspector: two layers with a wipe between them, the bias slider with its counts and curve, and a pixel.

const noCurveLine =
  "The layers show the job’s bias alone. Gnomon cannot compute other biases: " +
  "this lookup has none, or its depths or its weights are not known.";

/** What is said of an image of which not all pixels are on the page. */
function thinnedText({ step }) {
  const nth = { 2: "second", 4: "fourth", 8: "eighth" }[step];
  return (
    `The image is too large for the page: every ${nth} pixel of every ${nth} row is shown. ` +
    "Counts at the job’s bias are those of all pixels, at other biases they are estimates."
  );
}

/** Fills section#inspector. */
class Inspector {
  /** @param {HTMLElement} section */
  constructor(section) {
    this.section = section;
    this.pinned = null;
    this.hovered = null;
    this.chosen = ["gl", "errors"];
    this.earlier = null;
    this.stage = new Stage({
      onPixel: (pixel) => this.point(pixel),
      onPin: (pixel) => this.pin(pixel),
      onError: (step) => this.errors.go(step),
      onChange: () => this.showView(),
    });
    this.errors = new ErrorNavigation((pixels) => this.showCluster(pixels));
    this.details = new PixelDetails();
    this.caption = element("p", { class: "caption name" });
    this.thinned = element("p", { class: "hint thinned" });
    this.selects = element("div", { class: "bar inspector-layers" });
    this.legends = element("div", { class: "legends" });
    this.biasHost = element("div", { class: "bias-host" });
    this.totalsHost = element("div", { class: "totals-host" });
    this.curveHost = element("div", { class: "chart-host curve-host" });
    this.recolour = oncePerFrame(() => this.recolourNow());
    refill(section, this.caption, this.thinned, this.selects, this.layOut());
    section.hidden = false;
  }

  layOut() {
    return element(
      "div",
      { class: "inspector-body" },
      element(
        "div",
        { class: "inspector-image" },
        this.biasHost,
        this.stage.root,
        this.makeTools(),
        this.errors.text,
        this.legends,
      ),
      element("div", { class: "inspector-side" }, this.totalsHost, this.curveHost, this.details.root),
    );
  }

  makeTools() {
    this.wipeRange = element("input", {
      type: "range",
      min: 0,
      max: 100,
      step: 1,
      on: { input: () => this.stage.setWipe(Number(this.wipeRange.value) / 100) },
    });
    this.zoomText = element("output", { class: "zoom-text", "aria-label": "Zoom" });
    this.goTo = element("input", {
      type: "text",
      class: "go-to",
      placeholder: "x,y",
      autocomplete: "off",
      on: { keydown: (event) => event.key === "Enter" && this.goToPixel(), change: () => this.goToPixel() },
    });
    return element(
      "div",
      { class: "bar inspector-tools" },
      this.errors.buttons,
      element(
        "div",
        { class: "buttons", role: "group", "aria-label": "Zoom controls" },
        button("−", () => this.stage.zoomBy(1 / 1.5), { "aria-label": "Zoom out" }),
        this.zoomText,
        button("+", () => this.stage.zoomBy(1.5), { "aria-label": "Zoom in" }),
        button("Show all", () => this.stage.showAll()),
      ),
      labelled("Go to pixel", this.goTo),
    );
  }

  /**
   * Shows an image.
   * @param {PixelImage} image
   * @param {string} caption  which configuration it is
   */
  show(image, caption) {
    this.image = image;
    this.caption.textContent = caption;
    this.thinned.textContent = thinnedText(image);
    this.thinned.hidden = image.step === 1;
    this.causes = new ErrorCauses(image);
    this.layers = [...imageLayers(image, this.causes), ...earlierLayers(this.earlier, image)];
    this.painters = [new LayerPainter(image), new LayerPainter(image)];
    this.chosen = this.chosen.map((id, side) => (this.layerOf(id) ? id : ["gl", "errors"][side]));
    if (this.pinned !== null && (this.pinned.x >= image.width || this.pinned.y >= image.height)) {
      this.pinned = null;
    }
    this.hovered = null;
    this.makeSelects();
    this.stage.setImage(image);
    this.makeBias();
    this.chooseLayers();
  }

  /** Adds the layers of an earlier run's image, and opens with both runs' errors. */
  compareWith(earlier) {
    this.earlier = earlier;
    this.chosen = ["earlier-errors", "errors"];
  }

  layerOf(id) {
    return this.layers.find((layer) => layer.id === id);
  }

  makeSelects() {
    const options = this.layers.map(({ id, title }) => [id, title]);
    const selects = ["A", "B"].map((side, i) =>
      labelled(
        `Layer ${side}`,
        choice(options, this.chosen[i], (id) => {
          this.chosen[i] = id;
          this.chooseLayers();
        }),
      ),
    );
    const swap = button(
      "Swap",
      () => {
        this.chosen.reverse();
        this.makeSelects();
        this.chooseLayers();
      },
      { "aria-label": "Swap layers A and B" },
    );
    this.selects.replaceChildren(...selects, swap, labelled("Wipe", this.wipeRange, "control wipe-control"));
  }

  makeBias() {
    this.bias = this.image.jobBias;
    this.totals = new BiasTotals(this.image);
    this.totalsHost.replaceChildren(this.totals.root);
    this.curve = null;
    if (this.image.hasCurve && this.image.detail.bias_curve !== null) {
      const slider = new BiasSlider(this.image, (bias) => this.setBias(bias));
      this.biasHost.replaceChildren(slider.root);
      this.curve = new CurveChart(this.curveHost, this.image, slider.scale);
      slider.setBias(this.bias);
    } else {
      this.biasHost.replaceChildren(element("p", { class: "hint", text: noCurveLine }));
      this.curveHost.replaceChildren();
      this.setBias(this.bias);
    }
  }

  setBias(bias) {
    this.bias = bias;
    this.totals.show(bias);
    this.errors.restart(this.causes, bias);
    this.stage.frame = null;
    this.recolour();
  }

  chooseLayers() {
    const layers = this.chosen.map((id) => this.layerOf(id));
    this.legends.replaceChildren(
      ...layers.map((layer, i) =>
        element(
          "div",
          { class: "legend" },
          element("p", {}, element("strong", { text: `${"AB"[i]}: ${layer.title}` }), `, ${layer.note}`),
          layer.legend(),
        ),
      ),
    );
    this.growth = markGrowth(this.stage.screenZoom);
    layers.forEach((layer, i) => this.painters[i].paint(layer, this.bias, this.growth));
    this.stage.setSides(layers.map(({ title }, i) => ({ canvas: this.painters[i].canvas, title })));
  }

  recolourNow() {
    this.chosen.forEach((id, i) => {
      const layer = this.layerOf(id);
      if (layer.followsBias) {
        this.painters[i].paint(layer, this.bias, this.growth);
      }
    });
    this.curve?.moveCursor(this.bias);
    this.stage.drawNow();
    this.showDetails();
  }

  point(pixel) {
    this.hovered = pixel;
    this.showDetails();
    if (pixel !== null && pixel === this.stage.cursor) {
      this.details.say(this.causes, pixel, this.bias);
    }
  }

  pin(pixel) {
    const isSame = this.pinned?.x === pixel.x && this.pinned?.y === pixel.y;
    this.pinned = isSame ? null : pixel;
    if (isSame) {
      this.stage.setCursor(null);
    }
    this.showDetails();
  }

  showDetails() {
    this.details.show(this.causes, this.pinned ?? this.hovered, this.bias, this.pinned !== null);
  }

  /** Zooms to a cluster of wrong pixels, and pins the one in its middle. */
  showCluster(pixels) {
    const { width } = this.image;
    this.pinned = middlePixel(pixels, width);
    const marking = [1, 0].find((side) => this.layerOf(this.chosen[side]).marksErrors);
    this.stage.showBox(boxOf(pixels, width), marking ?? null);
    this.stage.setCursor(this.pinned);
  }

  /** Recolours where marks of wrong pixels need another size at the new zoom. */
  fitMarks() {
    if (this.growth !== undefined && this.growth !== markGrowth(this.stage.screenZoom)) {
      this.growth = markGrowth(this.stage.screenZoom);
      this.recolour();
    }
  }

  showView() {
    this.fitMarks();
    this.wipeRange.value = Math.round(100 * this.stage.wipe);
    if (this.stage.view !== undefined) {
      const { zoom } = this.stage.view;
      this.zoomText.textContent = `${Number((100 * zoom).toPrecision(zoom >= 1 ? 3 : 2))} %`;
    }
  }

  goToPixel() {
    const match = /^\s*(\d+)\s*[,; ]\s*(\d+)\s*$/.exec(this.goTo.value);
    const wanted = match === null ? [NaN, NaN] : [Number(match[1]), Number(match[2])];
    const [x, y] = wanted.map((place) => Math.floor(place / this.image.step));
    const isInside = x < this.image.width && y < this.image.height;
    this.goTo.setAttribute("aria-invalid", String(!isInside && this.goTo.value !== ""));
    if (!isInside) {
      return;
    }
    this.pinned = { x, y };
    if (this.stage.view.zoom < 4) {
      this.stage.zoomBy(8 / this.stage.view.zoom);
    }
    const { stage, zoom } = this.stage.view;
    this.stage.view.left = stage.width / 2 - (x + 0.5) * zoom;
    this.stage.view.top = stage.height / 2 - (y + 0.5) * zoom;
    this.stage.view.keepInside();
    this.stage.setCursor(this.pinned);
  }
}
