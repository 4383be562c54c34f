// Error against an axis of a sweep: one chart, or small ones by a second axis.

const mostPoints = 400;
const mostPanels = 12;

/** The measure that charts show at first. */
const firstMeasure = "error_rate";

/**
 * The metrics that the table has and charts show, rates before counts.
 * @param {{name: string, title: string, is_rate: boolean}[]} metrics
 * @param {Table} table
 * @return {{name: string, title: string, isRate: boolean}[]}
 */
function measuresOf(metrics, table) {
  const measures = metrics
    .filter(({ name, title }) => title !== "" && table.has(name))
    .map(({ name, title, is_rate: isRate }) => ({ name, title, isRate }));
  return [...measures.filter(({ isRate }) => isRate), ...measures.filter(({ isRate }) => !isRate)];
}

/** A value of an axis as text. */
function axisText(axis, value) {
  return axis.isText ? String(value) : readable(value);
}

/** How an axis lies on a chart: numbers by their size, texts evenly spaced. */
function axisSpec(axis) {
  const last = axis.values.length - 1;
  if (axis.isText) {
    const short = (place) => axis.values[Math.round(place)]?.slice(0, 18) ?? "";
    const layout = { ...linearLayout(short), ticks: () => axis.values.map((_, i) => i) };
    return { label: axis.name, layout, isText: true, low: -0.5, high: last + 0.5, at: (code) => code };
  }
  const ends = last > 0 ? { low: axis.values[0], high: axis.values[last] } : {};
  return { label: axis.name, layout: layoutForValues(axis.values), ...ends, at: (code) => axis.values[code] };
}

function measureSpec(measure, largest) {
  return measure.isRate
    ? { label: measure.title, layout: rateLayout(), low: 0, high: 1 }
    : { label: measure.title, layout: symlogLayout(1), low: 0, high: Math.max(1, largest) };
}

/** The colour of a measure: false shadow and false lit have theirs. */
function measureColour({ name }) {
  if (name.startsWith("false_lit")) {
    return errorColours.falseLit;
  }
  return name.startsWith("false_shadow") ? errorColours.falseShadow : okabeIto.green;
}

/** Where the median is lowest, in words; cases are what is looked at, and none is better than another. */
function lowestMedian(present, measure, x, axis) {
  if (present.length === 0) {
    return "No values.";
  }
  if (axis.name === "case") {
    return "";
  }
  const lowest = present.reduce((a, b) => (b.group.median < a.group.median ? b : a));
  const { median } = lowest.group;
  return `The median is lowest, ${measure.isRate ? percent(median) : readable(median)}, at ${x.layout.format(lowest.at)}.`;
}

/** Markers at the smallest and the largest value, for bars. */
function rangeMarkers(points) {
  const look = { colour: okabeIto.black, isLine: false, radius: 16, mark: "line" };
  return [
    { ...look, name: "smallest", points: points("least") },
    { ...look, name: "largest", points: points("most") },
  ];
}

/** One chart: the median line and the range band of summaries along an axis. */
function axisChart(host, axis, measure, groups, more) {
  const x = axisSpec(axis);
  const present = groups
    .map((group, code) => ({ group, at: x.at(code) }))
    .filter(({ group }) => group !== null);
  const colour = measureColour(measure);
  const points = (key) => present.map(({ group, at }) => [at, group[key]]);
  const isSpread = present.some(({ group }) => group.least < group.most);
  const bandPoints = present.map(({ group, at }) => [at, group.least, group.most]);
  const median = {
    name: isSpread ? "median" : measure.title,
    colour,
    points: points("median"),
    radius: present.length <= 40 ? 3 : 0,
    isBar: axis.isText,
  };
  return new PageChart(host, {
    x,
    y: measureSpec(measure, more.largest),
    isSmall: more.isSmall,
    hasLegend: !more.isSmall && isSpread,
    title: more.title,
    summary: lowestMedian(present, measure, x, axis),
    series: [median, ...(axis.isText && isSpread ? rangeMarkers(points) : [])],
    bands: axis.isText || !isSpread ? [] : [{ name: "range over the others", colour, points: bandPoints }],
  });
}

/** The part of section#sweep with error against one axis. */
class AxisCharts {
  /**
   * @param {Table} table
   * @param {Map<string, Axis>} axes
   * @param {object[]} metrics  as in the page's data
   */
  constructor(table, axes, metrics) {
    this.table = table;
    this.axes = axes;
    this.measures = measuresOf(metrics, table);
    this.chosen = { axis: this.mostInteresting(), measure: firstMeasure, by: "" };
    this.host = element("div", { class: "panels" });
    this.note = element("p", { class: "hint" });
    const heading = element("h3", { text: "Error against an axis" });
    this.root = element("div", {}, heading, this.makeControls(), this.note, this.host);
  }

  makeControls() {
    const names = [...this.axes.keys()].map((name) => [name, name]);
    const titles = this.measures.map(({ name, title }) => [name, title]);
    const select = (key, options) =>
      choice(options, this.chosen[key], (name) => this.choose({ [key]: name }));
    return element(
      "div",
      { class: "bar" },
      labelled("Error", select("measure", titles)),
      labelled("against", select("axis", names)),
      labelled("one panel for each", select("by", [["", "– (one chart)"], ...names])),
    );
  }

  /** The axis with the most values, of several the last: the one that is most of a curve. */
  mostInteresting() {
    return [...this.axes.values()].reduce((a, b) => (b.values.length >= a.values.length ? b : a)).name;
  }

  choose(change) {
    Object.assign(this.chosen, change);
    return this.draw();
  }

  async draw() {
    const { axis: name, measure: measureName, by } = this.chosen;
    const measure = this.measures.find((candidate) => candidate.name === measureName);
    const axis = joinValues(this.axes.get(name), mostPoints);
    const { values } = await this.table.column(measureName);
    const panels = by === "" || by === name ? null : joinValues(this.axes.get(by), mostPanels);
    this.describe(axis, panels);
    if (panels === null) {
      const groups = summariseGroups(values, axis.codes, axis.values.length);
      this.drawPanels([{ groups, title: `${measure.title} against ${name}` }], axis, measure, false);
    } else {
      const cells = summariseGroups(
        values,
        cellCodes(panels, axis),
        panels.values.length * axis.values.length,
      );
      const of = (i) => cells.slice(i * axis.values.length, (i + 1) * axis.values.length);
      this.drawPanels(
        panels.values.map((value, i) => ({ groups: of(i), title: `${by} = ${axisText(panels, value)}` })),
        axis,
        measure,
        true,
      );
    }
    dropDeadCharts();
  }

  describe(axis, panels) {
    const others = [...this.axes.keys()].filter((name) => name !== axis.name && name !== panels?.name);
    const spread = others.length === 0 ? "" : ` Median and range over ${others.join(", ")}.`;
    const whole = this.axes.get(axis.name).values.length;
    const joined =
      whole > axis.values.length ? ` ${grouped(whole)} values are merged into ${axis.values.length}.` : "";
    this.note.textContent = `${spread}${joined}`.trim();
    this.note.hidden = this.note.textContent === "";
  }

  drawPanels(panels, axis, measure, isSmall) {
    const hosts = panels.map(() => element("div", { class: "chart-host" }));
    this.host.className = isSmall ? "panels panels-small" : "panels";
    this.host.replaceChildren(...hosts);
    const largest = largestOf(panels.flatMap(({ groups }) => groups.map((group) => group?.most)));
    panels.forEach(({ groups, title }, i) =>
      axisChart(hosts[i], axis, measure, groups, { title, isSmall, largest }),
    );
  }
}
