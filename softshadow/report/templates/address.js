// The address of a step and a pixel, `#step=3&x=177&y=97`, so that a link leads to them.

import {page} from "./data.js";

// Return {step, marker, side} of the present address; what it does not name is undefined.
export function readAddress() {
  const fields = new URLSearchParams(location.hash.slice(1)), number = name => fields.has(name) ? Number(fields.get(name)) : NaN;
  const [x, y, step] = [number("x"), number("y"), number("step")], [width, height] = page.size;
  const place = {};
  if (Number.isInteger(step) && step >= 0 && step < page.runs[0].steps.length) place.step = step;
  if (Number.isInteger(x) && Number.isInteger(y) && x >= 0 && y >= 0 && x < width && y < height) place.marker = [x, y];
  if (page.runs.length > 1 && ["first", "second", "both", "difference"].includes(fields.get("show"))) place.side = fields.get("show");
  return place;
}

// Put step and pixel into the address, without a new entry in the browser's history.
export function writeAddress({step, marker, side}) {
  const fields = new URLSearchParams({step});
  if (marker) fields.set("x", marker[0]), fields.set("y", marker[1]);
  if (side !== "first") fields.set("show", side);
  try {
    history.replaceState(null, "", `#${fields}`);
  } catch { /* a page in an iframe may have no address */ }
}
