// Small tables whose headings sort them.

/**
 * @param {string} caption
 * @param {{title: string, numeric: boolean, wraps: boolean, format: ?function, colours: ?object}[]} columns  the first
 *     one heads the row; texts are cut unless they wrap; colours, by value, give it a swatch
 * @param {Array[]} rows  values; null where there is none
 * @return {HTMLElement}  a scrolling region with the table
 */
function sortedTable(caption, columns, rows) {
  const body = element("tbody");
  const headings = columns.map((column, index) => {
    const control = button(column.title, () => sortBy(index), { class: "sort" });
    return element("th", { scope: "col", class: column.numeric ? "number" : null }, control);
  });
  const fill = (ordered) => body.replaceChildren(...ordered.map((row) => tableRow(columns, row)));
  const sortBy = (index) => {
    const descending =
      (headings[index].getAttribute("aria-sort") !== "descending" && columns[index].numeric) ||
      headings[index].getAttribute("aria-sort") === "ascending";
    headings.forEach((heading) => heading.removeAttribute("aria-sort"));
    headings[index].setAttribute("aria-sort", descending ? "descending" : "ascending");
    fill([...rows].sort((a, b) => compareValues(a[index], b[index], descending)));
  };
  fill(rows);
  const head = element("thead", {}, element("tr", {}, ...headings));
  return scroller(caption, element("table", {}, element("caption", { text: caption }), head, body));
}

/** One row of a table. */
function tableRow(columns, row) {
  const cells = row.map((value, index) => {
    const { numeric, wraps, format, colours } = columns[index];
    const tag = index === 0 ? "th" : "td";
    const text = value === null ? noValue : (format ?? String)(value);
    return element(
      tag,
      { scope: index === 0 ? "row" : null, class: numeric ? "number" : null },
      ...(colours?.[value] === undefined ? [] : [swatchElement(colours[value])]),
      numeric || wraps ? text : nameElement(text),
    );
  });
  return element("tr", {}, ...cells);
}

/** Orders numbers or texts; what has no value stands last in either direction. */
function compareValues(a, b, descending) {
  if (a === null || b === null) {
    return (a === null ? 1 : 0) - (b === null ? 1 : 0);
  }
  const order = a < b ? -1 : a > b ? 1 : 0;
  return descending ? -order : order;
}
