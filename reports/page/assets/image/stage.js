// The stage: draws two layers on either side of the wipe, the pixel grid and the cursor.

const gridZoom = 10;
/** How high the stage is at most, of the window's height: the slider and its counts fit in beside it. */
const largestHeightShare = 0.52;
const wheelZoomPerPx = 0.002;
/** How far beside a framed part of the image the wipe stands, of the stage's width. */
const wipeMargin = 0.05;
/** How far keys move the wipe, of the stage's width. */
const wipeKeys = {
  ArrowLeft: -0.02,
  ArrowDown: -0.02,
  ArrowRight: 0.02,
  ArrowUp: 0.02,
  PageDown: -0.1,
  PageUp: 0.1,
  Home: -1,
  End: 1,
};

/**
 * Canvas with the wipe; it knows nothing of biases, only of two painted canvases.
 * Calls onPixel(pixel or null) as the pointer or the keyboard's cursor moves, onPin(pixel) at a click
 * or tap, onError(1 or -1) at the keys of the next and the previous error, and onChange() when the wipe or the zoom
 * moved.
 */
class Stage {
  constructor({ onPixel, onPin, onError, onChange }) {
    Object.assign(this, { onPixel, onPin, onError, onChange });
    this.wipe = 0.5;
    this.cursor = null;
    this.frame = null;
    this.pointers = new Map();
    this.canvas = element("canvas", {
      class: "stage-canvas",
      tabindex: 0,
      role: "application",
      "aria-roledescription": "pixel image",
      "aria-label":
        "Pixels. Arrow keys move the cursor, Shift and arrows the view, plus and minus zoom, 0 shows all, " +
        "brackets move the wipe, Enter pins the pixel, n and p show the next and the previous error.",
    });
    this.handle = this.makeHandle();
    this.names = ["A", "B"].map((side) => element("span", { class: `side side-${side.toLowerCase()}` }));
    this.root = element("div", { class: "stage" }, this.canvas, this.handle, ...this.names);
    this.draw = oncePerFrame(() => this.drawNow());
    this.listen();
    new ResizeObserver(() => this.fitRoot()).observe(this.root);
  }

  makeHandle() {
    const handle = element(
      "div",
      {
        class: "wipe",
        tabindex: 0,
        role: "slider",
        "aria-label": "Wipe between layers A and B",
        "aria-valuemin": 0,
        "aria-valuemax": 100,
        "aria-orientation": "horizontal",
      },
      element("span", { class: "wipe-grip", "aria-hidden": "true" }),
    );
    handle.addEventListener("keydown", (event) => {
      if (event.key in wipeKeys) {
        event.preventDefault();
        this.setWipe(this.wipe + wipeKeys[event.key]);
      }
    });
    handle.addEventListener("pointerdown", (event) => {
      handle.setPointerCapture(event.pointerId);
      event.preventDefault();
      handle.focus({ preventScroll: true });
    });
    handle.addEventListener("pointermove", (event) => {
      if (handle.hasPointerCapture(event.pointerId)) {
        this.setWipe(this.stagePoint(event).x / this.root.clientWidth);
      }
    });
    return handle;
  }

  /** Shows another image; the zoom stays where the size is the same. */
  setImage(image) {
    if (this.view?.image.width !== image.width || this.view?.image.height !== image.height) {
      this.view = new Viewport(image);
      this.cursor = null;
    }
    this.frame = null;
    this.fitRoot();
  }

  /** @param {{canvas: HTMLCanvasElement, title: string}[]} sides  A and B */
  setSides(sides) {
    this.sides = sides;
    sides.forEach(({ title }, i) => {
      this.names[i].textContent = `${"AB"[i]}: ${title}`;
    });
    this.setWipe(this.wipe);
  }

  setWipe(wipe) {
    this.wipe = Math.min(1, Math.max(0, wipe));
    const share = Math.round(100 * this.wipe);
    this.handle.style.left = `${100 * this.wipe}%`;
    this.handle.setAttribute("aria-valuenow", share);
    this.handle.setAttribute("aria-valuetext", `A on the left ${share} %, B on the right`);
    this.names[0].hidden = this.wipe < 0.12;
    this.names[1].hidden = this.wipe > 0.88;
    this.onChange();
    this.draw();
  }

