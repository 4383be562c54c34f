// The table of all configurations: only the rows in sight are on the page.

const rowHeightPx = 32;
const spareRows = 8;
const rowsOnPaper = 40;
const narrowestColumnPx = 92;
const widestColumnPx = 280;
const letterPx = 9;
const cellPaddingPx = 28;

/**
 * Orders rows by a column; what has no value stands last in either direction.
 * @param {Uint32Array} rows  ordered in place
 * @param {Column} column
 */
function sortRows(rows, column, descending) {
  const { values } = column;
  let keys = values;
  if (column.isText) {
    const order = column.dictionary
      .map((_, code) => code)
      .sort((a, b) => (column.dictionary[a] < column.dictionary[b] ? -1 : 1));
    const rankOf = new Float64Array(order.length);
    order.forEach((code, rank) => {
      rankOf[code] = rank;
    });
    keys = Float64Array.from(values, (code) => (code === noIndex ? NaN : rankOf[code]));
  }
  const sign = descending ? -1 : 1;
  rows.sort((a, b) => {
    const order = sign * (keys[a] - keys[b]);
    return Number.isNaN(order) ? Number.isNaN(keys[a]) - Number.isNaN(keys[b]) || a - b : order || a - b;
  });
}

/** A width in which texts can be read, and headings that break behind dots and underscores. */
function columnWidthPx({ name, dictionary }) {
  const longest = (texts) => texts.reduce((most, { length }) => Math.max(most, length), 0);
  const letters = Math.max(longest(name.match(breakableParts)), longest(dictionary ?? []));
  return Math.min(widestColumnPx, Math.max(narrowestColumnPx, cellPaddingPx + letterPx * letters));
}

/** A virtualised table; calls onOpen(row) at a click or Enter. */
class RowTable {
  /**
   * @param {Table} table
   * @param {string[]} columns  names of those that are shown
   * @param {?string} sortedBy  the column by which rows ascend at first
   * @param {string} caption
   * @param {function(number)} onOpen
   */
  constructor(table, columns, sortedBy, caption, onOpen) {
    const sorted = sortedBy === null ? null : { name: sortedBy, descending: false };
    Object.assign(this, { table, shown: columns, onOpen, active: 0, open: -1, sorted });
    this.rows = allRows(table.count);
    this.head = element("thead");
    this.body = element("tbody");
    this.grid = element(
      "table",
      { role: "grid", tabindex: 0, class: "rows", "aria-multiselectable": "false" },
      element("caption", { class: "visually-hidden", text: caption }),
      this.head,
      this.body,
    );
    this.scroll = element("div", { class: "rows-scroll" }, this.grid);
    this.draw = oncePerFrame(() => this.drawNow());
    this.scroll.addEventListener("scroll", this.draw, { passive: true });
    this.grid.addEventListener("keydown", (event) => this.key(event));
    this.body.addEventListener("click", (event) => this.click(event));
    new ResizeObserver(this.draw).observe(this.scroll);
    onPaperChange(() => this.drawNow());
  }

  /** Decodes the shown columns and draws. */
  async load() {
    if (this.columns === undefined) {
      await this.order();
    }
    this.columns = [...(await this.table.select(this.shown)).values()];
    this.drawHead();
    this.drawNow();
  }

  async showColumns(names) {
    this.shown = names;
    await this.load();
  }

  /** Shows some rows only, (rows) of 0 and 1, in the order that was asked for. */
  async keep(kept) {
    this.rows = allRows(this.table.count).filter((row) => kept[row] === 1);
    this.active = 0;
    this.scroll.scrollTop = 0;
    await this.order();
  }

  async sortBy(name) {
    const descending = this.sorted?.name === name && !this.sorted.descending;
    this.sorted = { name, descending };
    await this.order();
    this.drawHead();
  }

  async order() {
    if (this.sorted !== null) {
      sortRows(this.rows, await this.table.column(this.sorted.name), this.sorted.descending);
    }
    this.drawNow();
  }

