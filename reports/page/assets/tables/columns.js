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
   * @param {Object<string, string>} constants  columns that hold the same everywhere, as texts; they
   *     are not among `names`
   */
  constructor(stored, reader, constants = {}) {
    this.count = stored.count;
    this.names = stored.columns.map((column) => column.name);
    this.stored = new Map(stored.columns.map((column) => [column.name, column]));
    this.constants = new Map(Object.entries(constants));
    this.reader = reader;
    this.columns = new Map();
  }

  has(name) {
    return this.stored.has(name) || this.constants.has(name);
  }

  /** Names of all columns, constant ones too. */
  get allNames() {
    return [...this.names, ...this.constants.keys()];
  }

  isText(name) {
    return this.stored.get(name)?.type === "text";
  }

  /**
   * @param {string} name  one of `allNames`
   * @return {Promise<Column>}
   */
  async column(name) {
    if (!this.columns.has(name)) {
      this.columns.set(name, this.stored.has(name) ? await this.readColumn(name) : this.constantColumn(name));
    }
    return this.columns.get(name);
  }

  async readColumn(name) {
    const stored = this.stored.get(name);
    return new Column(name, await this.reader.read(stored), stored.dictionary ?? null);
  }

  constantColumn(name) {
    const text = this.constants.get(name);
    const number = Number(text);
    // Ids are texts, whatever their digits.
    const isNumber = text !== "" && Number.isFinite(number) && !["id", "curve", "scene_hash"].includes(name);
    return isNumber
      ? new Column(name, new Float64Array(this.count).fill(number), null)
      : new Column(name, new Uint32Array(this.count), [text]);
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