  fitRoot() {
    if (this.view === undefined || this.root.clientWidth === 0 || isOnPaper()) {
      return;
    }
    const { width, height } = this.view.image;
    const stageWidth = this.root.clientWidth;
    const stageHeight = Math.round(
      Math.min(Math.max((stageWidth * height) / width, 160), largestHeightShare * window.innerHeight),
    );
    this.root.style.height = `${stageHeight}px`;
    const dense = window.devicePixelRatio || 1;
    this.canvas.width = Math.round(stageWidth * dense);
    this.canvas.height = Math.round(stageHeight * dense);
    this.view.resize(stageWidth, stageHeight);
    this.changed();
  }

  /** How many pixels of the screen show one of the image. */
  get screenZoom() {
    return this.view === undefined ? 1 : this.view.zoom * (window.devicePixelRatio || 1);
  }

  /**
   * Frames a part of the image and zooms to it.
   * @param {object} box  pixels, as of `Viewport.showBox`
   * @param {?number} side  0 or 1, the side of the wipe that must show the whole box, if it is small; null if none
   */
  showBox(box, side) {
    this.frame = box;
    this.view.showBox(box);
    const [left, right] = [box.left, box.right].map(
      (x) => (this.view.left + x * this.view.zoom) / this.view.stage.width,
    );
    if (side !== null && right - left <= boxShare + wipeMargin) {
      this.setWipe(side === 1 ? Math.min(this.wipe, left - wipeMargin) : Math.max(this.wipe, right + wipeMargin));
    }
    this.changed();
  }

  changed() {
    this.canvas.style.touchAction = this.view.isFitted ? "pan-y" : "none";
    this.onChange();
    this.draw();
  }

