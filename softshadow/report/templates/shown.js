// Which pictures stand on the page: those of the chosen step, of one run, of both, or their difference.

import {arrayAt} from "./arrays.js";
import {page} from "./data.js";

// Return the number of the step of a run that belongs to a step of the first run: by title, else by number.
export function stepIn(run, step) {
  const title = page.runs[0].steps[step].title, same = run.steps.findIndex(each => each.title === title);
  return run === page.runs[0] ? step : same >= 0 ? same : Math.min(step, run.steps.length - 1);
}

// Return the pictures of a run at a step: its buffers, and the latest map of each name.
export function picturesOf(run, step) {
  const shown = new Map(run.steps[step].pictures.map(picture => [picture.key, {...picture, from: step}]));
  for (let earlier = step - 1; earlier >= 0; earlier--)
    for (const picture of run.steps[earlier].pictures)
      if (picture.map && !shown.has(picture.key)) shown.set(picture.key, {...picture, from: earlier});
  const label = (picture, words) => `${picture.title}${words}, ${run.name}, after step ${picture.from}`;
  return [...shown.values()].map(picture => ({...picture, run, label: label(picture, "")}));
}

// Return the panels to show for a side: [{id, picture}], and how many stand for one buffer.
export function panelsOf(side, step) {
  const [first, second] = page.runs.map(run => picturesOf(run, stepIn(run, step)));
  if (side === "second") return {group: 1, panels: second.map(picture => ({id: picture.key, picture}))};
  if (side === "first" || !second) return {group: 1, panels: first.map(picture => ({id: picture.key, picture}))};
  const others = new Map(second.map(picture => [picture.key, picture])), panels = [];
  for (const picture of first) {
    const other = others.get(picture.key);
    if (side === "both") {
      panels.push({id: picture.key, picture: {...picture, caption: picture.run.name}});
      if (other) panels.push({id: `${picture.key} of the second`, picture: {...other, caption: other.run.name}});
    } else if (other && other.array !== null && picture.array !== null)
      panels.push({id: picture.key, picture: {...picture, other: other.array, label: `difference of ${picture.title}`}});
  }
  return {group: side === "both" ? 2 : 1, panels};
}

// Return the numbers of the arrays that panels need.
export function arraysOf(panels) {
  return panels.flatMap(({picture}) => [picture.array, picture.valid ?? null, picture.other ?? null]);
}

// Return whether two arrays can be compared cell by cell.
export function comparable(picture) {
  const [a, b] = [arrayAt(picture.array), arrayAt(picture.other)];
  return a.kind === b.kind && a.shape.join() === b.shape.join();
}
