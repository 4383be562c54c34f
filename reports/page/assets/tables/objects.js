// Errors by object, by map and by cause of the shown configuration.

const countColumn = (title) => ({ title, numeric: true, format: grouped });
const rateColumn = (title) => ({ title, numeric: true, format: percent });

/**
 * A table of parts of the pixels, from `gnomon compare --json`.
 * @param {string} member  of a part: its name, and what it is
 */
function partTable(caption, member, parts) {
  const columns = [
    { title: member },
    countColumn("lit"),
    countColumn("blocked"),
    countColumn("false shadow"),
    rateColumn("of its lit"),
    countColumn("false lit"),
    rateColumn("of its blocked"),
    rateColumn("mean error"),
  ];
  const wrong = (part) => part.false_shadow + part.false_lit;
  const seen = parts.filter(({ lit, blocked }) => lit + blocked > 0).sort((a, b) => wrong(b) - wrong(a));
  return sortedTable(
    caption,
    columns,
    seen.map((part) => [
      part[member],
      part.lit,
      part.blocked,
      part.false_shadow,
      part.false_shadow_rate,
      part.false_lit,
      part.false_lit_rate,
      part.mean_abs_error,
    ]),
  );
}

/**
 * A table of wrong pixels by cause or by name, with a swatch each.
 * @param {?Object} amounts  by how much wrong and partial pixels are off [px]; null: not more than the counts say
 */
function kindTable(caption, heading, counts, amounts, colours) {
  const whole = Object.values(counts).reduce((sum, count) => sum + count, 0);
  const rows = Object.entries(counts).map(([name, count]) => {
    const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
    swatch.style.backgroundColor = colours[name];
    return element(
      "tr",
      {},
      element("th", { scope: "row" }, swatch, spoken(name)),
      element("td", { class: "number", text: grouped(count) }),
      element("td", { class: "number", text: percent(rate(count, whole)) }),
      ...(amounts === null ? [] : [element("td", { class: "number", text: groupedAmount(amounts[name]) })]),
    );
  });
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

/** Tables of causes and of names, side by side; with amounts where they are not the counts. */
function kindTables({ causes, labels, cause_amounts: causeAmounts, label_amounts: labelAmounts }) {
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
    if (detail?.causes && detail.labels) {
      refill(
        this.section,
        element("p", { class: "caption name", text: caption }),
        kindTables(detail),
        partTable("Errors by object, most errors first", "object", detail.by_object ?? []),
        ...(detail.by_map ? [partTable("Errors by map, most errors first", "map", detail.by_map)] : []),
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
