// What is drawn over the picture: why a pixel is as it is, how many fragments it took, and lines of the scene.

import {arrayAt} from "./arrays.js";
import {page} from "./data.js";
import {countsOf} from "./pictures.js";

const COUNT_COLORS = 8;  // counts from here on have one colour

// Return the number of the array of an overlay over a step, or null: "why", or the name of a count.
export function overlayArray(name, step) {
  return (name === "why" ? step.last : step.counts?.[name]) ?? null;
}

// Return {canvas, alpha, rows} of an overlay over a step, or null.
export function overlayOf(name, step) {
  const number = overlayArray(name, step);
  if (number === null) return null;
  const array = arrayAt(number), [height, width] = array.shape, color = name === "why" ? fateColor : countColor;
  const canvas = Object.assign(document.createElement("canvas"), {width, height}), image = new ImageData(width, height);
  for (let i = 0; i < array.values.length; i++) image.data.set([...color(array.values[i]), array.values[i] ? 255 : 0], 4 * i);
  canvas.getContext("2d").putImageData(image, 0, 0);
  const rows = countsOf(array).filter(([value]) => value > 0).map(([value, pixels]) =>
    [`${name === "why" ? page.fates[value] : value}: ${pixels} px`, color(value)]);
  return {canvas, alpha: 0.8, rows};
}

function fateColor(fate) {
  return page.colors.fates[fate];
}

function countColor(count) {
  return page.palette[Math.min(count, COUNT_COLORS)];
}

// Return the outline of a triangle of a history row: four numbers per line, in pixels of the window.
export function outlineOf(corners, t) {
  const at = k => corners[6 * t + k % 6] / 256 + 0.5;
  return [0, 2, 4].flatMap(k => [at(k), at(k + 1), at(k + 2), at(k + 3)]);
}
