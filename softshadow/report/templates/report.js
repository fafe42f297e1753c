// The report: it shows what is chosen, and listens to the elements that choose.

import {readAddress, writeAddress} from "./address.js";
import {arrayAt, load} from "./arrays.js";
import {chosen, find} from "./chosen.js";
import {page} from "./data.js";
import {arrayCsv, save, savePng} from "./export.js";
import {historyRows, loadHistory} from "./history.js";
import {element, fillLegend, list} from "./legend.js";
import {overlayArray, overlayOf} from "./overlays.js";
import {Panel} from "./panel.js";
import {showHistory, showTexel, showValues} from "./pixel.js";
import {canvasOf, differs} from "./pictures.js";
import {listen} from "./pointing.js";
import {fillQuestions} from "./questions.js";
import {arraysOf, comparable, panelsOf, stepIn} from "./shown.js";
import {fit, reveal, viewOf, zoomBy, zoomTo} from "./views.js";

const panels = new Map();
let visible = [];  // panels on the page, in order
let used = null;  // the view of the panel that was used last
let rendering = 0;  // number of the newest rendering: older ones give way

// -- pictures ---------------------------------------------------------------------------------------------------------
async function render() {
  const turn = ++rendering, {group, panels: wanted} = panelsOf(chosen.side, chosen.step);
  const overlays = page.runs.map(run => overlayArray(chosen.overlay, run.steps[stepIn(run, chosen.step)]));
  await load([...arraysOf(wanted), ...overlays]);
  if (turn !== rendering) return;
  showStep();
  fillChoices(wanted);
  const shown = wanted.filter(({id, picture}) => !chosen.hidden.has(picture.key) && picture.array !== null
    && (picture.other === undefined || comparable(picture)));
  visible = shown.map(({id, picture}) => showPanel(id, picture));
  find("panels").classList.toggle("pairs", group === 2);
  find("panels").replaceChildren(...visible.map(panel => panel.figure));
  redraw();
  showValues(chosen.marker);
  await showHistory(() => turn !== rendering, pointAtRow);
}

function showPanel(id, picture) {
  if (!panels.has(id)) {
    const panel = new Panel(id);
    listen(panel, {point: pointAt, choose: choosePlace, move: moveMarker, redraw});
    panels.set(id, panel);
  }
  const panel = panels.get(id), overlay = picture.key === "colour" ? overlayOf(chosen.overlay, picture.run.steps[picture.from]) : null;
  panel.show(picture, overlay ? [overlay] : []);
  panel.caption.replaceChildren(...captionOf(picture), ...panelButtons(panel));
  fillLegend(panel.legend, picture);
  if (overlay) panel.legend.append(list(overlay.rows));
  panel.figure.classList.toggle("later", Boolean(picture.blank));
  return panel;
}

function captionOf(picture) {
  const title = element("b", picture.title), words = [];
  if (picture.caption) words.push(picture.caption);
  if (picture.other !== undefined) {
    const [a, b] = [arrayAt(picture.array), arrayAt(picture.other)], n = a.shape[0] * a.shape[1];
    let different = 0;
    for (let i = 0; i < n; i++) different += differs(a, b, i);
    words.push(`${different} of ${n} pixels differ`);
  } else if (picture.blank) words.push("nothing drawn yet");
  else if (picture.map && picture.from !== chosen.step) words.push(`of step ${picture.from}`);
  if (picture.note) words.push(picture.note);
  if (picture.changed) words.push("changed in this step");
  return [title, element("span", words.join("; "), {className: "words", title: words.join("; ")})];
}

function panelButtons(panel) {
  const name = `${panel.picture.run.technique}-${panel.picture.from}-${panel.picture.key.replace(/\W+/g, "-")}`;
  const buttons = element("span", "", {className: "buttons"});
  const add = (text, label, action) => {
    const button = element("button", text, {type: "button", title: label});
    button.setAttribute("aria-label", `${label}: ${panel.picture.title}`);
    button.addEventListener("click", action);
    buttons.append(button);
  };
  add("⤢", "larger or smaller", () => { panel.figure.classList.toggle("wide"); redraw(); });
  add("PNG", "save as PNG", () => savePng(canvasOf(panel.picture), `${name}.png`));
  add("CSV", "save all values as CSV", () => save(new Blob([arrayCsv(arrayAt(panel.picture.array))], {type: "text/csv"}), `${name}.csv`));
  return [buttons];
}

function redraw() {
  const lines = page.lines.filter(({name}) => chosen.lines.has(name)).map(({color, places}) => [color, places]);
  if (chosen.row) lines.push(["#ff0", chosen.row]);
  for (const panel of visible) panel.draw(chosen.marker, lines);
  document.body.classList.toggle("zoomed", visible.some(panel => panel.view.zoom > 1));  // a finger pans, not scrolls
}

// -- steps ------------------------------------------------------------------------------------------------------------
function showStep() {
  const steps = page.runs[0].steps, {title} = steps[chosen.step];
  find("slider").value = chosen.step;
  find("slider").setAttribute("aria-valuetext", `step ${chosen.step}: ${title}`);
  find("title").textContent = `${chosen.step}  ${title}`;
  find("previous").disabled = chosen.step === 0;
  find("next").disabled = chosen.step === steps.length - 1;
  const run = chosen.side === "second" ? page.runs[1] : page.runs[0], step = run.steps[stepIn(run, chosen.step)];
  find("calls").replaceChildren(...step.state.map(([call, change]) => {
    const line = element("li", call, {className: change});
    if (change !== "same") line.append(element("span", change === "new" ? " changed in this step" : " no longer", {className: "note"}));
    return line;
  }));
  find("draws").textContent = step.draws.length ? `Drawn: ${step.draws.join("; ")}.` : "";
}

