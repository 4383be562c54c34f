// A thin layer over Chart.js: axes that are laid out by a Layout, bands, a summary, and a table of the data.

const darkMode = window.matchMedia("(prefers-color-scheme: dark)");
const liveCharts = new Set();
const tableRowsShown = 400;
/** About the width of a sheet: wider charts would shrink until nobody can read them. */
const paperWidthPx = 740;

/** A colour of base.css. */
function themeColour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

/**
 * A colour of Okabe and Ito as a line: black and the dark ones are lightened on a dark page.
 * @param {string} colour  "#RRGGBB"
 */
function lineColour(colour) {
  if (!darkMode.matches || isOnPaper()) {
    return colour === okabeIto.yellow ? "#B7A600" : colour;
  }
  const lighter = {
    [okabeIto.black]: "#C9CCD1",
    [okabeIto.blue]: "#4FA3DB",
    [okabeIto.vermilion]: "#F0803C",
    [okabeIto.green]: "#2CC79B",
  };
  return lighter[colour] ?? colour;
}

function withAlpha(colour, alpha) {
  return `rgba(${channels(colour).join(", ")}, ${alpha})`;
}

/** Options of a Chart.js axis whose positions are layout.forward() of the values. */
function axisOptions({ layout, label, low, high }) {
  return {
    type: "linear",
    offset: false,
    min: low === undefined ? undefined : layout.forward(low),
    max: high === undefined ? undefined : layout.forward(high),
    title: { display: true, text: label, color: themeColour("ink") },
    grid: { color: themeColour("rule"), borderColor: themeColour("faint") },
    ticks: {
      color: themeColour("faint"),
      maxRotation: 0,
      autoSkipPadding: 8,
      callback: (position) => layout.format(layout.inverse(position)),
    },
    afterBuildTicks: (axis) => {
      const values = layout.ticks(layout.inverse(axis.min), layout.inverse(axis.max));
      axis.ticks = values.map((value) => ({ value: layout.forward(value) }));
    },
  };
}

/** The two datasets of a band between y and its upper end. */
function bandDatasets(band, { x, y }) {
  const colour = lineColour(band.colour);
  const shared = {
    borderWidth: 0,
    pointRadius: 0,
    pointHitRadius: 0,
    isBand: true,
    stepped: band.stepped ?? false,
  };
  const lower = band.points.map(([at, low]) => ({ x: x.layout.forward(at), y: y.layout.forward(low) }));
  const upper = band.points.map(([at, , high]) => ({ x: x.layout.forward(at), y: y.layout.forward(high) }));
  return [
    { ...shared, label: band.name, data: lower, fill: false },
    {
      ...shared,
      label: band.name,
      data: upper,
      fill: "-1",
      backgroundColor: withAlpha(colour, 0.22),
      isLegend: band.points.length > 0,
    },
  ];
}

/** Whether a series has a value to show: a legend names only these. */
function hasValues(series) {
  return series.points.some(([, value]) => value !== null && value !== undefined);
}

function seriesDataset(series, { x, y }) {
  const colour = lineColour(series.colour);
  const data = series.points.map(([at, value]) => ({
    x: x.layout.forward(at),
    y: value === null ? NaN : y.layout.forward(value),
  }));
  return {
    type: series.isBar ? "bar" : "line",
    maxBarThickness: 56,
    order: series.isBar ? 1 : 0,
    label: series.name,
    data,
    borderColor: colour,
    backgroundColor: colour,
    borderWidth: 2,
    isLegend: hasValues(series),
    borderDash: series.dash ?? [],
    pointRadius: series.radius ?? 0,
    pointStyle: series.mark ?? "circle",
    pointHitRadius: 8,
    pointHoverRadius: 5,
    showLine: series.isLine ?? true,
    clip: 6,
    stepped: series.stepped ?? false,
    tension: 0,
  };
}

/** Draws a vertical line at chart.gnomonCursor, a position of the x axis. */
const cursorPlugin = {
  id: "gnomonCursor",
  afterDatasetsDraw(chart) {
    const at = chart.gnomonCursor;
    if (at === undefined) {
      return;
    }
    const { ctx, chartArea, scales } = chart;
    const x = Math.min(Math.max(scales.x.getPixelForValue(at), chartArea.left), chartArea.right);
    ctx.save();
    ctx.strokeStyle = themeColour("ink");
    ctx.lineWidth = 1.5;
    ctx.beginPath();
    ctx.moveTo(x, chartArea.top);
    ctx.lineTo(x, chartArea.bottom);
    ctx.stroke();
    ctx.restore();
  },
};

function chartOptions(spec) {
  const said = (item) =>
    `${item.dataset.label}: ${spec.y.layout.format(spec.y.layout.inverse(item.parsed.y))}`;
  const heading = (items) =>
    items.length === 0
      ? ""
      : `${spec.x.name ?? spec.x.label}: ${spec.x.layout.format(spec.x.layout.inverse(items[0].parsed.x))}`;
  return {
    animation: false,
    responsive: true,
    maintainAspectRatio: false,
    parsing: false,
    interaction: {
      mode: spec.isScatter ? "nearest" : "index",
      axis: spec.isScatter ? "xy" : "x",
      intersect: false,
    },
    scales: { x: axisOptions(spec.x), y: axisOptions(spec.y) },
    onClick: (event, items) => items.length > 0 && spec.onPick?.(items[0].datasetIndex, items[0].index),
    plugins: {
      legend: {
        display: spec.hasLegend ?? true,
        position: "top",
        align: "start",
        labels: {
          color: themeColour("ink"),
          boxWidth: 18,
          boxHeight: 2,
          filter: (item, data) => data.datasets[item.datasetIndex].isLegend === true,
        },
      },
      tooltip: { filter: (item) => item.dataset.isBand !== true, callbacks: { title: heading, label: said } },
    },
  };
}

