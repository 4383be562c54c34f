// False-shadow and false-lit rates against the bias, along the slider's own axis.

const curveSamples = 400;

/** The slider's axis as a Layout: a chart's cursor stands above the slider's thumb. */
function sliderLayout(scale) {
  return {
    forward: (bias) => scale.positionOf(bias),
    inverse: (position) => scale.realAt(position),
    ticks: (low, high) => {
      const positive = decadeTicks(10 * scale.step, high, 7);
      const negative =
        low < -scale.step
          ? decadeTicks(10 * scale.step, -low, 3)
              .map((bias) => -bias)
              .reverse()
          : [];
      return [...negative, 0, ...positive];
    },
    format: (bias) => formatTick(Number(bias.toPrecision(3))),
  };
}

/** The bias curve of an image, with a cursor at the slider's bias. */
class CurveChart {
  /**
   * @param {HTMLElement} host
   * @param {PixelImage} image  with a curve
   * @param {SliderScale} scale
   */
  constructor(host, image, scale) {
    const { lit, blocked } = image.detail.pixels;
    const points = { falseShadow: [], falseLit: [], shadow: [], light: [] };
    const step = Math.ceil((scale.highestPosition - scale.lowestPosition) / curveSamples);
    for (let position = scale.lowestPosition; position <= scale.highestPosition; position += step) {
      const bias = scale.biasAt(position);
      const counts = image.countsAt(bias);
      points.falseShadow.push([bias, rate(counts.falseShadow, lit)]);
      points.falseLit.push([bias, rate(counts.falseLit, blocked)]);
      if (image.amounts !== null) {
        const amounts = image.amountsAt(bias);
        points.shadow.push([bias, rate(amounts.shadow, lit)]);
        points.light.push([bias, rate(amounts.light, blocked)]);
      }
    }
    const byAmount = [
      { name: "amount of false shadow", colour: okabeIto.orange, points: points.shadow },
      { name: "amount of false light", colour: okabeIto.sky, points: points.light, dash: [6, 3] },
    ];
    this.chart = new PageChart(host, {
      title: "Wrong pixels at every constant bias",
      isSmall: true,
      summary: `As the bias grows, false shadow falls and false lit rises; the fewest errors, ${grouped(image.detail.bias_curve.best_errors)} pixels, are at the best bias.`,
      x: {
        label: "constant bias [depth units]",
        name: "bias",
        layout: sliderLayout(scale),
        low: scale.biasAt(scale.lowestPosition),
        high: scale.biasAt(scale.highestPosition),
      },
      y: { label: "share of the lit or blocked pixels", layout: rateLayout(), low: 0, high: 1 },
      series: [
        { name: "false shadow, of lit", colour: errorColours.falseShadow, points: points.falseShadow },
        {
          name: "false lit, of blocked",
          colour: errorColours.falseLit,
          points: points.falseLit,
          dash: [6, 3],
        },
        ...(image.amounts === null ? [] : byAmount),
      ],
    });
  }

  moveCursor(bias) {
    this.chart.moveCursor(bias);
  }
}