  drawHead() {
    const focused = document.activeElement?.dataset?.column;
    const headings = this.columns.map((column) => {
      const direction =
        this.sorted?.name !== column.name ? null : this.sorted.descending ? "descending" : "ascending";
      const control = button("", () => this.sortBy(column.name), {
        class: "sort",
        "data-column": column.name,
        title: column.name,
      });
      control.append(...breakable(column.name));
      const heading = element(
        "th",
        { scope: "col", class: column.isText ? null : "number", "aria-sort": direction },
        control,
      );
      heading.style.width = `${columnWidthPx(column)}px`;
      return heading;
    });
    this.head.replaceChildren(element("tr", { "aria-rowindex": 1 }, ...headings));
    this.grid.style.width = `${this.columns.reduce((sum, column) => sum + columnWidthPx(column), 0)}px`;
    this.grid.setAttribute("aria-colcount", this.columns.length);
    if (focused !== undefined) {
      [...this.head.querySelectorAll("button")].find((made) => made.dataset.column === focused)?.focus();
    }
  }

  drawNow() {
    if (this.columns === undefined) {
      return;
    }
    const [first, last] = this.placesInSight();
    const drawn = [];
    for (let place = first; place < last; ++place) {
      drawn.push(this.rowElement(place));
    }
    this.body.replaceChildren(this.spacer(first), ...drawn, this.spacer(this.rows.length - last));
    this.grid.setAttribute("aria-rowcount", this.rows.length + 1);
    const active = document.getElementById(this.rowId(this.active));
    if (active === null) {
      this.grid.removeAttribute("aria-activedescendant");
    } else {
      this.grid.setAttribute("aria-activedescendant", active.id);
    }
  }

  /** The first row that is drawn, and the one behind the last. */
  placesInSight() {
    if (isOnPaper()) {
      return [0, Math.min(this.rows.length, rowsOnPaper)];
    }
    const seen = Math.ceil((this.scroll.clientHeight || 480) / rowHeightPx);
    const first = Math.max(0, Math.floor(this.scroll.scrollTop / rowHeightPx) - spareRows);
    return [first, Math.min(this.rows.length, first + seen + 2 * spareRows)];
  }

  /** Room for rows that are not drawn; screen readers pass it over. */
  spacer(count) {
    const row = element(
      "tr",
      { class: "spacer", "aria-hidden": "true" },
      element("td", { colspan: this.columns.length }),
    );
    row.style.height = `${count * rowHeightPx}px`;
    row.hidden = count === 0;
    return row;
  }

  rowId(place) {
    return `row-${place}`;
  }

  rowElement(place) {
    const row = this.rows[place];
    const cells = this.columns.map((column) => {
      const value = column.at(row);
      const text = value === null ? noValue : column.isText ? value : this.numberText(column.name, value);
      return element(
        "td",
        { class: column.isText ? null : "number", role: "gridcell" },
        column.isText ? nameElement(text) : text,
      );
    });
    return element(
      "tr",
      {
        id: this.rowId(place),
        "aria-rowindex": place + 2,
        "data-place": place,
        "aria-selected": String(row === this.open),
        class: place === this.active ? "active" : null,
      },
      ...cells,
    );
  }

  numberText(name, value) {
    return name.endsWith("_rate") ? percent(value) : readable(value);
  }

  click(event) {
    const drawn = event.target.closest("tr[data-place]");
    if (drawn !== null) {
      this.moveTo(Number(drawn.dataset.place));
      this.openActive();
    }
  }

  key(event) {
    const page = Math.max(1, Math.floor(this.scroll.clientHeight / rowHeightPx) - 2);
    const ways = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page, Home: -Infinity, End: Infinity };
    if (event.target !== this.grid || event.ctrlKey || event.metaKey) {
      return;
    }
    if (event.key in ways) {
      event.preventDefault();
      this.moveTo(this.active + ways[event.key]);
    } else if (event.key === "Enter" && this.rows.length > 0) {
      event.preventDefault();
      this.openActive();
    }
  }

  moveTo(place) {
    this.active = Math.max(0, Math.min(this.rows.length - 1, place));
    const top = this.active * rowHeightPx;
    const room = this.scroll.clientHeight - 2 * rowHeightPx - this.head.offsetHeight;
    if (top < this.scroll.scrollTop) {
      this.scroll.scrollTop = top;
    } else if (top > this.scroll.scrollTop + room) {
      this.scroll.scrollTop = top - room;
    }
    this.drawNow();
  }

  openActive() {
    this.setOpen(this.rows[this.active]);
    this.onOpen(this.open);
  }

  /** Marks a row as the one that is shown. */
  setOpen(row) {
    this.open = row;
    this.drawNow();
  }
}
