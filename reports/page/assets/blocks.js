// Packed blocks: base64 of a zlib stream of byte planes, as reports/page packs them.

const bytesOfType = { u8: 1, u16: 2, u32: 4, f32: 4, f64: 8 };
const arrayOfType = {
  u8: Uint8Array,
  u16: Uint16Array,
  u32: Uint32Array,
  f32: Float32Array,
  f64: Float64Array,
};
/** No value, in integer columns. */
const noIndex = 0xffffffff;

/**
 * @param {string} text  base64, without line ends
 * @return {Uint8Array}
 */
function bytesFromBase64(text) {
  const packed = atob(text);
  const bytes = new Uint8Array(packed.length);
  for (let i = 0; i < bytes.length; ++i) {
    bytes[i] = packed.charCodeAt(i);
  }
  return bytes;
}

/**
 * @param {Uint8Array} bytes  a zlib stream
 * @return {Promise<Uint8Array>}
 */
async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/**
 * Joins byte planes, the least significant one first, into values.
 * @param {Uint8Array} planes  (bytes of the type × count)
 * @param {string} type  u8, u16, u32, f32 or f64
 * @return {TypedArray}  (count), of the type's own array
 */
function joinPlanes(planes, type) {
  const size = bytesOfType[type];
  const count = planes.length / size;
  const joined = new Uint8Array(planes.length);
  for (let plane = 0; plane < size; ++plane) {
    const first = plane * count;
    for (let i = 0, to = plane; i < count; ++i, to += size) {
      joined[to] = planes[first + i];
    }
  }
  return new arrayOfType[type](joined.buffer);
}

/**
 * Undoes differences in place: each pass adds the value before to each value, modulo 2^bits.
 * @param {TypedArray} values  any type but f64
 * @param {number} passes  0, 1 or 2
 */
function undoDifferences(values, passes) {
  if (passes === 0) {
    return;
  }
  const whole = { 1: Uint8Array, 2: Uint16Array, 4: Uint32Array }[values.BYTES_PER_ELEMENT];
  const integers = new whole(values.buffer);
  for (let pass = 0; pass < passes; ++pass) {
    for (let i = 1; i < integers.length; ++i) {
      integers[i] += integers[i - 1];
    }
  }
}

/**
 * @param {Uint8Array} planes  what the zlib stream held
 * @param {{type: string, count: number, delta: number}} block
 * @return {TypedArray}  (count)
 * @throws {Error}  if there are not as many bytes as values need
 */
function unpackPlanes(planes, block) {
  if (planes.length !== block.count * bytesOfType[block.type]) {
    throw new Error(`a block holds ${planes.length} bytes for ${block.count} values of ${block.type}`);
  }
  const values = joinPlanes(planes, block.type);
  undoDifferences(values, block.delta);
  return values;
}

/** Reads blocks of the page; each is decoded once, when it is first asked for. */
class BlockReader {
  /** @param {function(string): string} textOf  the base64 of a block's id */
  constructor(textOf) {
    this.textOf = textOf;
    this.decoded = new Map();
  }

  /**
   * @param {{block: string, type: string, count: number, delta: number}} block
   * @return {Promise<TypedArray>}  (count); text columns give indices into their dictionary
   */
  read(block) {
    const type = block.type === "text" ? "u32" : block.type;
    const key = `${block.block} ${type} ${block.delta ?? 0}`;
    if (!this.decoded.has(key)) {
      this.decoded.set(key, this.decode({ ...block, type, delta: block.delta ?? 0 }));
    }
    return this.decoded.get(key);
  }

  async decode(block) {
    return unpackPlanes(await inflate(bytesFromBase64(this.textOf(block.block))), block);
  }
}
