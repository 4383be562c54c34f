// Reads the page's data and fills its sections.

/** Everything that the sections share: the tables, the images, and which configuration is shown. */
class ReportPage {
  constructor(data) {
    this.data = data;
    this.reader = new BlockReader((id) => document.getElementById(id).textContent);
    this.table = new Table(data.table, this.reader, data.constants);
    const empty = { count: 0, columns: [] };
    this.bins = new DistanceBins(
      new Table(data.error_vs_z ?? empty, this.reader),
      new Table(data.curves ?? empty, this.reader),
    );
    this.images = new Map((data.images ?? []).map((image) => [image.row, image]));
    const section = (id) => document.getElementById(id);
    this.inspector = this.images.size > 0 ? new Inspector(section("inspector")) : null;
    this.distance = new DistanceCharts(section("distance"));
    this.slope = section("slope");
    this.objects = new ObjectTables(section("objects"), data.headline);
    this.remedies = new RemedySection(section("biases"), section("remedies"), this.table.count > 1);
    const axes = data.run.axes;
    this.lights = axes.includes("light") ? new LightChoice(this.table, axes, (row) => this.show(row)) : null;
  }

  async open() {
    if (this.data.against) {
      this.inspector?.compareWith(await loadImage(this.data.against, this.reader));
    }
    if (this.lights !== null) {
      document.getElementById("inspector").before(await this.lights.open());
    }
    const [firstImage] = this.images.keys();
    await this.show(
      this.images.has(this.data.headline) ? this.data.headline : (firstImage ?? this.data.headline ?? 0),
    );
    if (this.table.count > 1) {
      await this.openSweep();
    }
    listSections();
  }

  async openSweep() {
    const section = document.getElementById("sweep");
    section.hidden = false;
    this.sweep = new SweepSection(section, this, (row) => this.show(row));
    await this.sweep.open();
  }

  /** What a configuration is called: its place, its case, and the values of the axes, numbers to four digits. */
  async caption(row) {
    if (this.table.count === 1) {
      return "";
    }
    const names = [...(this.table.has("case") ? ["case"] : []), ...this.data.run.axes];
    const axes = await this.table.select(names);
    const values = [...axes].map(([name, column]) => `${name} = ${column.isText ? column.at(row) : readable(column.at(row)).replaceAll(",", "")}`);
    return [`Configuration ${row}`, ...values].join(", ");
  }

  /** What a column holds in a row; null where it holds nothing, or there is none. */
  async valueOf(name, row) {
    return this.table.has(name) ? (await this.table.column(name)).at(row) : null;
  }

  /**
   * Bins by light distance of a configuration: at its own bias, and at the best one of its curve.
   * @return {Promise<{own: ?object, best: ?object}>}  {bias, bins} each
   */
  async distanceBins(row, curveId, stored) {
    const [job, best] = await Promise.all(["job_bias", "best_bias"].map((at) => this.bins.of(curveId, at)));
    const bins = stored?.detail?.by_light_distance_m;
    const own = bins
      ? { bias: stored.bias_constant, bins: bins.map(binOfJson) }
      : ownBlock(job, await this.valueOf("bias.constant", row), this.data.run.axes);
    return { own, best: best[0] ?? null };
  }

  /** Shows a configuration in every section that has something of it. */
  async show(row) {
    this.shown = row;
    const caption = await this.caption(row);
    const stored = this.images.get(row);
    const curveId = await this.valueOf("curve", row);
    const distance = await this.distanceBins(row, curveId, stored);
    const image = stored === undefined ? null : await loadImage(stored, this.reader);
    if (image !== null) {
      image.amounts = await loadCurveAmounts(this.data.curves, this.reader, curveId);
    }
    if (this.shown !== row) {
      return;
    }
    const detail = stored?.detail ?? null;
    this.lights?.follow(row);
    if (image !== null) {
      this.inspector.show(image, caption);
    }
    this.distance.show(distance, caption);
    showSlopeCharts(this.slope, detail?.by_receiver_angle_rad?.map(binOfJson), caption);
    this.objects.show(row, detail, caption);
    this.remedies.show(detail, caption);
    await this.sweep?.showDetail(row, caption, image !== null);
    listSections();
    dropDeadCharts();
  }
}

/** Fills section#sweep. */
class SweepSection {
  constructor(section, page, onShow) {
    Object.assign(this, { section, page, onShow, table: page.table });
  }

  async open() {
    const { data } = this.page;
    const columns = await this.table.select(data.run.axes);
    const axes = new Map(
      [...columns]
        .map(([name, column]) => [name, axisOfColumn(column)])
        .filter(([, axis]) => axis.values.length > 1),
    );
    const names = [...columns.keys()];
    this.detail = new ConfigurationDetail(this.table, data.run);
    this.rows = new ConfigurationTable(this.table, names, data.metrics, data.run.failed > 0, this.onShow);
    const hasRates = this.table.has("error_rate");
    const parts = [
      hasRates && axes.size > 0 ? new AxisCharts(this.table, axes, data.metrics) : null,
      hasRates && axes.size > 1
        ? new HeatMap(
            this.table,
            byEffect(axes, (await this.table.column("error_rate")).values),
            data.metrics,
          )
        : null,
      this.table.has("false_shadow_rate") && this.table.has("false_lit_rate")
        ? new ParetoChart(this.table, names, this.onShow)
        : null,
    ].filter((part) => part !== null);
    refill(this.section, ...parts.map((part) => part.root), this.rows.root, this.detail.root);
    await this.rows.load();
    this.rows.rows.setOpen(this.page.shown);
    for (const part of parts) {
      await part.draw();
    }
  }

  async showDetail(row, caption, hasImage) {
    this.rows.rows.setOpen(row);
    await this.detail.show(row, caption, hasImage);
  }
}

/** Lets the keyboard scroll the wide tables that the page came with. */
function letTablesScroll() {
  for (const wide of document.querySelectorAll(".scroll:not([tabindex])")) {
    wide.tabIndex = 0;
    wide.setAttribute("role", "region");
    wide.setAttribute("aria-label", wide.querySelector("caption")?.textContent ?? "Table");
  }
}

/** Says in words why the page stays as it was written. */
function reportFailure(text) {
  document.querySelector("main").prepend(element("p", { role: "alert", class: "problem", text }));
}

async function startPage() {
  letTablesScroll();
  openFirstScreen();
  if (window.DecompressionStream === undefined || window.ResizeObserver === undefined) {
    reportFailure(
      "This browser cannot unpack the page’s data (it has no DecompressionStream), so the inspector and the interactive charts are left out. Browsers released since 2023 have it.",
    );
    return;
  }
  try {
    await new ReportPage(JSON.parse(document.getElementById("gnomon-data").textContent)).open();
    document.documentElement.dataset.ready = "true";
  } catch (error) {
    reportFailure(`The interactive parts of the page could not be built: ${error.message}`);
    throw error;
  }
}

startPage();
