// Errors by object and by cause of the shown configuration, and by map where its light has several.

const partColumn = (title, member, format) => ({ title, numeric: true, format, valueOf: (part) => part[member] });
const errorColumns = [
  partColumn("lit", "lit", grouped),
  partColumn("blocked", "blocked", grouped),
  partColumn("false shadow", "false_shadow", grouped),
  partColumn("of its lit", "false_shadow_rate", percent),
  partColumn("false lit", "false_lit", grouped),
  partColumn("of its blocked", "false_lit_rate", percent),
  partColumn("mean error", "mean_abs_error", percent),
];

/**
 * A table of parts of the pixels and their errors, from `gnomon compare --json`.
 * @param {object[]} columns  of sortedTable, each with its valueOf(part); the errors follow them
 */
function partTable(caption, columns, parts) {
  const all = [...columns, ...errorColumns];
  return sortedTable(
    caption,
    all,
    parts.map((part) => all.map(({ valueOf }) => valueOf(part))),
  );
}

function objectTable(objects) {
  const wrong = (object) => object.false_shadow + object.false_lit;
  const seen = objects.filter(({ lit, blocked }) => lit + blocked > 0).sort((a, b) => wrong(b) - wrong(a));
  const name = { title: "object", valueOf: ({ object }) => object };
  return partTable("Errors by object, most errors first", [name], seen);
}

/**
 * A table of wrong pixels by cause or by name, with a swatch each.
 * @param {?Object} amounts  by how much wrong and partial pixels are off [px]; null: not more than the counts say
 */
function kindTable(caption, heading, counts, amounts, colours) {
  const whole = Object.values(counts).reduce((sum, count) => sum + count, 0);
  const rows = Object.entries(counts).map(([name, count]) =>
    element(
      "tr",
      {},
      element("th", { scope: "row" }, swatchElement(colours[name]), spoken(name)),
      element("td", { class: "number", text: grouped(count) }),
      element("td", { class: "number", text: percent(rate(count, whole)) }),
      ...(amounts === null ? [] : [element("td", { class: "number", text: groupedAmount(amounts[name]) })]),
    ),
  );
  const head = element(
    "tr",
    {},
    element("th", { scope: "col", text: heading }),
    element("th", { scope: "col", class: "number", text: "pixels" }),
    element("th", { scope: "col", class: "number", text: "of wrong" }),
    ...(amounts === null ? [] : [element("th", { scope: "col", class: "number", text: "amount [px]" })]),
  );
  return scroller(
    caption,
    element(
      "table",
      {},
      element("caption", { text: caption }),
      element("thead", {}, head),
      element("tbody", {}, ...rows),
    ),
  );
}

/** Tables of causes and of names, side by side; with amounts where they are not the counts. Or that they are not known. */
function kindTables({ causes, labels, cause_amounts: causeAmounts, label_amounts: labelAmounts }) {
  if (!causes || !labels) {
    const text = "Causes and names of the errors are not known: the renderer told too little of its lookups.";
    return element("p", { class: "hint", text });
  }
  const isMore = Object.entries(causeAmounts ?? {}).some(([name, amount]) => amount !== causes[name]);
  return element(
    "div",
    { class: "side-by-side" },
    kindTable("Wrong pixels by cause", "cause", causes, isMore ? causeAmounts : null, causeColours),
    kindTable("Wrong pixels by name", "name", labels, isMore ? labelAmounts : null, labelColours),
  );
}

/** Fills section#objects; without a detail it gives back what the page came with, or says why not. */
class ObjectTables {
  constructor(section, headline) {
    this.section = section;
    this.headline = headline;
    this.original = [...section.children];
  }

  show(row, detail, caption) {
    this.section.hidden = this.headline === null && !detail;
    if (detail) {
      refill(
        this.section,
        element("p", { class: "caption name", text: caption }),
        kindTables(detail),
        objectTable(detail.by_object ?? []),
        ...(detail.by_map ? mapParts(detail.by_map) : []),
      );
    } else if (row === this.headline) {
      this.section.replaceChildren(...this.original);
    } else {
      refill(
        this.section,
        element("p", { class: "caption name", text: caption }),
        element("p", {
          class: "hint",
          text: "Errors by object are not known for this configuration: its pixels were not stored. Its causes are listed below the table of all configurations.",
        }),
      );
    }
  }
}
