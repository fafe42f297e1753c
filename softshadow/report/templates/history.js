// The history of a pixel: the recorded draws and clears, carried out again at this pixel alone.
// The words are templates of inspection/reasons.py; this file fills their blanks.

import {arrayAt, load} from "./arrays.js";
import {page} from "./data.js";
import {covers, fragmentDepth, processFragment, windowZ} from "./fragment.js";
import {unlike} from "./numbers.js";
import {outlineOf} from "./overlays.js";

// Decode everything that the histories of a run need.
export async function loadHistory(run) {
  const numbers = [...run.history.start, ...run.steps.map(step => step.colour)];
  for (const event of run.history.events) {
    if (event.kind === "draw") numbers.push(...Object.values(event.triangles), ...event.alphas, ...event.colors);
    if (event.origins) numbers.push(event.origins.owners, event.origins.numbers);
    if (event.kind === "write") numbers.push(...event.buffers);
  }
  await load(numbers);
}

// Return the rows of a pixel, from the first step to `lastStep`; their fields are those of HistoryRow.
export function historyRows(run, x, y, lastStep = run.steps.length - 1) {
  const pixel = {x, y, place: y * page.size[0] + x, run, rows: []};
  read(pixel, run.history.start);
  for (const event of run.history.events) {
    if (event.step > lastStep) break;
    pixel.event = event;
    if (event.kind === "draw") drawRows(pixel);
    else if (event.kind === "clear") clearRow(pixel);
    else writeRow(pixel);
  }
  return pixel.rows;
}

function read(pixel, buffers) {
  const [color, depth, stencil] = buffers.map(number => arrayAt(number).values);
  pixel.color = Array.from(color.subarray(3 * pixel.place, 3 * pixel.place + 3));
  pixel.depth = depth[pixel.place];
  pixel.stencil = stencil[pixel.place];
}

// Add the row of a change that `change` carries out.
function addRow(pixel, verdict, words, fragment, change) {
  const {run, event} = pixel, z = units => windowZ(units, run.history.largest);
  const before = {stored_z: z(pixel.depth), stencil_before: pixel.stencil, color_before: pixel.color};
  change();
  pixel.rows.push({
    step: event.step, title: run.steps[event.step].title, draw: null, object: "", triangle: null, front_facing: null, z: null,
    ...fragment, ...before, verdict, stencil_after: pixel.stencil, depth_after: z(pixel.depth), color_after: pixel.color,
    reason: words(before, z(pixel.depth)),
  });
}

function inside({region: [left, right, firstRow, endRow]}, x, y) {
  return left <= x && x < right && firstRow <= y && y < endRow;
}

function clearRow(pixel) {
  const {event} = pixel, [inWords, outWords] = event.words;
  if (!inside(event, pixel.x, pixel.y)) return addRow(pixel, "scissor", () => outWords, {}, () => {});
  addRow(pixel, "clear", () => inWords, {}, () => {
    if (event.color) pixel.color = pixel.color.map((old, c) => event.color[1][c] ? event.color[0][c] : old);
    if (event.depth !== null) pixel.depth = event.depth;
    if (event.stencil) pixel.stencil = (pixel.stencil & ~event.stencil[1] & 255) | (event.stencil[0] & event.stencil[1]);
  });
}

// Another command: a row if it has changed the pixel.
function writeRow(pixel) {
  const {run, event, color, depth, stencil} = pixel;
  read(pixel, event.buffers);
  const after = {color: pixel.color, depth: pixel.depth, stencil: pixel.stencil};
  const z = units => windowZ(units, run.history.largest);
  if (after.stencil === stencil && z(after.depth) === z(depth) && after.color.every((value, c) => value === color[c])) return;
  Object.assign(pixel, {color, depth, stencil});
  addRow(pixel, "written", () => event.name, {}, () => Object.assign(pixel, after));
}

function drawRows(pixel) {
  const {event} = pixel, corners = arrayAt(event.triangles.corners).values, sides = arrayAt(event.triangles.sides).values;
  const n = corners.length / 6;
  let layer = 0;
  for (let t = 0; t < n; t++)
    if (covers(corners, t, pixel.x, pixel.y, event.downwards)) fragmentRow(pixel, t, layer++, sides[2 * t], sides[2 * t + 1]);
}

const CULLS = {1: 1, 0: 2};  // bits of `culled` by facing, as in geometry/facing.py

function fragmentRow(pixel, t, layer, side, facing) {
  const {event, run, place} = pixel, {largest, single} = run.history;
  const triangle = arrayAt(event.triangles.ids).values[t];
  const depth = fragmentDepth(arrayAt(event.triangles.depth).values, t, pixel.x, pixel.y, event.depth_range, event.ops[side].depth_largest, single);
  const extra = event.origins ? {"made from": originOf(event.origins, t, facing)} : {};
  const fragment = {
    draw: event.draw, object: event.object, triangle, front_facing: facing === 2 ? null : facing === 1,
    z: windowZ(depth, largest), color_written: false, extra,
    outline: outlineOf(arrayAt(event.triangles.corners).values, t),
  };
  const words = page.texts[event.words[facing]];
  if (event.culled & CULLS[facing]) return addRow(pixel, "culled", () => words.culled, fragment, () => {});
  const alpha = event.alphas.length ? arrayAt(event.alphas[layer]).values[place] : 0;
  const after = processFragment(event.ops[side], inside(event, pixel.x, pixel.y), alpha, depth, pixel.depth, pixel.stencil);
  const key = after.verdict + (after.stencil === pixel.stencil ? "" : " changed");
  fragment.color_written = after.verdict === "passed" && event.colored;
  const filled = before => {
    const [z, stored] = unlike(fragment.z, before.stored_z), [shown] = unlike(alpha / 255, event.ops[side].alpha_ref / 255);
    return fill(words[key], {z, stored, alpha: shown, before: before.stencil_before, after: after.stencil});
  };
  addRow(pixel, after.verdict, filled, fragment, () => {
    if (fragment.color_written) pixel.color = colorAfter(pixel, layer);
    pixel.depth = after.depth;
    pixel.stencil = after.stencil;
  });
}

// Return what a triangle is, in the words of HistoryRow.name.
function originOf({names, owners, numbers}, t, facing) {
  return fill(names[facing][arrayAt(owners).values[t]], {number: arrayAt(numbers).values[t]});
}

// Return the colour after a fragment: its layer holds the difference from the colour at the end of the step.
function colorAfter({event, run, place}, layer) {
  const end = arrayAt(run.steps[event.step].colour).values, change = arrayAt(event.colors[layer]).values;
  return [0, 1, 2].map(c => (end[3 * place + c] + change[3 * place + c]) & 255);
}

function fill(template, values) {
  return template.replace(/\{(\w+)\}/g, (blank, name) => values[name] ?? blank);
}
