// The table of a pixel's history, and the same as comma-separated values.

import {element, swatch} from "./legend.js";
import {shortest} from "./numbers.js";

const COLUMNS = ["draw", "object", "triangle", "facing", "z", "stored z", "stencil", "colour", "verdict", "reason"];
const FIELDS = ["step", "title", "draw", "object", "triangle", "front_facing", "z", "stored_z", "verdict", "stencil_before",
  "stencil_after", "depth_after", "color_before", "color_after", "color_written", "reason"];

// Fill a table with rows, one group per step; columns that only some rows have come before the reason.
export function fillTable(table, rows, onRow) {
  const more = extraColumns(rows), columns = [...COLUMNS.slice(0, -1), ...more, "reason"];
  const head = element("thead"), line = element("tr");
  line.append(...columns.map(name => element("th", name, {scope: "col", className: name.replace(" ", "-")})));
  head.append(line);
  table.replaceChildren(table.caption ?? "", head);
  let body = null, step = null;
  for (const row of rows) {
    if (row.step !== step) {
      step = row.step;
      body = element("tbody");
      const title = element("tr", "", {className: "step"});
      title.append(element("th", `Step ${row.step}: ${row.title}`, {scope: "rowgroup", colSpan: columns.length}));
      body.append(title);
      table.append(body);
    }
    const line = element("tr", "", {className: row.verdict.replace(" ", "-")});
    for (const column of columns) {
      const cell = element("td", cellOf(row, column), {className: column.replace(" ", "-")});
      cell.dataset.name = column;
      if (column === "colour") cell.prepend(swatch(row.color_after));
      line.append(cell);
    }
    for (const [event, value] of [["pointerenter", row], ["pointerleave", null]]) line.addEventListener(event, () => onRow(value));
    body.append(line);
  }
  for (const [selector, role] of [["thead, tbody", "rowgroup"], ["tr", "row"], ["td", "cell"], ["thead th", "columnheader"], ["tbody th", "rowheader"]])
    for (const each of table.querySelectorAll(selector)) each.setAttribute("role", role);  // kept where rows are shown as cards
}

// Return the names of columns that only some rows have, in their order.
function extraColumns(rows) {
  return [...new Set(rows.flatMap(row => Object.keys(row.extra ?? {})))];
}

function cellOf(row, column) {
  const changed = row.stencil_before !== row.stencil_after;
  switch (column) {
    case "draw": return row.draw ?? "–";
    case "object": return row.object || "–";
    case "triangle": return row.triangle ?? "–";
    case "facing": return row.front_facing === null ? "–" : row.front_facing ? "front" : "back";
    case "z": return row.z === null ? "–" : shortest(row.z);
    case "stored z": return shortest(row.stored_z);
    case "stencil": return changed ? `${row.stencil_before} → ${row.stencil_after}` : row.stencil_after;
    case "colour": return row.color_after.join(" ");
    case "verdict": return row.verdict;
    case "reason": return row.reason;
    default: return row.extra?.[column] ?? "";
  }
}

// Return the rows as comma-separated values, all fields.
export function historyCsv(rows) {
  const more = extraColumns(rows), quoted = value => {
    const text = Array.isArray(value) ? value.join(" ") : String(value ?? "");
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  const lines = rows.map(row => [...FIELDS.map(name => row[name]), ...more.map(name => row.extra?.[name])]);
  return [[...FIELDS, ...more], ...lines].map(line => line.map(quoted).join(",")).join("\n") + "\n";
}
