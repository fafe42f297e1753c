// Zoom and pan, linked: pictures of one size share a view. A view is a zoom (1 shows all) and the centre in pixels.

const views = new Map();
const LARGEST_CELL = 64;  // CSS pixels of one pixel at the largest zoom

// Return the view of pictures of this size.
export function viewOf(width, height) {
  const key = `${width} ${height}`;
  if (!views.has(key)) views.set(key, {width, height, zoom: 1, x: width / 2, y: height / 2});
  return views.get(key);
}

// Zoom so that the place (in pixels of the picture) keeps its position; `cell` is the present size of a pixel.
export function zoomBy(view, factor, cell, place = [view.x, view.y]) {
  const zoom = Math.min(Math.max(1, view.zoom * factor), Math.max(1, LARGEST_CELL * view.zoom / cell));
  const change = zoom / view.zoom;
  view.x = place[0] + (view.x - place[0]) / change;
  view.y = place[1] + (view.y - place[1]) / change;
  view.zoom = zoom;
  keepInside(view);
}

// Zoom so that pixels have this size on the screen, round a place.
export function zoomTo(view, size, cell, place) {
  [view.x, view.y] = place;
  zoomBy(view, size / cell, cell, place);
}

export function fit(view) {
  Object.assign(view, {zoom: 1, x: view.width / 2, y: view.height / 2});
}

// Move the view by CSS pixels.
export function pan(view, dx, dy, cell) {
  view.x -= dx / cell;
  view.y -= dy / cell;
  keepInside(view);
}

// Move the view so that a pixel can be seen.
export function reveal(view, x, y) {
  const across = view.width / view.zoom / 2, down = view.height / view.zoom / 2;
  if (Math.abs(x + 0.5 - view.x) > across) view.x = x + 0.5;
  if (Math.abs(y + 0.5 - view.y) > down) view.y = y + 0.5;
  keepInside(view);
}

function keepInside(view) {
  for (const [axis, size] of [["x", view.width], ["y", view.height]]) {
    const half = size / view.zoom / 2;
    view[axis] = Math.min(Math.max(view[axis], half), size - half);
  }
}
