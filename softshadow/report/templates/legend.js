// What stands below a picture: the meaning of its colours, and how many pixels have each value.

import {arrayAt} from "./arrays.js";
import {page} from "./data.js";
import {countsOf, depthRange, histogram} from "./pictures.js";
import {shortest} from "./numbers.js";

const SHOWN = 9;  // counts in a legend; the remaining ones are summed
const BINS = 24;

// Return a new element with text.
export function element(name, text = "", properties = {}) {
  return Object.assign(document.createElement(name), {textContent: text}, properties);
}

// Fill the legend of a panel.
export function fillLegend(legend, picture) {
  const array = arrayAt(picture.array);
  legend.replaceChildren();
  if (picture.other !== undefined) return;
  if (picture.form === "counts") countLegend(legend, array);
  if (picture.form === "depth") depthLegend(legend, array);
  if (picture.form === "visibility")
    legend.append(list([["lit", [255, 255, 255]], ["in shadow", [0, 0, 0]], ["not defined", page.colors.undefined]]));
}

function countLegend(legend, array) {
  const counts = countsOf(array), most = Math.max(...counts.map(([, pixels]) => pixels)), rest = counts.slice(SHOWN);
  const rows = counts.slice(0, SHOWN).map(([value, pixels]) => [name(value), page.palette[Math.min(value, 255)], pixels]);
  if (rest.length) rows.push([`${rest.length} more`, null, rest.reduce((sum, [, pixels]) => sum + pixels, 0)]);
  legend.append(bars(rows, most));
}

// A counter that wraps: 255 stands for -1.
function name(value) {
  return value > 250 ? `${value} (${value - 256})` : String(value);
}

// Return a list of bars: text, colour, pixels.
function bars(rows, most) {
  const items = element("ul", "", {className: "bars"});
  for (const [text, color, pixels] of rows) {
    const item = element("li"), bar = element("span", "", {className: "bar"});
    bar.style.setProperty("--share", pixels / most);
    item.append(swatch(color), element("b", text), bar, element("span", `${pixels} px`));
    items.append(item);
  }
  return items;
}

// Return a box of a colour; of none it is empty.
export function swatch(color) {
  const box = element("i");
  box.style.background = color ? `rgb(${color.join(",")})` : "transparent";
  return box;
}

// Return a list of colours with their meaning.
export function list(rows) {
  const items = element("ul", "", {className: "swatches"});
  for (const [text, color] of rows) {
    const item = element("li");
    item.append(swatch(color), text);
    items.append(item);
  }
  return items;
}

function depthLegend(legend, array) {
  const {near, far} = depthRange(array);
  if (near === undefined) return;
  const counts = histogram(array, BINS), most = Math.max(...counts), chart = element("div", "", {className: "histogram"});
  chart.setAttribute("role", "img");
  chart.setAttribute("aria-label", `histogram of the values from ${shortest(near)} to ${shortest(far)}`);
  for (const count of counts) {
    const bar = element("span");
    bar.style.setProperty("--share", count / most);
    chart.append(bar);
  }
  legend.append(chart, element("span", shortest(near), {className: "low"}), element("span", shortest(far), {className: "high"}));
}
