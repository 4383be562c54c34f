// False shadow against false lit of all configurations, and the front that no other beats.

const mostDots = 5000;

/** The part of section#sweep with the Pareto front. */
class ParetoChart {
  /**
   * @param {Table} table
   * @param {string[]} axes  names of the sweep's axes
   * @param {function(number)} onShow  shows a configuration
   */
  constructor(table, axes, onShow) {
    Object.assign(this, { table, axes, onShow });
    this.host = element("div", { class: "chart-host" });
    this.list = element("div");
    this.root = element(
      "div",
      {},
      element("h3", { text: "Trading false shadow for false lit" }),
      element("p", {
        class: "hint",
        text: "For a configuration on the front, no other has fewer errors of one kind without more of the other.",
      }),
      this.host,
      this.list,
    );
  }

  async draw() {
    const names = ["false_shadow_rate", "false_lit_rate"];
    const columns = await this.table.select([...names, ...this.axes, "map_bytes"]);
    const [first, second] = names.map((name) => columns.get(name).values);
    const front = paretoFront(first, second, columns.get("map_bytes")?.values);
    const dots = thinnedRows(first, second, mostDots);
    const pointsOf = (rows) => rows.map((row) => [first[row], second[row]]);
    const x = { label: "false-shadow rate", layout: rateLayout(), low: 0, high: 1 };
    this.chart = new PageChart(this.host, {
      title: "Pareto front of all configurations",
      isScatter: true,
      x,
      y: { ...x, label: "false-lit rate" },
      summary: `On the front: ${grouped(front.length)} of ${grouped(this.table.count)} configurations.`,
      series: [
        {
          name: "Pareto front",
          colour: okabeIto.vermilion,
          points: pointsOf(front),
          radius: 3,
          stepped: "before",
        },
        {
          name:
            dots.length < this.table.count
              ? `${grouped(dots.length)} of ${grouped(this.table.count)} configurations`
              : "configurations",
          colour: okabeIto.blue,
          points: pointsOf(dots),
          isLine: false,
          radius: 1.5,
        },
      ],
      onPick: (series, point) => this.onShow((series === 0 ? front : dots)[point]),
    });
    this.list.replaceChildren(this.frontTable(front, columns, first, second));
  }

  frontTable(front, columns, first, second) {
    const shown = front.filter((_, i) => i % Math.ceil(front.length / 200) === 0);
    const heads = [
      { title: "configuration", numeric: true, format: grouped },
      ...this.axes.map((name) => ({
        title: name,
        numeric: !columns.get(name).isText,
        format: (value) => (typeof value === "number" ? readable(value) : value),
      })),
      { title: "false-shadow rate", numeric: true, format: percent },
      { title: "false-lit rate", numeric: true, format: percent },
    ];
    const rows = shown.map((row) => [
      row,
      ...this.axes.map((name) => columns.get(name).at(row)),
      first[row],
      second[row],
    ]);
    const title =
      shown.length < front.length
        ? `The front: ${shown.length} of its ${grouped(front.length)} configurations`
        : "The front";
    return element(
      "details",
      { class: "chart-data" },
      element("summary", {
        text:
          front.length === 1
            ? "The configuration on the front"
            : `The ${grouped(front.length)} configurations on the front`,
      }),
      sortedTable(title, heads, rows),
    );
  }
}
