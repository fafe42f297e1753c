// One picture on the page: a canvas with the part that the view shows, digits, lines and the marker.

import {arrayAt} from "./arrays.js";
import {page} from "./data.js";
import {canvasOf} from "./pictures.js";
import {cellText} from "./numbers.js";
import {viewOf} from "./views.js";

const DIGIT_HEIGHT = 9;  // CSS pixels: smaller digits are not drawn
const MARKER = 9;  // CSS pixels: the marker's smallest side

export class Panel {
  // Create the elements of a panel: figure, canvas, caption, legend.
  constructor(id) {
    this.id = id;
    this.figure = document.createElement("figure");
    this.canvas = document.createElement("canvas");
    this.caption = document.createElement("figcaption");
    this.legend = document.createElement("div");
    this.figure.dataset.panel = id;
    Object.assign(this.canvas, {tabIndex: 0});
    this.canvas.setAttribute("role", "application");
    this.canvas.setAttribute("aria-describedby", "keys");
    this.legend.className = "legend";
    this.figure.append(this.caption, this.canvas, this.legend);
  }

  // Take the picture to show; overlays are further canvases drawn over it.
  show(picture, overlays = []) {
    this.picture = picture;
    this.overlays = overlays;
    [this.height, this.width] = arrayAt(picture.array).shape;
    this.view = viewOf(this.width, this.height);
    this.canvas.style.aspectRatio = `${this.width} / ${this.height}`;
    this.canvas.setAttribute("aria-label", picture.label);
  }

  // The size of one pixel on the screen, in CSS pixels.
  get cell() {
    return this.canvas.clientWidth / this.width * this.view.zoom;
  }

  // Return the pixel of the picture at a place of the canvas in CSS pixels, not rounded.
  place(x, y) {
    return [this.left + x / this.cell, this.top + y / this.cell];
  }

  get left() { return this.view.x - this.width / this.view.zoom / 2; }
  get top() { return this.view.y - this.height / this.view.zoom / 2; }

  // Draw the visible part; `lines` are [colour, [x0, y0, x1, y1, ...]] in pixels of the window.
  draw(marker, lines) {
    const ratio = devicePixelRatio, width = Math.round(this.canvas.clientWidth * ratio);
    const height = Math.round(width * this.height / this.width);
    if (!width) return;
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, {width, height});
    const context = this.canvas.getContext("2d"), scale = this.cell * ratio;
    context.setTransform(scale, 0, 0, scale, -this.left * scale, -this.top * scale);
    context.imageSmoothingEnabled = scale < 1;
    context.drawImage(canvasOf(this.picture), 0, 0);
    for (const overlay of this.overlays) {
      context.globalAlpha = overlay.alpha;
      context.drawImage(overlay.canvas, 0, 0);
      context.globalAlpha = 1;
    }
    this.drawDigits(context);
    if (!this.isWindow) return;
    for (const [color, places] of lines) this.drawLines(context, color, places);
    if (marker) this.drawMarker(context, marker);
  }

  get isWindow() { return this.width === page.size[0] && this.height === page.size[1]; }

  drawLines(context, color, places) {
    context.beginPath();
    for (let i = 0; i < places.length; i += 4) {
      context.moveTo(places[i], places[i + 1]);
      context.lineTo(places[i + 2], places[i + 3]);
    }
    for (const [style, size] of [["#0008", 2.5], [color, 1.25]])
      Object.assign(context, {strokeStyle: style, lineWidth: size / this.cell}), context.stroke();
  }

  // Ring the pixel, in black and white so that it is seen on everything.
  drawMarker(context, [x, y]) {
    const side = Math.max(1, MARKER / this.cell), left = x + 0.5 - side / 2, top = y + 0.5 - side / 2;
    for (const [style, size] of [["#000", 4], ["#fff", 2]]) {
      Object.assign(context, {strokeStyle: style, lineWidth: size / this.cell});
      context.strokeRect(left, top, side, side);
      if (side === 1) continue;  // a pixel this large needs no arms, and its neighbours have digits
      context.beginPath();
      for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
        context.moveTo(x + 0.5 + dx * side * 0.75, y + 0.5 + dy * side * 0.75);
        context.lineTo(x + 0.5 + dx * side * 1.75, y + 0.5 + dy * side * 1.75);
      }
      context.stroke();
    }
  }

  // Write the exact value into each visible cell that has room for it.
  drawDigits(context) {
    const array = arrayAt(this.picture.array), {cell} = this;
    if (cell < 2 * DIGIT_HEIGHT) return;
    const {pixels} = canvasOf(this.picture);
    const first = [Math.max(0, Math.floor(this.left)), Math.max(0, Math.floor(this.top))];
    const end = [Math.min(this.width, Math.ceil(this.left + this.width / this.view.zoom)), Math.min(this.height, Math.ceil(this.top + this.height / this.view.zoom))];
    context.textAlign = "center";
    context.textBaseline = "middle";
    for (let y = first[1]; y < end[1]; y++) for (let x = first[0]; x < end[0]; x++) {
      const texts = digitsOf(array, y * this.width + x);
      const size = Math.min(16, cell * 0.9 / texts.length, cell * 1.6 / Math.max(...texts.map(text => text.length)));
      if (size < DIGIT_HEIGHT * 0.7) return;
      context.font = `${size / cell}px ui-monospace, monospace`;
      const [red, green, blue] = pixels.subarray(4 * (y * this.width + x));
      context.fillStyle = 0.299 * red + 0.587 * green + 0.114 * blue > 128 ? "#000" : "#fff";
      texts.forEach((text, n) => context.fillText(text, x + 0.5, y + 0.5 + (n - (texts.length - 1) / 2) * size / cell));
    }
  }
}

const LONG = 5;  // characters: a number with more takes two lines

// Return the lines of a cell: a channel each, and the digits of a long number in two parts.
function digitsOf(array, i) {
  const texts = cellText(array, i, "\n").split("\n");
  if (texts.length > 1 || texts[0].length <= LONG) return texts;
  const middle = Math.max(LONG + 1, Math.ceil(texts[0].length / 2));
  return [texts[0].slice(0, middle), texts[0].slice(middle)];
}
