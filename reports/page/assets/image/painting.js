// Layers as colours, on a canvas of the image's own size.

/** Paints layers of one image onto a canvas that the stage then draws at its zoom. */
class LayerPainter {
  constructor(image) {
    this.canvas = element("canvas", { width: image.width, height: image.height });
    this.context = this.canvas.getContext("2d");
    this.pixels = this.context.createImageData(image.width, image.height);
    this.packed = new Uint32Array(this.pixels.data.buffer);
  }

  /**
   * Recolours the canvas with a layer, at a float32 bias.
   * @param {number} growth  by how many pixels on each side marks grow
   */
  paint(layer, bias, growth) {
    layer.paint(this.packed, bias, growth);
    this.context.putImageData(this.pixels, 0, 0);
  }
}
