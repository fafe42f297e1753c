// The browser's side of softshadow.notebook.play: sliders, the picture, and the history of the clicked pixel.
// Text goes in by textContent, so a name with HTML in it is shown as it is.

const PATIENCE = 5000; // milliseconds without an answer, after which the kernel counts as not running

function make(tag, properties = {}, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

// -- controls ---------------------------------------------------------------------------------------------------------

function spelled(value) {
  return value === null || value === undefined ? "" : Number.isInteger(value) ? `${value}` : `${+value.toPrecision(4)}`;
}

// Returns the label of a control, and a function that puts a value into it.
function makeControl(control, changed) {
  const output = make("output");
  let input, show;
  if (control.kind === "range") {
    input = make("input", { type: "range", min: control.min, max: control.max, step: "any" });
    const snapped = () => {
      const steps = Math.round((input.valueAsNumber - control.min) / control.step);
      return Math.min(control.max, +(control.min + steps * control.step).toPrecision(9));
    };
    input.addEventListener("input", () => changed(snapped()));
    input.addEventListener("keydown", (event) => {
      const direction = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
      if (!direction) return;
      event.preventDefault();
      input.valueAsNumber += direction * control.step;
      changed(snapped());
    });
    show = (value) => { input.value = value; output.value = spelled(value); };
  } else if (control.kind === "stops") {
    input = make("input", { type: "range", min: 0, max: control.choices.length - 1, step: 1 });
    input.addEventListener("input", () => changed(control.choices[input.valueAsNumber]));
    show = (value) => {
      input.value = control.choices.indexOf(value);
      input.setAttribute("aria-valuetext", spelled(value));
      output.value = spelled(value);
    };
  } else if (control.kind === "choice") {
    input = make("select", {}, ...control.choices.map((name) => make("option", { value: name, textContent: name })));
    input.addEventListener("change", () => changed(input.value));
    show = (value) => { input.value = value; };
  } else if (control.kind === "switch") {
    input = make("input", { type: "checkbox" });
    input.addEventListener("change", () => changed(input.checked));
    show = (value) => { input.checked = value; };
  } else if (control.kind === "number") {
    input = make("input", { type: "number", step: "any", placeholder: "chosen" });
    input.addEventListener("change", () => changed(input.value === "" ? null : input.valueAsNumber));
    show = (value) => { input.value = value ?? ""; };
  } else {
    input = make("input", { type: "text" });
    input.addEventListener("change", () => changed(input.value));
    show = (value) => { input.value = value; };
  }
  input.name = control.key;
  return { element: make("label", { title: control.help }, make("span", { textContent: control.label }), input, output), show };
}

// -- the widget -------------------------------------------------------------------------------------------------------

function render({ model, el }) {
  const [width, height] = model.get("size");
  const image = make("img", { width, height, alt: "" });
  const mark = make("div", { className: "mark", hidden: true });
  const frame = make("div", { className: "frame", tabIndex: 0 }, image, mark);
  const view = make("select", { name: "view" });
  const reset = make("button", { type: "button", textContent: "Reset" });
  const status = make("span", { className: "status" });
  const messages = make("div", { ariaLive: "polite" });
  const explanation = make("p", { className: "explanation", ariaLive: "polite" });
  const history = make("div", { className: "history", tabIndex: 0 });
  frame.setAttribute("role", "application");
  frame.setAttribute("aria-label", "Picture. Click a pixel, or move with the arrow keys, to see its history.");

  // values go one way at a time: the next ones are sent when the picture of the last ones has come
  let values = { ...model.get("values") };
  let waiting = 0, pending = false;
  const send = () => {
    if (waiting) { pending = true; return; }
    if (JSON.stringify(values) === JSON.stringify(model.get("values"))) return;
    waiting = setTimeout(() => { waiting = 0; status.textContent = "no answer: the sliders need a running kernel"; }, PATIENCE);
    model.set("values", { ...values });
    model.save_changes();
  };

  const controls = new Map();
  const groups = { light: make("div"), main: make("div"), more: make("div") };
  const initial = {};
  for (const control of model.get("controls")) {
    initial[control.key] = control.value;
    const { element, show } = makeControl(control, (value) => {
      values[control.key] = value;
      show(value);
      send();
    });
    controls.set(control.key, show);
    groups[control.group].append(element);
  }
  const showValues = () => controls.forEach((show, key) => show(values[key]));
  const panel = make("div", { className: "panel" }, groups.light, groups.main);
  if (groups.more.childElementCount) {
    panel.append(make("details", {}, make("summary", { textContent: "More options" }), groups.more));
  }
  reset.addEventListener("click", () => { values = { ...initial }; showValues(); send(); });

  // -- the picture and its pixels
  let url = "";
  const showPicture = () => {
    URL.revokeObjectURL(url);
    url = URL.createObjectURL(new Blob([model.get("picture")], { type: "image/png" }));
    image.src = url;
    image.alt = `${model.get("view")} of ${model.get("heading")}`;
  };
  const isOfWindow = () => image.naturalWidth === width && image.naturalHeight === height;
  const showMark = () => {
    const pixel = model.get("pixel");
    mark.hidden = !pixel || !isOfWindow();
    if (!pixel) return;
    Object.assign(mark.style, {
      left: `calc(${(100 * pixel[0]) / width}% - 2px)`, top: `calc(${(100 * pixel[1]) / height}% - 2px)`,
      width: `calc(${100 / width}% + 4px)`, height: `calc(${100 / height}% + 4px)`,
    });
  };
  const choosePixel = (x, y) => {
    const within = (value, end) => Math.max(0, Math.min(end - 1, value));
    model.set("pixel", [within(x, width), within(y, height)]);
    model.save_changes();
  };
  image.addEventListener("load", showMark);
  frame.addEventListener("click", (event) => {
    if (!isOfWindow()) { status.textContent = "this map has no pixels of the window"; return; }
    const box = image.getBoundingClientRect();
    choosePixel(
      Math.floor(((event.clientX - box.left) / box.width) * width),
      Math.floor(((event.clientY - box.top) / box.height) * height),
    );
  });
  frame.addEventListener("keydown", (event) => {
    const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!by || !isOfWindow()) return;
    event.preventDefault();
    event.stopPropagation(); // the notebook moves between cells with these keys
    const [x, y] = model.get("pixel") ?? [width >> 1, height >> 1];
    const far = event.shiftKey ? 10 : 1;
    choosePixel(x + far * by[0], y + far * by[1]);
  });

  // -- text
  const showViews = () => {
    view.replaceChildren(...model.get("views").map((name) => make("option", { value: name, textContent: name })));
    view.value = model.get("view");
  };
  view.addEventListener("change", () => { model.set("view", view.value); model.save_changes(); });
  const showMessages = () => {
    const kind = model.get("failed") ? "message error" : "message";
    messages.replaceChildren(...model.get("messages").map((text) => make("div", { className: kind, textContent: text })));
  };
  const showExplanation = () => { explanation.textContent = model.get("explanation"); };
  const showHistory = () => {
    history.hidden = !model.get("history");
    history.innerHTML = model.get("history"); // a table of the package, with its text escaped
  };
  const answered = () => {
    clearTimeout(waiting);
    waiting = 0;
    status.textContent = `${width} x ${height}, ${Math.round(model.get("milliseconds"))} ms`;
    if (pending) { pending = false; send(); }
  };
  const valuesChanged = () => {
    if (waiting || pending) return; // the echo of what this side has sent
    values = { ...model.get("values") };
    showValues();
  };

  el.replaceChildren(make("div", { className: "softshadow-player" },
    make("h4", { textContent: model.get("heading") }),
    make("div", { className: "stage" },
      make("div", {}, frame, make("div", { className: "below" },
        make("label", {}, make("span", { textContent: "Show" }), view), reset, status)),
      panel),
    messages, explanation, history,
  ));
  const listeners = {
    "change:picture": showPicture, "change:pixel": showMark, "change:views": showViews, "change:view": showViews,
    "change:messages": showMessages, "change:failed": showMessages, "change:explanation": showExplanation,
    "change:history": showHistory, "change:drawn": answered, "change:values": valuesChanged,
  };
  Object.entries(listeners).forEach(([event, listener]) => model.on(event, listener));
  [showValues, showPicture, showViews, showMessages, showExplanation, showHistory, answered].forEach((show) => show());
  return () => {
    clearTimeout(waiting);
    URL.revokeObjectURL(url);
    Object.entries(listeners).forEach(([event, listener]) => model.off(event, listener));
  };
}

export default { render };
