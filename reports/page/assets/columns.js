// Tables of columns, each decoded when it is first asked for.

/** A decoded column: numbers, or indices into a dictionary of texts. */
class Column {
  /**
   * @param {string} name
   * @param {TypedArray} values  (rows)
   * @param {?string[]} dictionary  of a text column
   */
  constructor(name, values, dictionary) {
    this.name = name;
    this.values = values;
    this.dictionary = dictionary;
  }

  get isText() {
    return this.dictionary !== null;
  }

  /** @return {number|string|null}  null where there is no value */
  at(row) {
    const value = this.values[row];
    if (this.isText) {
      return value === noIndex ? null : this.dictionary[value];
    }
    return Number.isNaN(value) || value === undefined ? null : value;
  }
}

/** Columns of one length, by name. */
class Table {
  /**
   * @param {{count: number, columns: object[]}} stored  as in the page's data
   * @param {BlockReader} reader
   */
  constructor(stored, reader) {
    this.count = stored.count;
    this.names = stored.columns.map((column) => column.name);
    this.stored = new Map(stored.columns.map((column) => [column.name, column]));
    this.reader = reader;
    this.columns = new Map();
  }

  has(name) {
    return this.stored.has(name);
  }

  isText(name) {
    return this.stored.get(name)?.type === "text";
  }

  /**
   * @param {string} name  one of `names`
   * @return {Promise<Column>}
   */
  async column(name) {
    if (!this.columns.has(name)) {
      const stored = this.stored.get(name);
      const values = await this.reader.read(stored);
      this.columns.set(name, new Column(name, values, stored.dictionary ?? null));
    }
    return this.columns.get(name);
  }

  /**
   * @param {string[]} names  those that the table lacks are left out
   * @return {Promise<Map<string, Column>>}
   */
  async select(names) {
    const found = names.filter((name) => this.has(name));
    const columns = await Promise.all(found.map((name) => this.column(name)));
    return new Map(columns.map((column) => [column.name, column]));
  }
}
