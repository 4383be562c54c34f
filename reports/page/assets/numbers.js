// Numbers as people read them.

const minus = "\u2212";
const noValue = "\u2013";

/** The shortest text that reads back as the same float32. */
function shortestFloat32(value) {
  if (!Number.isFinite(value)) {
    return Number.isNaN(value) ? noValue : value > 0 ? "+\u221E" : `${minus}\u221E`;
  }
  for (let digits = 1; digits < 9; ++digits) {
    const text = value.toPrecision(digits);
    if (Math.fround(Number(text)) === value) {
      return String(Number(text));
    }
  }
  return String(Number(value.toPrecision(9)));
}

/** A count with its digits in groups of three. */
function grouped(count) {
  return String(count).replace(/\B(?=(\d{3})+(?!\d))/g, ",");
}

/** An amount of pixels, as reports::grouped_amount: whole from 100 on, else to three digits. */
function groupedAmount(pixels) {
  if (pixels === 0 || pixels >= 99.95) {
    return grouped(Math.round(pixels));
  }
  if (pixels < 0.0005) {
    return "<0.001";
  }
  return pixels.toFixed(pixels >= 9.995 ? 1 : pixels >= 0.9995 ? 2 : 3);
}

/** A share in percent, to three significant digits and at most four decimals, as reports::percent. */
function percent(share) {
  if (share === null || !Number.isFinite(share)) {
    return noValue;
  }
  const value = 100 * share;
  if (value === 0) {
    return "0 %";
  }
  if (value < 0.0001) {
    return "<0.0001 %";
  }
  const decimals = 2 - Math.floor(Math.log10(value));
  return `${value.toFixed(Math.min(4, Math.max(0, decimals)))} %`;
}

/** What the scene's lengths are in: "m", or "units" of a scene file whose unit nobody says. */
function sceneUnit() {
  return globalThis.document?.body?.dataset.lengthUnit ?? "m";
}

/** A real number to four significant digits; whole numbers whole. */
function readable(value) {
  if (value === null || Number.isNaN(value)) {
    return noValue;
  }
  if (!Number.isFinite(value)) {
    return value > 0 ? "+\u221E" : `${minus}\u221E`;
  }
  if (Number.isInteger(value) && Math.abs(value) < 1e12) {
    return `${value < 0 ? minus : ""}${grouped(Math.abs(value))}`;
  }
  return String(Number(value.toPrecision(4))).replace(/^-/, minus);
}

/** part / whole; null without a whole. */
function rate(part, whole) {
  return whole > 0 ? part / whole : null;
}

/** A power of ten as an axis writes it: 0.01, 10, 1e-5. */
function powerOfTen(exponent) {
  return exponent >= -3 && exponent <= 4
    ? String(Number(`1e${exponent}`))
    : `1e${exponent}`.replace("-", minus);
}
