// Two axes of a sweep at once: the median error of each cell on the fixed scale of rates.

const mostTableColumns = 12;
const mostTableRows = 24;
const mostCanvasCells = 240;
const mostHeatTicks = 6;

/** Black or white, whichever is read more easily on a colour. */
function inkOn([red, green, blue]) {
  const linear = (value) => ((value / 255 + 0.055) / 1.055) ** 2.4;
  return 0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue) > 0.179
    ? "#000000"
    : "#FFFFFF";
}

/** A table with a coloured cell for each pair of values. */
function heatTable(across, down, cells, title) {
  const head = element(
    "tr",
    {},
    element("th", { scope: "col", text: `${down.name} ↓  ${across.name} →` }),
    ...across.values.map((value) =>
      element("th", { scope: "col", class: "number", text: axisText(across, value) }),
    ),
  );
  const rows = down.values.map((value, rowIndex) => {
    const tds = across.values.map((_, column) => {
      const cell = cells[column * down.values.length + rowIndex];
      const td = element("td", {
        class: "number heat",
        text: cell === null ? noValue : percent(cell.median),
      });
      if (cell !== null) {
        const colour = mixStops(rateScale.stops, shareOnScale(rateScale, cell.median));
        td.style.backgroundColor = cssColour(colour);
        td.style.color = inkOn(colour);
      }
      return td;
    });
    return element("tr", {}, element("th", { scope: "row", text: axisText(down, value) }), ...tds);
  });
  return scroller(
    title,
    element(
      "table",
      { class: "heat-table" },
      element("caption", { text: title }),
      element("thead", {}, head),
      element("tbody", {}, ...rows),
    ),
  );
}

/** Values along a side of the canvas, where their cells are: the first, the last, and some between. */
function heatTicks(axis, side) {
  const last = axis.values.length - 1;
  const count = Math.min(last + 1, mostHeatTicks);
  const ticks = Array.from({ length: count }, (_, i) => {
    const index = count > 1 ? Math.round((i * last) / (count - 1)) : 0;
    const tick = element("span", { text: axisText(axis, axis.values[index]) });
    tick.style.setProperty("--at", `${(100 * (index + 0.5)) / (last + 1)}%`);
    return tick;
  });
  return element("div", { class: `heat-ticks heat-${side}`, "aria-hidden": "true" }, ...ticks);
}

/** A canvas of one pixel a cell, stretched; the cell under the pointer is told beneath. */
function heatCanvas(across, down, cells, title) {
  const canvas = element("canvas", {
    width: across.values.length,
    height: down.values.length,
    class: "heat-canvas",
    role: "img",
    "aria-label": `${title}. The same numbers are in the table below.`,
  });
  const context = canvas.getContext("2d");
  cells.forEach((cell, i) => {
    const row = i % down.values.length;
    context.fillStyle =
      cell === null
        ? noValueColour
        : cssColour(mixStops(rateScale.stops, shareOnScale(rateScale, cell.median)));
    context.fillRect(Math.floor(i / down.values.length), row, 1, 1);
  });
  const ends = (axis) => `from ${axisText(axis, axis.values[0])} to ${axisText(axis, axis.values.at(-1))}`;
  const told = element("p", {
    class: "hint",
    text: `${across.name} ${ends(across)} to the right, ${down.name} ${ends(down)} downwards.`,
  });
  told.append(element("span", { class: "screen", text: " Point at a cell for its number." }));
  canvas.addEventListener("pointermove", (event) => {
    const column = Math.min(
      across.values.length - 1,
      Math.floor((event.offsetX / canvas.clientWidth) * across.values.length),
    );
    const row = Math.min(
      down.values.length - 1,
      Math.floor((event.offsetY / canvas.clientHeight) * down.values.length),
    );
    const cell = cells[column * down.values.length + row];
    const at = `${across.name} = ${axisText(across, across.values[column])}, ${down.name} = ${axisText(down, down.values[row])}`;
    told.textContent = `${at}: ${cell ? percent(cell.median) : noValue}`;
  });
  const framed = element(
    "div",
    { class: "heat-frame" },
    heatTicks(down, "down"),
    canvas,
    heatTicks(across, "across"),
  );
  return element("div", {}, framed, told);
}

/** The part of section#sweep with the heat map of two axes. */
class HeatMap {
  /**
   * @param {Table} table
   * @param {Map<string, Axis>} axes
   * @param {object[]} metrics  as in the page's data
   */
  constructor(table, axes, metrics) {
    this.table = table;
    this.axes = axes;
    this.rates = measuresOf(metrics, table).filter(({ isRate }) => isRate);
    const names = [...axes.keys()];
    const options = names.map((name) => [name, name]);
    this.chosen = { measure: firstMeasure, across: names[0], down: names[1] };
    this.host = element("div");
    const select = (key, choices) => choice(choices, this.chosen[key], (value) => this.choose(key, value));
    this.root = element(
      "div",
      {},
      element("h3", { text: "Two axes at once" }),
      element(
        "div",
        { class: "bar" },
        labelled(
          "Median of the",
          select(
            "measure",
            this.rates.map(({ name, title }) => [name, title]),
          ),
        ),
        labelled("across", select("across", options)),
        labelled("down", select("down", options)),
      ),
      this.host,
      rampLegend(rateScale, { low: "no errors", high: "all wrong" }),
    );
  }

  choose(key, value) {
    this.chosen[key] = value;
    return this.draw();
  }

  summarise(values, mostAcross, mostDown) {
    const across = joinValues(this.axes.get(this.chosen.across), mostAcross);
    const down = joinValues(this.axes.get(this.chosen.down), mostDown);
    return {
      across,
      down,
      cells: summariseGroups(values, cellCodes(across, down), across.values.length * down.values.length),
    };
  }

  async draw() {
    const { values } = await this.table.column(this.chosen.measure);
    const title = `${this.rates.find(({ name }) => name === this.chosen.measure).title}, median of each cell`;
    const small = this.summarise(values, mostTableColumns, mostTableRows);
    const table = heatTable(small.across, small.down, small.cells, title);
    const isWhole =
      this.axes.get(this.chosen.across).values.length <= mostTableColumns &&
      this.axes.get(this.chosen.down).values.length <= mostTableRows;
    if (isWhole) {
      this.host.replaceChildren(table);
      return;
    }
    const fine = this.summarise(values, mostCanvasCells, mostCanvasCells);
    this.host.replaceChildren(
      heatCanvas(fine.across, fine.down, fine.cells, title),
      element(
        "details",
        { class: "chart-data" },
        element("summary", { text: "Data, neighbouring values merged" }),
        table,
      ),
    );
  }
}
