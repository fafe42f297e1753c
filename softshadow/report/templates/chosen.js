// What the reader has chosen: step, pixel, side, overlay, lines, pictures.

import {readAddress} from "./address.js";
import {page} from "./data.js";

export const chosen = {
  step: page.runs[0].steps.length - 1, marker: null, side: "first", overlay: "none", lines: new Set(), hidden: new Set(page.hidden),
  row: null,  // outline of the triangle of the history row that is pointed at
  ...page.start, ...readAddress(),
};

export const find = id => document.getElementById(id);
