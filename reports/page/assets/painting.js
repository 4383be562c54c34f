// From codes to colours, on a canvas of the image's own size.

/** Paints layers of one image, each onto a canvas that the view then draws at its zoom. */
class LayerPainter {
  constructor(image) {
    this.canvas = element("canvas", { width: image.width, height: image.height });
    this.context = this.canvas.getContext("2d");
    this.pixels = this.context.createImageData(image.width, image.height);
    this.packed = new Uint32Array(this.pixels.data.buffer);
    this.scratch = new Uint8Array(image.width * image.height);
  }

  /** Recolours the canvas with a layer, at a float32 bias. */
  paint(layer, bias) {
    const codes = layer.codes(bias, this.scratch);
    const { packed } = this;
    const { palette } = layer;
    for (let i = 0; i < packed.length; ++i) {
      packed[i] = palette[codes[i]];
    }
    this.context.putImageData(this.pixels, 0, 0);
  }
}