function goTo(step) {
  chosen.step = Math.min(Math.max(step, 0), page.runs[0].steps.length - 1);
  chosen.row = null;
  writeAddress(chosen);
  return render();
}

function fillChoices(wanted) {
  const boxes = [...new Map(wanted.map(({picture}) => [picture.key, picture])).values()].map(picture => {
    const label = element("label"), box = element("input", "", {type: "checkbox", checked: !chosen.hidden.has(picture.key)});
    box.addEventListener("change", () => { chosen.hidden[box.checked ? "delete" : "add"](picture.key); render(); });
    label.append(box, picture.title);
    label.title = picture.note ?? "";
    if (picture.array === null) label.append(" (left out)"), box.disabled = true;
    return label;
  });
  find("pictures").replaceChildren(element("legend", "Pictures"), ...boxes);
}

// -- pixels -----------------------------------------------------------------------------------------------------------
function pointAt(panel, place) {
  if (place && !panel.isWindow) return showTexel(panel, place);
  showValues(place && isInside(place) ? place : chosen.marker);
}

function isInside([x, y]) {
  return x >= 0 && y >= 0 && x < page.size[0] && y < page.size[1];
}

function choosePlace(panel, place) {
  used = panel.view;
  panel.canvas.focus({preventScroll: true});
  if (panel.isWindow && isInside(place)) mark(place);
}

function moveMarker(panel, dx, dy) {
  const [width, height] = page.size, [x, y] = chosen.marker ?? [width >> 1, height >> 1];
  const place = chosen.marker ? [Math.min(Math.max(x + dx, 0), width - 1), Math.min(Math.max(y + dy, 0), height - 1)] : [x, y];
  mark(place);
}

async function mark(place) {
  chosen.marker = place;
  chosen.row = null;
  reveal(viewOf(...page.size), ...place);
  writeAddress(chosen);
  redraw();
  showValues(place);
  const turn = rendering;
  await showHistory(() => turn !== rendering || chosen.marker !== place, pointAtRow);
  find("status").textContent = find("values").textContent;
}

function pointAtRow(outline) {
  chosen.row = outline;
  redraw();
}

// -- the elements of the page -----------------------------------------------------------------------------------------
find("slider").addEventListener("input", event => goTo(Number(event.target.value)));
find("previous").addEventListener("click", () => goTo(chosen.step - 1));
find("next").addEventListener("click", () => goTo(chosen.step + 1));
find("overlay").addEventListener("change", event => { chosen.overlay = event.target.value; render(); });
for (const radio of document.querySelectorAll("[name=side]")) {
  radio.checked = radio.value === chosen.side;
  radio.addEventListener("change", () => { chosen.side = radio.value; writeAddress(chosen); render(); });
}
for (const box of document.querySelectorAll("[name=lines]"))
  box.addEventListener("change", () => { chosen.lines[box.checked ? "add" : "delete"](box.value); redraw(); });

const CELL_WITH_DIGITS = 44;  // CSS pixels
// Zoom the pictures that are as large as the one that was used last.
function zoom(how) {
  const panel = visible.find(({view}) => view === used) ?? visible.find(({isWindow}) => isWindow) ?? visible[0];
  if (!panel) return;
  const place = panel.isWindow && chosen.marker ? chosen.marker.map(value => value + 0.5) : [panel.view.x, panel.view.y];
  if (how === "fit") fit(panel.view);
  else if (how === "digits") zoomTo(panel.view, CELL_WITH_DIGITS, panel.cell, place);
  else zoomBy(panel.view, how === "in" ? 2 : 0.5, panel.cell);
  redraw();
}
for (const button of document.querySelectorAll("[data-zoom]")) button.addEventListener("click", () => zoom(button.dataset.zoom));

const KEYS = {",": () => goTo(chosen.step - 1), ".": () => goTo(chosen.step + 1), "+": () => zoom("in"), "-": () => zoom("out"), "0": () => zoom("fit"), "1": () => zoom("digits")};
const FROM_PAGE = {ArrowLeft: KEYS[","], ArrowRight: KEYS["."]};
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.altKey || event.metaKey || event.target.matches("input:not([type=checkbox], [type=radio]), select, textarea")) return;
  const action = KEYS[event.key] ?? (event.target === document.body ? FROM_PAGE[event.key] : undefined);
  if (!action) return;
  event.preventDefault();
  action();
});
find("theme").addEventListener("change", event => { document.documentElement.dataset.theme = event.target.value; });
find("view3d")?.addEventListener("toggle", event => {  // the view is unpacked when it is first opened
  if (!event.target.querySelector("iframe")) event.target.append(element("iframe", "", {title: "3-D view", srcdoc: page.view3d}));
});
addEventListener("message", event => {  // the 3-D view is ready
  if (event.data?.softshadow === "view3d" && chosen.marker) mark(chosen.marker);
});
addEventListener("hashchange", () => { Object.assign(chosen, readAddress()); render(); });
new ResizeObserver(redraw).observe(find("panels"));
fillQuestions(find("questions"), page.questions, (question, step) => { chosen.marker = [question.x, question.y]; return goTo(step); });

// for tests, and for those who look: the rows of any pixel
window.softshadow = {page, chosen, goTo, mark, arrayAt, load, async rows(x, y, run = 0) {
  await loadHistory(page.runs[run]);
  return historyRows(page.runs[run], x, y);
}};
render().then(() => { document.documentElement.dataset.ready = "yes"; });
