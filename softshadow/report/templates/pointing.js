// Pointer and keys on a panel: point, choose a pixel, pan, pinch. The page still scrolls while nothing is zoomed.

import {pan, zoomBy} from "./views.js";

const MOVES = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
const STILL = 5;  // CSS pixels that a finger may move while it chooses a pixel

// Call `actions` {point, choose, move, redraw, fit} as a panel is used.
export function listen(panel, actions) {
  const {canvas} = panel, down = new Map();
  let start = null, moved = false;
  const within = event => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const pixel = event => panel.place(...within(event)).map(Math.floor);

  canvas.addEventListener("pointerdown", event => {
    down.set(event.pointerId, within(event));
    start = within(event);
    moved = down.size > 1;
  });
  canvas.addEventListener("pointermove", event => {
    const now = within(event), before = down.get(event.pointerId);
    actions.point(panel, pixel(event));
    if (!before) return;
    if (!moved && Math.hypot(now[0] - start[0], now[1] - start[1]) > STILL) {
      moved = true;
      canvas.setPointerCapture(event.pointerId);
    }
    const others = [...down].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
    if (others.length) {
      const distance = place => Math.hypot(place[0] - others[0][0], place[1] - others[0][1]);
      zoomBy(panel.view, distance(now) / Math.max(1, distance(before)), panel.cell, panel.place(...now));
    } else if (moved) pan(panel.view, now[0] - before[0], now[1] - before[1], panel.cell);
    down.set(event.pointerId, now);
    if (moved || others.length) actions.redraw();
  });
  canvas.addEventListener("pointerup", event => {
    if (!moved && down.size === 1) actions.choose(panel, pixel(event));
    down.delete(event.pointerId);
  });
  for (const end of ["pointercancel", "pointerleave"]) canvas.addEventListener(end, event => down.delete(event.pointerId));
  canvas.addEventListener("pointerleave", () => actions.point(panel, null));
  canvas.addEventListener("wheel", event => {
    if (!event.ctrlKey && !event.metaKey) return;  // the page scrolls
    event.preventDefault();
    zoomBy(panel.view, Math.exp(-event.deltaY / 200), panel.cell, panel.place(...within(event)));
    actions.redraw();
  }, {passive: false});
  canvas.addEventListener("keydown", event => {
    const by = MOVES[event.key];
    if (!by || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    const times = event.shiftKey ? 10 : 1;
    actions.move(panel, by[0] * times, by[1] * times);
  });
}
