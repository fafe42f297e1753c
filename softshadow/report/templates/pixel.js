// What the page tells of one pixel: the values of all pictures, and its history.

import {arrayAt} from "./arrays.js";
import {chosen, find} from "./chosen.js";
import {page} from "./data.js";
import {copyText, save} from "./export.js";
import {historyRows, loadHistory} from "./history.js";
import {cellText} from "./numbers.js";
import {picturesOf, stepIn} from "./shown.js";
import {fillTable, historyCsv} from "./table.js";

// Return the values of all pictures of a run at a pixel of the window.
function valuesAt(run, [x, y]) {
  const [width, height] = page.size;
  return picturesOf(run, stepIn(run, chosen.step)).map(picture => [picture, arrayAt(picture.array)])
    .filter(([, array]) => array && array.shape[0] === height && array.shape[1] === width)
    .map(([{title}, array]) => `${title} ${cellText(array, y * width + x)}`);
}

// Show the values of all pictures at a pixel, or how to choose one.
export function showValues(place) {
  if (!place) {
    find("values").textContent = "Choose a pixel: click a picture, or focus it and press an arrow key.";
    return;
  }
  const runs = chosen.side === "first" ? [0] : chosen.side === "second" ? [1] : [0, 1];
  const texts = runs.map(n => (runs.length > 1 ? `${page.runs[n].name}: ` : "") + valuesAt(page.runs[n], place).join("; "));
  find("values").textContent = [`x=${place[0]} y=${place[1]} (GL y=${page.size[1] - 1 - place[1]})`, ...texts].join("; ");
}

// Show the value of a cell of a picture that is not as large as the window.
export function showTexel(panel, [x, y]) {
  const array = arrayAt(panel.picture.array), [height, width] = array.shape;
  if (x < 0 || y < 0 || x >= width || y >= height) return;
  find("values").textContent = `${panel.picture.title}: column ${x}, row ${y} (GL row ${height - 1 - y}); ${cellText(array, y * width + x)}`;
}

// Show the history of the marked pixel in the runs that stand on the page, unless `isOld` says that it is too late;
// `pointAtRow` takes the outline of the triangle of a row, or null.
export async function showHistory(isOld, pointAtRow) {
  for (const [n, run] of page.runs.entries()) {
    const part = find(`history-${n}`), isShown = ["both", "difference"].includes(chosen.side) || n === (chosen.side === "second" ? 1 : 0);
    part.hidden = !isShown || !chosen.marker;
    if (part.hidden) continue;
    const [x, y] = chosen.marker, hint = part.querySelector(".hint");
    part.querySelector("h2").textContent = `History of pixel x=${x} y=${y}${page.runs.length > 1 ? `, ${run.name}` : ""}`;
    hint.hidden = Boolean(run.history);
    for (const selector of [".scroll", ".copy"]) part.querySelector(selector).hidden = !run.history;
    if (!run.history) {
      hint.textContent = `This page has no histories of pixels. In a terminal: ${page.command.replace("X Y", `${x} ${y}`)}`;
      continue;
    }
    await loadHistory(run);
    if (isOld()) return;
    const rows = historyRows(run, x, y, stepIn(run, chosen.step));
    fillTable(part.querySelector("table"), rows, row => pointAtRow(row?.outline ?? null));
    if (n === 0) tellView(rows);
    offerCopy(part.querySelector(".copy"), historyCsv(rows), `pixel-${x}-${y}.csv`);
  }
}

// Let a button copy a text, or save it where pages may not copy.
function offerCopy(button, text, name) {
  button.textContent = "Copy as CSV";
  button.onclick = async () => {
    const copied = await copyText(text);
    if (!copied) save(new Blob([text], {type: "text/csv"}), name);
    button.textContent = copied ? "copied" : "saved";
  };
}

// Tell the 3-D view, a page in a frame, the pixel and its stencil value.
function tellView(rows) {
  const frame = document.querySelector("#view3d iframe"), [x, y] = chosen.marker;
  frame?.contentWindow.postMessage({softshadow: "pixel", x, y, stencil: rows.at(-1)?.stencil_after ?? 0}, "*");
}