  stagePoint(event) {
    const box = this.root.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  listen() {
    const { canvas } = this;
    canvas.addEventListener("pointerdown", (event) => this.press(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const name of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(name, (event) => this.release(event, name === "pointerup"));
    }
    canvas.addEventListener("pointerleave", () => this.onPixel(this.cursor));
    canvas.addEventListener("wheel", (event) => this.roll(event), { passive: false });
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  press(event) {
    const point = this.stagePoint(event);
    this.pointers.set(event.pointerId, point);
    this.dragged = this.pointers.size > 1 ? Infinity : 0;
    this.canvas.setPointerCapture(event.pointerId);
  }

  move(event) {
    const point = this.stagePoint(event);
    const before = this.pointers.get(event.pointerId);
    if (before === undefined) {
      this.onPixel(this.view.pixelAt(point.x, point.y));
      return;
    }
    this.dragged += Math.hypot(point.x - before.x, point.y - before.y);
    if (this.pointers.size === 2) {
      this.pinch(event.pointerId, point);
    } else if (this.dragged > 4) {
      this.view.pan(point.x - before.x, point.y - before.y);
    }
    this.pointers.set(event.pointerId, point);
    this.changed();
  }

  pinch(moved, point) {
    const [other] = [...this.pointers].filter(([id]) => id !== moved).map(([, at]) => at);
    const before = this.pointers.get(moved);
    const gap = (a) => Math.max(8, Math.hypot(a.x - other.x, a.y - other.y));
    const factor = gap(point) / gap(before);
    this.view.zoomTo(this.view.zoom * factor, (point.x + other.x) / 2, (point.y + other.y) / 2);
  }

  release(event, isDone) {
    const point = this.stagePoint(event);
    this.pointers.delete(event.pointerId);
    const pixel = this.view.pixelAt(point.x, point.y);
    if (isDone && this.dragged <= 4 && pixel !== null) {
      this.setCursor(pixel);
      this.onPin(pixel);
    }
  }

  /** The wheel zooms where the image has the focus or Ctrl is held; else it scrolls the page. */
  roll(event) {
    if (!event.ctrlKey && document.activeElement !== this.canvas) {
      return;
    }
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
    const { x, y } = this.stagePoint(event);
    this.zoomBy(Math.exp(-event.deltaY * lines * wheelZoomPerPx * (event.ctrlKey ? 3 : 1)), x, y);
  }

  zoomBy(factor, x = this.view.stage.width / 2, y = this.view.stage.height / 2) {
    this.view.zoomTo(this.view.zoom * factor, x, y);
    this.changed();
  }

  showAll() {
    this.view.reset();
    this.changed();
  }

  key(event) {
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const actions = {
      "+": () => this.zoomBy(1.5),
      "=": () => this.zoomBy(1.5),
      "-": () => this.zoomBy(1 / 1.5),
      0: () => this.showAll(),
      "[": () => this.setWipe(this.wipe - 0.02),
      "]": () => this.setWipe(this.wipe + 0.02),
      Enter: () => this.cursor !== null && this.onPin(this.cursor),
      Escape: () => {
        this.frame = null;
        this.setCursor(null);
      },
      n: () => this.onError(1),
      p: () => this.onError(-1),
    };
    if (event.ctrlKey || event.metaKey || !(event.key in arrows || event.key in actions)) {
      return;
    }
    event.preventDefault();
    if (event.key in actions) {
      actions[event.key]();
    } else if (event.shiftKey) {
      this.view.pan(...arrows[event.key].map((way) => -40 * way));
      this.changed();
    } else {
      this.stepCursor(...arrows[event.key]);
    }
  }

  stepCursor(dx, dy) {
    const { width, height } = this.view.image;
    const from = this.cursor ?? { x: Math.floor(width / 2) - dx, y: Math.floor(height / 2) - dy };
    this.setCursor({
      x: Math.min(width - 1, Math.max(0, from.x + dx)),
      y: Math.min(height - 1, Math.max(0, from.y + dy)),
    });
  }

  setCursor(pixel) {
    this.cursor = pixel;
    if (pixel !== null) {
      this.view.reveal(pixel);
    }
    this.onPixel(pixel);
    this.changed();
  }

  drawNow() {
    if (this.sides === undefined || this.view === undefined) {
      return;
    }
    const context = this.canvas.getContext("2d");
    const dense = this.canvas.width / this.view.stage.width;
    const { left, top, zoom, image, stage } = this.view;
    context.setTransform(dense, 0, 0, dense, 0, 0);
    context.clearRect(0, 0, stage.width, stage.height);
    // Below a pixel of the screen, single wrong pixels would come and go with the nearest one.
    context.imageSmoothingEnabled = zoom * dense < 1;
    context.imageSmoothingQuality = "high";
    const split = this.wipe * stage.width;
    this.sides.forEach(({ canvas }, i) => {
      context.save();
      context.beginPath();
      context.rect(i === 0 ? 0 : split, 0, i === 0 ? split : stage.width - split, stage.height);
      context.clip();
      context.drawImage(canvas, left, top, image.width * zoom, image.height * zoom);
      context.restore();
    });
    this.drawGrid(context);
    this.drawFrame(context);
    this.drawCursor(context);
  }

  /** A dashed frame around the error that was asked for. */
  drawFrame(context) {
    if (this.frame === null) {
      return;
    }
    const { left, top, zoom } = this.view;
    const room = 6;
    const box = [
      left + this.frame.left * zoom - room,
      top + this.frame.top * zoom - room,
      (this.frame.right - this.frame.left) * zoom + 2 * room,
      (this.frame.bottom - this.frame.top) * zoom + 2 * room,
    ];
    context.lineWidth = 1.5;
    context.strokeStyle = "#FFFFFF";
    context.strokeRect(...box);
    context.setLineDash([5, 4]);
    context.strokeStyle = "#000000";
    context.strokeRect(...box);
    context.setLineDash([]);
  }

  drawGrid(context) {
    const { left, top, zoom, image, stage } = this.view;
    if (zoom < gridZoom) {
      return;
    }
    context.beginPath();
    for (
      let x = Math.max(0, Math.floor(-left / zoom));
      x <= image.width && left + x * zoom <= stage.width;
      ++x
    ) {
      context.moveTo(left + x * zoom, Math.max(0, top));
      context.lineTo(left + x * zoom, Math.min(stage.height, top + image.height * zoom));
    }
    for (
      let y = Math.max(0, Math.floor(-top / zoom));
      y <= image.height && top + y * zoom <= stage.height;
      ++y
    ) {
      context.moveTo(Math.max(0, left), top + y * zoom);
      context.lineTo(Math.min(stage.width, left + image.width * zoom), top + y * zoom);
    }
    context.lineWidth = 1;
    context.strokeStyle = "rgba(90, 90, 90, 0.35)";
    context.stroke();
  }

  drawCursor(context) {
    if (this.cursor === null) {
      return;
    }
    const { left, top, zoom } = this.view;
    const side = Math.max(zoom, 7);
    const x = left + (this.cursor.x + 0.5) * zoom - side / 2;
    const y = top + (this.cursor.y + 0.5) * zoom - side / 2;
    for (const [grow, width, colour] of [
      [1.5, 3, "#FFFFFF"],
      [1.5, 1.2, "#000000"],
    ]) {
      context.lineWidth = width;
      context.strokeStyle = colour;
      context.strokeRect(x - grow, y - grow, side + 2 * grow, side + 2 * grow);
    }
  }
}
