// Which of a job's several lights the page shows.

/** A choice among the lights: the configuration shown otherwise stays the same. */
class LightChoice {
  /**
   * @param {Table} table
   * @param {string[]} axes  names of the sweep's axes, "light" among them
   * @param {function(number)} onShow  told the row to show
   */
  constructor(table, axes, onShow) {
    Object.assign(this, { table, axes, onShow });
    this.row = 0;
  }

  async load() {
    const columns = await this.table.select([...(this.table.has("case") ? ["case"] : []), ...this.axes]);
    this.lights = columns.get("light");
    this.others = [...columns].filter(([name]) => name !== "light").map(([, column]) => column);
  }

  /** @return {Promise<HTMLElement>} */
  async open() {
    await this.load();
    const names = new Set();
    for (let row = 0; row < this.table.count; ++row) {
      names.add(this.lights.at(row));
    }
    this.select = choice(
      [...names].map((name) => [name, name]),
      this.lights.at(this.row),
      (light) => this.choose(light),
    );
    return labelled("Light shown below", this.select, "control light-choice");
  }

  choose(light) {
    const row = this.rowOf(light);
    if (row !== null) {
      this.onShow(row);
    }
  }

  /** The row of a light with the other values of the row that is shown; null where there is none. */
  rowOf(light) {
    for (let row = 0; row < this.table.count; ++row) {
      const isSame = (column) => column.at(row) === column.at(this.row);
      if (this.lights.at(row) === light && this.others.every(isSame)) {
        return row;
      }
    }
    return null;
  }

  /** Follows a row that was chosen elsewhere. */
  follow(row) {
    this.row = row;
    this.select.value = this.lights.at(row);
  }
}
