// Arrays as pictures: the same colours as inspection/pictures.py, drawn once and kept.

import {arrayAt} from "./arrays.js";
import {page} from "./data.js";

const kept = new Map();

// Return a canvas of the size of the array of a picture, which has its `pixels`, too; `valid` marks where a
// visibility is defined.
export function canvasOf(picture) {
  const key = [picture.array, picture.valid ?? "", picture.form, picture.other ?? ""].join(" ");
  if (!kept.has(key)) {
    const array = arrayAt(picture.array), [height, width] = array.shape;
    const canvas = Object.assign(document.createElement("canvas"), {width, height});
    const image = new ImageData(width, height);
    if (picture.other === undefined) paint(image.data, picture, array);
    else paintDifference(image.data, picture, array);
    canvas.getContext("2d").putImageData(image, 0, 0);
    kept.set(key, Object.assign(canvas, {pixels: image.data}));
  }
  return kept.get(key);
}

function paint(data, picture, array) {
  const color = FORMS[picture.form](array, picture);
  for (let i = 0, at = 0; at < data.length; i++, at += 4) {
    const [red, green, blue] = color(i);
    data[at] = red; data[at + 1] = green; data[at + 2] = blue; data[at + 3] = 255;
  }
}

const grey = value => [value, value, value];
const byte = value => Math.round(Math.min(1, Math.max(0, value)) * 255);

const FORMS = {
  color: ({values, kind}) => i => [0, 1, 2].map(c => kind === "uint8" ? values[3 * i + c] : byte(values[3 * i + c])),
  counts: ({values}) => i => page.palette[Math.min(values[i], 255)],
  yes: ({values}) => i => grey(values[i] ? 255 : 0),
  visibility: ({values}, picture) => {
    const valid = arrayAt(picture.valid ?? null)?.values;
    return i => valid && !valid[i] ? page.colors.undefined : grey(byte(values[i]));
  },
  depth: array => {
    const {near, far} = depthRange(array), span = far > near ? far - near : 1;
    return i => isDrawn(array.values[i]) ? grey(Math.round(255 - 205 * (array.values[i] - near) / span)) : page.colors.clear;
  },
};

function isDrawn(value) {
  return value !== 1 && Number.isFinite(value);
}

// Return the least and the largest depth that is not the clear value; both undefined if there is none.
export function depthRange(array) {
  if (!("range" in array)) {
    let near, far;
    for (const value of array.values)
      if (isDrawn(value)) { near = value < near || near === undefined ? value : near; far = value > far || far === undefined ? value : far; }
    array.range = {near, far};
  }
  return array.range;
}

// Return how many of the values of a depth array fall into each of `bins` equal parts of their range.
export function histogram(array, bins) {
  const {near, far} = depthRange(array), counts = new Array(bins).fill(0);
  if (near === undefined) return counts;
  for (const value of array.values)
    if (isDrawn(value)) counts[Math.min(bins - 1, Math.floor(bins * (value - near) / ((far - near) || 1)))]++;
  return counts;
}

// Return how often each value of an array of counts occurs: [value, pixels], the smallest value first.
export function countsOf(array) {
  if (!array.counts) {
    const pixels = new Map();
    for (const value of array.values) pixels.set(value, (pixels.get(value) ?? 0) + 1);
    array.counts = [...pixels].sort((a, b) => a[0] - b[0]);
  }
  return array.counts;
}

// Return whether cell i of two arrays of one shape differs.
export function differs(a, b, i) {
  const channels = a.shape[2] ?? 1;
  for (let c = 0; c < channels; c++) if (a.values[channels * i + c] !== b.values[channels * i + c]) return true;
  return false;
}

// Paint what differs in one strong colour over a faint picture.
function paintDifference(data, picture, array) {
  const other = arrayAt(picture.other);
  paint(data, picture, array);
  for (let i = 0, at = 0; at < data.length; i++, at += 4) {
    const different = differs(array, other, i);
    for (let c = 0; c < 3; c++) data[at + c] = different ? page.colors.different[c] : 190 + (data[at + c] >> 2);
  }
}
