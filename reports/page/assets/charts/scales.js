// Axes and colour scales: how a quantity is laid out from 0 to 1, or along an axis.

/**
 * A way to lay out numbers: forward() is increasing, ticks() are values of the quantity.
 * @typedef {{forward: function(number): number, inverse: function(number): number,
 *            ticks: function(number, number): number[], format: function(number): string}} Layout
 */

/** Whole powers of ten from low to high, at most `most` of them. */
function decadeTicks(low, high, most) {
  const first = Math.ceil(Math.log10(low) - 1e-9);
  const last = Math.floor(Math.log10(high) + 1e-9);
  const step = Math.max(1, Math.ceil((last - first + 1) / most));
  const ticks = [];
  for (let exponent = first; exponent <= last; exponent += step) {
    ticks.push(Number(`1e${exponent}`));
  }
  return ticks;
}

function formatTick(value) {
  const exponent = Math.log10(Math.abs(value));
  const isPower = Math.abs(exponent - Math.round(exponent)) < 1e-9;
  if (value !== 0 && isPower) {
    return (value < 0 ? minus : "") + powerOfTen(Math.round(exponent));
  }
  return readable(value);
}

/** Ticks of 1, 2 or 5 times a power of ten, about six. */
function linearTicks(low, high) {
  const rough = (high - low) / 6 || 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((candidate) => candidate >= rough);
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) {
    ticks.push(Number((i * step).toPrecision(12)));
  }
  return ticks;
}

/** @return {Layout} */
function linearLayout(format = readable) {
  return { forward: (x) => x, inverse: (x) => x, ticks: linearTicks, format };
}

/** @return {Layout}  for values > 0 */
function logLayout(format = formatTick) {
  return {
    forward: Math.log10,
    inverse: (x) => 10 ** x,
    ticks: (low, high) => {
      const decades = decadeTicks(low, high, 8);
      return decades.length >= 2 ? decades : linearTicks(low, high).filter((tick) => tick > 0);
    },
    format,
  };
}

/**
 * Linear from −threshold to threshold over one decade's length, logarithmic beyond.
 * @param {number} threshold  > 0
 * @return {Layout}
 */
function symlogLayout(threshold, format = formatTick) {
  const forward = (x) => {
    const size = Math.abs(x) / threshold;
    return Math.sign(x) * (size <= 1 ? size : 1 + Math.log10(size));
  };
  const inverse = (y) => {
    const size = Math.abs(y);
    return Math.sign(y) * threshold * (size <= 1 ? size : 10 ** (size - 1));
  };
  const ticks = (low, high) => {
    const most = low < 0 && high > 0 ? 4 : 7;
    const positive = high > threshold ? decadeTicks(threshold, high, most) : [];
    const negative =
      low < -threshold
        ? decadeTicks(threshold, -low, most)
            .map((x) => -x)
            .reverse()
        : [];
    return [...negative, ...(low <= 0 && high >= 0 ? [0] : []), ...positive];
  };
  return { forward, inverse, ticks, format };
}

/** A rate; a power of ten, as ticks are, without the zeros behind it. */
function formatRate(share) {
  const exponent = Math.log10(share);
  const isPower = share > 0 && Math.abs(exponent - Math.round(exponent)) < 1e-9;
  return isPower ? `${powerOfTen(Math.round(exponent) + 2)} %` : percent(share);
}

/** Rates from 0 to 1: linear to 0.001 %, logarithmic beyond; the same on every chart. */
function rateLayout() {
  return symlogLayout(1e-5, formatRate);
}

/**
 * The layout that suits the values of an axis of a sweep.
 * @param {number[]} values  ascending
 * @return {Layout}
 */
function layoutForValues(values) {
  const sizes = values.map(Math.abs).filter((size) => size > 0);
  const smallest = Math.min(...sizes);
  if (sizes.length < 2 || Math.max(...sizes) / smallest < 20) {
    return linearLayout();
  }
  return values[0] > 0 ? logLayout() : symlogLayout(smallest);
}

/** The unit in which lengths up to `largestM` read well. */
function lengthUnit(largestM) {
  if (sceneUnit() !== "m") {
    return [1, sceneUnit()];
  }
  const units = [
    [1, "m"],
    [1e3, "mm"],
    [1e6, "µm"],
    [1e9, "nm"],
  ];
  return units.find(([factor]) => largestM * factor >= 1) ?? units[3];
}