function chartConfig(spec) {
  const bands = (spec.bands ?? []).flatMap((band) => bandDatasets(band, spec));
  const lines = spec.series.map((series) => seriesDataset(series, spec));
  return {
    type: "line",
    data: { datasets: [...lines, ...bands] },
    options: chartOptions(spec),
    plugins: [cursorPlugin],
  };
}

/** The numbers of a chart as a table, at most 400 rows. */
function dataTable(spec) {
  const columns = [
    spec.x.name ?? spec.x.label,
    ...spec.series.map((series) => series.name),
    ...(spec.bands ?? []).flatMap((band) => [`${band.name}, from`, `${band.name}, to`]),
  ];
  const rows = new Map();
  const cell = (x, index, value) => {
    if (!rows.has(x)) {
      rows.set(x, Array(columns.length).fill(null).fill(x, 0, 1));
    }
    rows.get(x)[index] = value;
  };
  spec.series.forEach((series, i) => series.points.forEach(([x, y]) => cell(x, i + 1, y)));
  (spec.bands ?? []).forEach((band, i) =>
    band.points.forEach(([x, low, high]) => {
      cell(x, spec.series.length + 1 + 2 * i, low);
      cell(x, spec.series.length + 2 + 2 * i, high);
    }),
  );
  const ordered = [...rows.values()].sort((a, b) => a[0] - b[0]);
  const shown = ordered.filter((_, i) => i % Math.ceil(ordered.length / tableRowsShown) === 0);
  const format = (value) => (typeof value === "number" ? String(Number(value.toPrecision(9))) : value);
  const title =
    shown.length < ordered.length ? `${spec.title}: ${shown.length} of ${ordered.length} points` : spec.title;
  const formatOf = (index) => (index === 0 && spec.x.isText ? spec.x.layout.format : format);
  return sortedTable(
    title,
    columns.map((name, index) => ({ title: name, numeric: true, format: formatOf(index) })),
    shown,
  );
}

/**
 * A chart with its title, its summary for screen readers, and its data.
 *
 * spec: title; summary; x and y {label, layout, low, high, name}, x.isText where its values stand for texts; series [{name, colour, points [[x, y]],
 * dash, radius, isLine}]; bands [{name, colour, points [[x, low, high]]}]; onPick(series, point).
 * A y of null is a gap.
 */
class PageChart {
  /** @param {HTMLElement} host  its content is replaced */
  constructor(host, spec) {
    this.spec = spec;
    const canvas = element("canvas", { role: "img", "aria-label": `${spec.title}. ${spec.summary}` });
    const area = element("div", { class: `chart ${spec.isSmall ? "chart-small" : ""}` }, canvas);
    const figure = element(
      "figure",
      { class: "chart-figure" },
      element("figcaption", { text: spec.title }),
      area,
      this.disclosure(),
    );
    host.replaceChildren(figure);
    this.figure = figure;
    if (window.Chart === undefined) {
      area.replaceChildren(
        element("p", {
          class: "hint",
          text: "Charts are not drawn: Gnomon was built without Chart.js. The data are below.",
        }),
      );
      return;
    }
    Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
    this.chart = new Chart(canvas, chartConfig(spec));
    liveCharts.add(this);
  }

  disclosure() {
    const details = element("details", { class: "chart-data" }, element("summary", { text: "Data" }));
    details.addEventListener("toggle", () => {
      if (details.open && details.children.length === 1) {
        details.append(dataTable(this.spec));
      }
    });
    return details;
  }

  /** Takes the colours of the page's new mode. */
  restyle() {
    if (!this.figure.isConnected) {
      this.chart.destroy();
      liveCharts.delete(this);
      return;
    }
    Object.assign(this.chart.options, chartOptions(this.spec));
    this.chart.data = chartConfig(this.spec).data;
    this.chart.update();
  }

  /** Takes the size of a sheet of paper, or again that of its place on the screen. */
  fitPaper() {
    if (isOnPaper()) {
      this.chart.resize(this.spec.isSmall ? paperWidthPx / 2 : paperWidthPx, this.chart.height);
    } else {
      this.chart.resize();
    }
  }

  /** Moves the vertical line to an x value. */
  moveCursor(x) {
    if (this.chart !== undefined) {
      this.chart.gnomonCursor = this.spec.x.layout.forward(x);
      this.chart.draw();
    }
  }
}

/** Forgets charts that are no longer on the page. */
function dropDeadCharts() {
  for (const live of liveCharts) {
    if (!live.figure.isConnected) {
      live.chart.destroy();
      liveCharts.delete(live);
    }
  }
}

const restyleAll = () => [...liveCharts].forEach((live) => live.restyle());
darkMode.addEventListener("change", restyleAll);
onPaperChange(() => {
  restyleAll();
  liveCharts.forEach((live) => live.fitPaper());
});
