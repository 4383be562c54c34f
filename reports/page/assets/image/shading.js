// The scene in the light and in the shadow, shaded as the pictures of `gnomon compare --picture`.

// Linear RGB. The light is a little warm and the ambient a little cool, as outdoors.
const backgroundLight = [0.8, 0.84, 0.9];
const diffuseTint = [0.86, 0.81, 0.73];
const ambientTint = [0.76, 0.8, 0.88];
/** How much of the ambient light a shadow leaves. */
const shadowedAmbient = 0.72;
/** How far colours fade towards white beneath marks. */
const fadeToWhite = 0.62;
const srgbSteps = 4096;

const srgbOfLinear = Uint8Array.from({ length: srgbSteps + 1 }, (_, i) => {
  const linear = i / srgbSteps;
  return Math.round(255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055));
});

/** @return {number[]}  0 to 255, of a linear colour */
function encodeLinear(colour) {
  return colour.map((value) => srgbOfLinear[Math.round(srgbSteps * Math.min(1, Math.max(0, value)))]);
}

/**
 * The linear colour of a surface.
 * @param {number} cosine  between normal and light, 0 to 1
 * @param {number} sky  how far it faces up, 0 to 1
 * @param {number} lit  which fraction of the light arrives, 0 to 1
 */
function surfaceLight(cosine, sky, lit) {
  const ambient = (0.14 + 0.1 * sky) * (shadowedAmbient + (1 - shadowedAmbient) * lit);
  return ambientTint.map((tint, i) => ambient * tint + 0.8 * cosine * lit * diffuseTint[i]);
}

/** What a mark's colour, 0 to 255, is in shadow. */
function shadedColour(colour) {
  return colour.map((value) => Math.round(0.78 * value));
}

/** Fades a linear colour so that only marks are coloured. */
function fadedLight(colour) {
  const grey = 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2];
  return colour.map((value) => 0.5 * (value + grey) * (1 - fadeToWhite) + fadeToWhite);
}

/** Packed colours of one image: each pixel lit, in shadow, as it truly is, and that faded; (pixels). */
class ShadedScene {
  /** @param {PixelImage} image */
  constructor(image) {
    const { class: classes, cos_theta: cosines, sky } = image.layers;
    const cache = new Map();
    const [lit, shadowed, truth, faded] = [1, 2, 3, 4].map(() => new Uint32Array(classes.length));
    Object.assign(this, { lit, shadowed, truth, faded });
    let lastKey = -1;
    let colours = null;
    for (let i = 0; i < classes.length; ++i) {
      const cosine = cosines === undefined ? 180 : cosines[i];
      const upwards = sky === undefined ? 190 : sky[i];
      const key = (classes[i] << 16) | (cosine << 8) | upwards;
      if (key !== lastKey) {
        if (!cache.has(key)) {
          cache.set(key, ShadedScene.coloursOf(classes[i], cosine / 255, upwards / 255));
        }
        colours = cache.get(key);
        lastKey = key;
      }
      lit[i] = colours[0];
      shadowed[i] = colours[1];
      truth[i] = colours[2];
      faded[i] = colours[3];
    }
  }

  static coloursOf(pixelClass, cosine, sky) {
    const [background, attached, outOfLight] = ["background", "attached", "out_of_light"].map((name) =>
      classNames.indexOf(name),
    );
    if (pixelClass === background) {
      return [backgroundLight, backgroundLight, backgroundLight, fadedLight(backgroundLight)].map((colour) =>
        packedColour(encodeLinear(colour)),
      );
    }
    const receives = pixelClass !== attached && pixelClass !== outOfLight;
    const [lit, shadowed, half] = [1, 0, 0.5].map((share) => surfaceLight(cosine, sky, receives ? share : 0));
    const truth = { [classLit]: lit, [classBlocked]: shadowed }[pixelClass] ?? half;
    return [lit, shadowed, truth, fadedLight(truth)].map((colour) => packedColour(encodeLinear(colour)));
  }
}

/** Colours for legends: what an upright wall in the light looks like, and the same in shadow. */
const legendColours = (() => {
  const hex = (colour) =>
    `#${encodeLinear(colour)
      .map((value) => value.toString(16).padStart(2, "0"))
      .join("")}`;
  const [lit, shadowed] = [surfaceLight(0.75, 0.8, 1), surfaceLight(0.75, 0.8, 0)];
  return {
    lit: hex(lit),
    shadowed: hex(shadowed),
    background: hex(backgroundLight),
    faded: hex(fadedLight(shadowed)),
  };
})();
