// The arrays of the page: text of deflated bytes, decoded when they are first needed and then kept.
// packing.py writes them; rows may be differences from the row above, and the bytes of larger numbers lie apart.

import {page} from "./data.js";

const KINDS = {uint8: Uint8Array, bool: Uint8Array, uint16: Uint16Array, int32: Int32Array, float32: Float32Array, float64: Float64Array};

const decoded = new Map();

// Decode the arrays with these numbers; null stands for an array that was left out.
export async function load(numbers) {
  const missing = [...new Set(numbers)].filter(number => number !== null && !decoded.has(number));
  await Promise.all(missing.map(async number => decoded.set(number, await decode(page.arrays[number]))));
}

// Return {values, shape, kind} of an array that has been loaded, or null.
export function arrayAt(number) {
  return decoded.get(number) ?? null;
}

async function decode({kind, shape, rows, data}) {
  let bytes = await inflate(data);
  const size = KINDS[kind].BYTES_PER_ELEMENT, n = bytes.length / size;
  if (size > 1) bytes = joined(bytes, n, size);
  const width = shape.length > 1 ? shape[1] : 1;
  if (rows) addRows(size === 1 ? bytes : new Uint32Array(bytes.buffer), shape.length === 2 || shape.length === 3 ? width : 1, size);
  const values = new KINDS[kind](bytes.buffer);
  return {values: shape.length === 3 ? interleaved(values, shape[2]) : values, shape, kind};
}

async function inflate(text) {
  const bytes = Uint8Array.from(atob(text), character => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Return numbers whose bytes were grouped by place: all lowest ones first.
function joined(bytes, n, size) {
  const whole = new Uint8Array(bytes.length);
  for (let place = 0; place < size; place++)
    for (let i = 0, at = place * n; i < n; i++) whole[i * size + place] = bytes[at + i];
  return whole;
}

// Turn differences of rows into values; those of four bytes have their sign in the lowest bit.
function addRows(values, width, size) {
  if (size > 1) for (let i = 0; i < values.length; i++) values[i] = (values[i] >>> 1) ^ -(values[i] & 1);
  for (let i = width; i < values.length; i++) values[i] += values[i - width];
}

// Return (C, H, W) as (H, W, C).
function interleaved(values, channels) {
  const result = new values.constructor(values.length), n = values.length / channels;
  for (let c = 0; c < channels; c++) for (let i = 0; i < n; i++) result[i * channels + c] = values[c * n + i];
  return result;
}
