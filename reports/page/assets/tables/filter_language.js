// The language of the table's filter: words and comparisons that must all hold; docs/report.md.

const comparisons = {
  "<": (a, b) => a < b,
  "<=": (a, b) => a <= b,
  ">": (a, b) => a > b,
  ">=": (a, b) => a >= b,
  "=": (a, b) => a === b,
  "!=": (a, b) => a !== b,
};

/**
 * @param {string} text  such as  false_lit < 100 filter=nearest "two words"
 * @return {{name: ?string, operator: string, value: string}[]}  a plain word has the operator "~"
 *     and no name
 * @throws {Error}  in words, where a comparison lacks a side
 */
function parseFilter(text) {
  const token = /\s*("([^"]*)"?|<=|>=|!=|[<>=~]|[^\s<>=!~"]+|!)/gy;
  const parts = [];
  for (let match = token.exec(text); match !== null; match = token.exec(text)) {
    const quoted = match[2] !== undefined;
    parts.push({
      text: quoted ? match[2] : match[1],
      isOperator: !quoted && /^(<=|>=|!=|[<>=~])$/.test(match[1]),
    });
  }
  const terms = [];
  for (let i = 0; i < parts.length; ++i) {
    if (parts[i].isOperator) {
      throw new Error(`“${parts[i].text}” has no column before it`);
    }
    if (!parts[i + 1]?.isOperator) {
      terms.push({ name: null, operator: "~", value: parts[i].text });
      continue;
    }
    if (parts[i + 2] === undefined || parts[i + 2].isOperator) {
      throw new Error(`“${parts[i].text} ${parts[i + 1].text}” has no value after it`);
    }
    terms.push({ name: parts[i].text, operator: parts[i + 1].text, value: parts[i + 2].text });
    i += 2;
  }
  return terms;
}

/** How the keys of a job begin: they come first where a name's end is ambiguous. */
const jobKey = /^(scene|camera|image|light|shadow_map|lookup|bias)\./;

/**
 * The column that a name means: the name itself, or the only one that ends in it after a dot, or the
 * only key of the job that does.
 * @param {string[]} names
 * @throws {Error}  in words, if there is none or more than one
 */
function resolveColumn(names, name) {
  const wanted = name.toLowerCase();
  const exact = names.find((candidate) => candidate.toLowerCase() === wanted);
  if (exact !== undefined) {
    return exact;
  }
  const ends = names.filter((candidate) => candidate.toLowerCase().endsWith(`.${wanted}`));
  const keys = ends.filter((candidate) => jobKey.test(candidate));
  if (ends.length !== 1 && keys.length === 1) {
    return keys[0];
  }
  if (ends.length !== 1) {
    throw new Error(ends.length === 0 ? `no column “${name}”` : `“${name}” may mean ${ends.join(" or ")}`);
  }
  return ends[0];
}

/** @return {number}  of "12", "1e-3" or "5%"; NaN if it is no number */
function numberOfText(text) {
  const trimmed = text.trim();
  if (trimmed === "") {
    return NaN;
  }
  return trimmed.endsWith("%") ? Number(trimmed.slice(0, -1)) / 100 : Number(trimmed);
}

/** Which texts of a dictionary a term takes, (texts) of 0 and 1, or null if it is of no use. */
function dictionaryMatches(dictionary, term) {
  const wanted = term.value.toLowerCase();
  const takes =
    term.operator === "~"
      ? (text) => text.includes(wanted)
      : (text) => comparisons[term.operator](text, wanted);
  return Uint8Array.from(dictionary, (text) => (takes(text.toLowerCase()) ? 1 : 0));
}

/** Clears the rows of `kept` that a comparison with one column does not take. */
function applyComparison(kept, column, term) {
  const { values } = column;
  if (column.isText) {
    const matches = dictionaryMatches(column.dictionary, term);
    for (let row = 0; row < kept.length; ++row) {
      kept[row] &= values[row] === noIndex ? (term.operator === "!=" ? 1 : 0) : matches[values[row]];
    }
    return;
  }
  const wanted = numberOfText(term.value);
  if (Number.isNaN(wanted) || term.operator === "~") {
    throw new Error(`${column.name} is a number: compare it with < <= > >= = !=`);
  }
  const takes = comparisons[term.operator];
  for (let row = 0; row < kept.length; ++row) {
    if (kept[row] !== 0 && !takes(values[row], wanted)) {
      kept[row] = 0;
    }
  }
}

/** Clears the rows of `kept` in which no column holds a word: texts as a part, numbers whole. */
function applyWord(kept, columns, term) {
  const found = new Uint8Array(kept.length);
  const wanted = numberOfText(term.value);
  for (const { values, dictionary } of columns) {
    const matches = dictionary === null ? null : dictionaryMatches(dictionary, term);
    if (matches === null ? Number.isNaN(wanted) : !matches.includes(1)) {
      continue;
    }
    for (let row = 0; row < kept.length; ++row) {
      found[row] |= matches === null ? values[row] === wanted : (matches[values[row]] ?? 0);
    }
  }
  for (let row = 0; row < kept.length; ++row) {
    kept[row] &= found[row];
  }
}

/**
 * The rows that a filter keeps.
 * @param {Table} table
 * @param {string[]} words  the columns in which plain words are looked for
 * @param {string} text  the filter
 * @return {Promise<Uint8Array>}  (rows) of 0 and 1
 * @throws {Error}  in words, where the filter cannot be understood
 */
async function filterRows(table, words, text) {
  const kept = new Uint8Array(table.count).fill(1);
  for (const term of parseFilter(text)) {
    if (term.name === null) {
      applyWord(kept, (await table.select(words)).values(), term);
    } else {
      applyComparison(kept, await table.column(resolveColumn(table.allNames, term.name)), term);
    }
  }
  return kept;
}
