// One configuration of a sweep: its values, its causes, and how to see its pixels.

/** Titles of the groups of values, by how their columns begin. */
const valueGroups = [
  ["Settings", ["scene.", "camera.", "image.", "light.", "shadow_map.", "lookup.", "bias."]],
  ["Errors", ["false_", "error_rate", "mean_abs_error", "peter_panning_gap"]],
  ["Bias curve", ["bias_curve."]],
  ["Pixels", ["pixels.", "unmatched_kinds.", "indeterminate_kinds."]],
];

function groupOf(name) {
  return valueGroups.find(([, starts]) => starts.some((start) => name.startsWith(start)))?.[0] ?? "Other";
}

function valueText(name, value) {
  return typeof value === "number"
    ? name.endsWith("_rate")
      ? `${value} (${percent(value)})`
      : String(value)
    : value;
}

/** A definition list of names and values. */
function valueList(title, entries) {
  const facts = entries.map(([name, value]) =>
    element(
      "div",
      { class: "fact" },
      element("dt", { text: name }),
      element("dd", { "data-column": name }, nameElement(valueText(name, value))),
    ),
  );
  return element(
    "details",
    { class: "values", open: title === "Settings" || title === "Errors" },
    element("summary", { text: title }),
    element("dl", { class: "facts" }, ...facts),
  );
}

/** Counts of columns `stem.…` by what follows; null without any. */
function countsOf(values, stem) {
  const entries = [...values].filter(([name, value]) => name.startsWith(stem) && value !== null);
  return entries.length === 0
    ? null
    : Object.fromEntries(entries.map(([name, value]) => [name.slice(stem.length), value]));
}

/** A word as a shell reads it back. */
function shellWord(word) {
  return /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

/** The command that measures one configuration alone, with its layers. */
function compareCommand(run, values) {
  const chosen = values.get("case") ?? null;
  const words = chosen === null ? [] : ["--case", String(chosen)];
  run.axes.forEach((axis) => {
    const value = values.get(axis) ?? "";
    words.push(...(axis === "light" ? [`--light=${value}`] : ["--set", `${axis}=${value}`]));
  });
  return [run.compare_command, ...words.map(shellWord), "--out DIR"].join(" ");
}

/** The part of section#sweep that shows the clicked configuration. */
class ConfigurationDetail {
  /**
   * @param {Table} table
   * @param {object} run  as in the page's data
   */
  constructor(table, run) {
    this.table = table;
    this.run = run;
    this.heading = element("h3", { "aria-live": "polite", text: "Configuration" });
    this.host = element("div");
    this.root = element("div", { class: "configuration", hidden: true }, this.heading, this.host);
  }

  /** @param {boolean} hasImage  whether the inspector shows its pixels */
  async show(row, title, hasImage) {
    const columns = await this.table.select(this.table.allNames);
    const values = new Map([...columns].map(([name, column]) => [name, column.at(row)]));
    const groups = new Map(valueGroups.map(([name]) => [name, []]).concat([["Other", []]]));
    const shown = [...values].filter(([name, value]) => value !== null && !/^(causes|labels|cause_amounts|label_amounts)\./.test(name));
    shown.forEach(([name, value]) => groups.get(groupOf(name)).push([name, value]));
    const kinds = Object.fromEntries(
      ["causes", "labels", "cause_amounts", "label_amounts"].map((name) => [name, countsOf(values, `${name}.`)]),
    );
    this.heading.textContent = title;
    this.host.replaceChildren(
      this.pixelsLine(values, hasImage),
      ...(values.get("status") === "done" ? [kindTables(kinds)] : []),
      ...[...groups]
        .filter(([, entries]) => entries.length > 0)
        .map(([name, entries]) => valueList(name, entries)),
    );
    this.root.hidden = false;
  }

  pixelsLine(values, hasImage) {
    if (hasImage) {
      return element(
        "p",
        {},
        "Its pixels are in the ",
        element("a", { href: "#inspector", text: "pixel inspector" }),
        ", and the charts by distance and angle belong to it.",
      );
    }
    if (values.get("status") !== "done") {
      return element("p", { text: values.get("message") ?? "It was not measured." });
    }
    const id = values.get("id");
    const command = (text) => element("pre", {}, element("code", { text }));
    return element(
      "div",
      {},
      ...(id && this.run.command.startsWith("gnomon sweep ")
        ? [
            element("p", { text: "The page does not hold this configuration’s pixels. For a page that does, run:" }),
            command(["gnomon report", shellWord(this.run.folder), "--configuration", id].join(" ")),
            element("p", { text: "To compare it alone:" }),
          ]
        : [element("p", { text: "The page does not hold this configuration’s pixels. To create them, run:" })]),
      command(compareCommand(this.run, values)),
    );
  }
}
