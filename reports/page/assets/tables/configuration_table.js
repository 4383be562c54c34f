// The sweep's table with its filter and its choice of columns.

/** The part of section#sweep with the table of configurations. */
class ConfigurationTable {
  /**
   * @param {Table} table
   * @param {string[]} axes  names of the sweep's axes
   * @param {object[]} metrics  as in the page's data
   * @param {boolean} hasFailures  then status and message are shown at first
   * @param {function(number)} onOpen
   */
  constructor(table, axes, metrics, hasFailures, onOpen) {
    this.table = table;
    this.words = table.names.filter(
      (name) => (table.isText(name) && !["id", "curve"].includes(name)) || axes.includes(name),
    );
    const errors = ["error_rate", "mean_abs_error"];
    const varying = axes.filter((name) => !table.constants.has(name));
    const isNarrow = window.matchMedia("(max-width: 40rem)").matches;
    const outcomes = metrics.filter(({ is_outcome: isOutcome }) => isOutcome).map(({ name }) => name);
    const first = [
      ...(isNarrow ? [...errors, ...varying] : [...varying, ...errors]),
      ...(hasFailures ? ["status", "message"] : []),
      ...outcomes.filter((name) => !errors.includes(name)),
      ...(table.has("ordinal") ? ["ordinal"] : []),
    ];
    this.rows = new RowTable(
      table,
      first.filter((name) => table.has(name) && !(table.constants.has(name) && name === "status")),
      errors.findLast((name) => table.has(name)) ?? null,
      "All configurations of the sweep",
      onOpen,
    );
    this.field = element("input", {
      type: "search",
      class: "filter",
      autocomplete: "off",
      spellcheck: "false",
      placeholder: "false_lit < 100 resolution=2048",
      on: { input: () => this.filterSoon() },
    });
    this.said = element("p", { class: "hint", role: "status" });
    this.paperNote = element("p", {
      class: "hint paper",
      text: `The first ${rowsOnPaper} rows are printed. All of them are in results.csv.`,
    });
    this.filterSoon = oncePerFrame(() => this.filter());
    this.root = element(
      "div",
      {},
      element("h3", { text: "All configurations" }),
      element("div", { class: "bar" }, labelled("Filter", this.field, "control grow")),
      this.columnChooser(),
      this.said,
      this.rows.scroll,
      this.paperNote,
      element("p", {
        class: "hint screen",
        text: "Click a row, or press Enter on it, to see the configuration. Click a heading to sort.",
      }),
    );
  }

  async load() {
    await this.rows.load();
    this.sayCount();
  }

  sayCount() {
    const shown = this.rows.rows.length;
    this.said.textContent =
      shown === this.table.count
        ? `${grouped(shown)} configurations`
        : `${grouped(shown)} of ${grouped(this.table.count)} configurations`;
    this.said.classList.remove("problem");
    this.paperNote.hidden = shown <= rowsOnPaper;
  }

  async filter() {
    try {
      const text = this.field.value;
      const kept = await filterRows(this.table, this.words, text);
      if (text === this.field.value) {
        await this.rows.keep(kept);
        this.sayCount();
      }
      this.field.setAttribute("aria-invalid", "false");
    } catch (error) {
      this.field.setAttribute("aria-invalid", "true");
      this.said.textContent = `${error.message}; the rows are unchanged.`;
      this.said.classList.add("problem");
    }
  }

  columnChooser() {
    const constant = this.rows.shown.filter((name) => this.table.constants.has(name));
    const boxes = [...this.table.names, ...constant].map((name) => {
      const box = element("input", {
        type: "checkbox",
        value: name,
        on: { change: () => this.takeColumns(boxes) },
      });
      box.checked = this.rows.shown.includes(name);
      return element("label", { class: "check" }, box, name);
    });
    return element(
      "details",
      { class: "columns" },
      element("summary", { text: "Columns" }),
      element(
        "fieldset",
        {},
        element("legend", { class: "visually-hidden", text: "Columns of the table" }),
        ...boxes,
      ),
    );
  }

  takeColumns(boxes) {
    const checked = boxes
      .map((label) => label.firstChild)
      .filter((box) => box.checked)
      .map((box) => box.value);
    const before = this.rows.shown.filter((name) => checked.includes(name));
    return this.rows.showColumns([...before, ...checked.filter((name) => !before.includes(name))]);
  }
}
