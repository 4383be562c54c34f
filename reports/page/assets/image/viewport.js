// What part of an image the stage shows: zoom and pan in CSS pixels.

const largestZoom = 64;
/** How much of the stage a part of the image takes that is zoomed to, and at most at which zoom. */
const boxShare = 0.5;
const largestBoxZoom = 16;

/** The place of an image on a stage; lengths on the stage are CSS pixels. */
class Viewport {
  /** @param {{width: number, height: number}} image  pixels */
  constructor(image) {
    this.image = image;
    this.stage = { width: 1, height: 1 };
    this.zoom = 1;
    this.left = 0; // the image's left edge on the stage
    this.top = 0;
  }

  get fitZoom() {
    return Math.min(this.stage.width / this.image.width, this.stage.height / this.image.height);
  }

  get isFitted() {
    return this.zoom <= this.fitZoom * 1.001;
  }

  /** Takes the stage's new size; an image that was fitted stays so. */
  resize(width, height) {
    const wasFitted = this.isFitted || this.stage.width === 1;
    this.stage = { width, height };
    if (wasFitted) {
      this.reset();
    } else {
      this.zoomTo(this.zoom, width / 2, height / 2);
    }
  }

  reset() {
    this.zoom = this.fitZoom;
    this.keepInside();
  }

  /** Zooms, and keeps the point of the image under (x, y) of the stage there. */
  zoomTo(zoom, x, y) {
    const bounded = Math.min(Math.max(zoom, this.fitZoom), Math.max(largestZoom, this.fitZoom));
    const factor = bounded / this.zoom;
    this.left = x - (x - this.left) * factor;
    this.top = y - (y - this.top) * factor;
    this.zoom = bounded;
    this.keepInside();
  }

  pan(dx, dy) {
    this.left += dx;
    this.top += dy;
    this.keepInside();
  }

  /** No side of the stage is empty where the image could fill it; a smaller image is centred. */
  keepInside() {
    const inside = (start, room, size) =>
      size <= room ? (room - size) / 2 : Math.min(0, Math.max(room - size, start));
    this.left = inside(this.left, this.stage.width, this.image.width * this.zoom);
    this.top = inside(this.top, this.stage.height, this.image.height * this.zoom);
  }

  /** @return {?{x: number, y: number}}  the pixel under a point of the stage, null beside the image */
  pixelAt(stageX, stageY) {
    const x = Math.floor((stageX - this.left) / this.zoom);
    const y = Math.floor((stageY - this.top) / this.zoom);
    const isInside = x >= 0 && y >= 0 && x < this.image.width && y < this.image.height;
    return isInside ? { x, y } : null;
  }

  /**
   * Zooms to a part of the image, with as much around it as it is large, and at least a few pixels.
   * @param {{left: number, top: number, right: number, bottom: number}} box  pixels
   */
  showBox({ left, top, right, bottom }) {
    const zoom = Math.min(
      (boxShare * this.stage.width) / (right - left),
      (boxShare * this.stage.height) / (bottom - top),
      largestBoxZoom,
    );
    this.zoomTo(zoom, 0, 0);
    this.left = this.stage.width / 2 - ((left + right) / 2) * this.zoom;
    this.top = this.stage.height / 2 - ((top + bottom) / 2) * this.zoom;
    this.keepInside();
  }

  /** Pans as far as it takes to see a pixel with some room around it. */
  reveal({ x, y }) {
    const margin = Math.min(3 * this.zoom, this.stage.width / 4, this.stage.height / 4);
    const shift = (start, end, room) =>
      start < margin ? margin - start : end > room - margin ? room - margin - end : 0;
    const left = this.left + x * this.zoom;
    const top = this.top + y * this.zoom;
    this.pan(shift(left, left + this.zoom, this.stage.width), shift(top, top + this.zoom, this.stage.height));
  }
}
