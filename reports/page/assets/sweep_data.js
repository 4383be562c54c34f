// A sweep's rows, grouped along its axes. Nothing here draws.

/**
 * An axis of a sweep: its distinct values in order, and which of them each row has.
 * @typedef {{name: string, isText: boolean, values: Array, codes: Int32Array}} Axis
 *     codes (rows) are indices into values; −1 where the row has no value
 */

/** @return {Axis}  of a column; numbers ascend, texts stand in the order of the sweep */
function axisOfColumn(column) {
  const { name, values, dictionary, isText } = column;
  if (isText) {
    return {
      name,
      isText,
      values: dictionary,
      codes: Int32Array.from(values, (code) => (code === noIndex ? -1 : code)),
    };
  }
  const distinct = distinctNumbers(values);
  const codes = new Int32Array(values.length);
  for (let row = 0; row < codes.length; ++row) {
    codes[row] = Number.isNaN(values[row]) ? -1 : rankIn(distinct, values[row]);
  }
  return { name, isText, values: [...distinct], codes };
}

/** The different values of a column, ascending, without NaN. */
function distinctNumbers(values) {
  const sorted = new Float64Array(values).sort();
  let count = 0;
  for (const value of sorted) {
    if (!Number.isNaN(value) && (count === 0 || value !== sorted[count - 1])) {
      sorted[count++] = value;
    }
  }
  return sorted.subarray(0, count);
}

/** Where a value stands among ascending ones, of which it is one. */
function rankIn(sorted, value) {
  let first = 0;
  let last = sorted.length - 1;
  while (first < last) {
    const middle = (first + last) >>> 1;
    if (sorted[middle] < value) {
      first = middle + 1;
    } else {
      last = middle;
    }
  }
  return first;
}

/**
 * The axis with neighbouring values joined until there are at most `most`; each group is named by its
 * middle value.
 * @return {Axis}
 */
function joinValues(axis, most) {
  const count = axis.values.length;
  if (count <= most) {
    return axis;
  }
  const groupOf = Int32Array.from(axis.values, (_, rank) => Math.floor((rank * most) / count));
  const values = Array.from({ length: most }, (_, group) => {
    const first = Math.ceil((group * count) / most);
    const next = Math.ceil(((group + 1) * count) / most);
    return axis.values[Math.floor((first + next - 1) / 2)];
  });
  return { ...axis, values, codes: axis.codes.map((rank) => (rank < 0 ? -1 : groupOf[rank])) };
}

/**
 * Median and range of a measure in each group.
 * @param {TypedArray} values  (rows); NaN is left out
 * @param {Int32Array} groups  (rows); −1 is left out
 * @param {number} count  of groups
 * @return {?{median: number, least: number, most: number, count: number}[]}  null for an empty group
 */
function summariseGroups(values, groups, count) {
  const sizes = new Int32Array(count + 1);
  const isUsed = (row) => groups[row] >= 0 && !Number.isNaN(values[row]);
  for (let row = 0; row < values.length; ++row) {
    sizes[isUsed(row) ? groups[row] + 1 : 0] += 1;
  }
  sizes[0] = 0;
  for (let group = 0; group < count; ++group) {
    sizes[group + 1] += sizes[group];
  }
  const next = sizes.slice();
  const sorted = new Float64Array(sizes[count]);
  for (let row = 0; row < values.length; ++row) {
    if (isUsed(row)) {
      sorted[next[groups[row]]++] = values[row];
    }
  }
  return Array.from({ length: count }, (_, group) => {
    const part = sorted.subarray(sizes[group], sizes[group + 1]).sort();
    const last = part.length >>> 1;
    const middle = part.length % 2 === 1 ? part[last] : (part[last - 1] + part[last]) / 2;
    return part.length === 0
      ? null
      : { median: middle, least: part[0], most: part[part.length - 1], count: part.length };
  });
}

/**
 * Axes in the order of how much the median of a measure changes along them.
 * @param {Map<string, Axis>} axes
 * @param {TypedArray} values  (rows); NaN is left out
 * @return {Map<string, Axis>}
 */
function byEffect(axes, values) {
  const effect = (axis) => {
    const groups = summariseGroups(values, axis.codes, axis.values.length).filter((group) => group !== null);
    const medians = groups.map(({ median }) => median);
    return medians.length === 0 ? 0 : Math.max(...medians) - Math.min(...medians);
  };
  const effects = new Map([...axes].map(([name, axis]) => [name, effect(axis)]));
  return new Map([...axes].sort(([a], [b]) => effects.get(b) - effects.get(a)));
}

/** @return {Int32Array}  (rows): the cell of two axes that a row is in, column by column; −1 none */
function cellCodes(across, down) {
  return across.codes.map((column, row) =>
    column < 0 || down.codes[row] < 0 ? -1 : column * down.values.length + down.codes[row],
  );
}

/** @return {Uint32Array}  0, 1, … count − 1 */
function allRows(count) {
  const rows = new Uint32Array(count);
  for (let row = 0; row < count; ++row) {
    rows[row] = row;
  }
  return rows;
}

/**
 * The rows of which no other has less of one without more of the other, by ascending first measure;
 * of equal rows that of the least cost, of these the first.
 * @param {TypedArray} first  (rows)
 * @param {TypedArray} second  (rows)
 * @param {?TypedArray} costs  (rows)
 * @return {number[]}
 */
function paretoFront(first, second, costs = null) {
  const rows = allRows(first.length).filter((row) => !Number.isNaN(first[row]) && !Number.isNaN(second[row]));
  rows.sort((a, b) => first[a] - first[b] || second[a] - second[b] || costs?.[a] - costs?.[b] || a - b);
  const front = [];
  let least = Infinity;
  for (const row of rows) {
    if (second[row] < least) {
      least = second[row];
      front.push(row);
    }
  }
  return front;
}

/** At most `most` rows with both measures, evenly spaced through the sweep. */
function thinnedRows(first, second, most) {
  const rows = allRows(first.length).filter((row) => !Number.isNaN(first[row]) && !Number.isNaN(second[row]));
  const step = rows.length / Math.min(rows.length, most);
  return Array.from({ length: Math.min(rows.length, most) }, (_, i) => rows[Math.floor(i * step)]);
}
