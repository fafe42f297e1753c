// Shows the exact buffer values under the pointer (not those of the pictures); x and y from the top left, GL's y from the bottom.
const [width, height] = size;
const line = document.getElementById("values");
const unpacked = new Map();

async function inflate(text) {
  const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

async function buffers(step) {
  if (!unpacked.has(step)) {
    const [colour, shuffled, stencil] = await Promise.all(["colour", "depth", "stencil"].map(k => inflate(packed[step][k])));
    const n = width * height, depth = new Uint8Array(4 * n);
    for (let i = 0; i < n; i++) for (let b = 0; b < 4; b++) depth[4 * i + b] = shuffled[b * n + i];
    unpacked.set(step, {colour, depth: new Float32Array(depth.buffer), stencil});
  }
  return unpacked.get(step);
}

let at = null;

async function show(step, x, y) {
  if (x < 0 || y < 0 || x >= width || y >= height || !packed[step]) return;
  at = {step, x, y};
  const {colour, depth, stencil} = await buffers(step);
  const i = y * width + x, s = stencil[i];
  line.textContent = `step ${step}  x=${x} y=${y} (GL y=${height - 1 - y})  colour ${colour.slice(3 * i, 3 * i + 3).join(" ")}` +
    `  depth ${depth[i].toFixed(7)}  stencil ${s} (${s.toString(2).padStart(8, "0")})`;
}

function remember() {
  try { history.replaceState(null, "", `#step=${at.step}&x=${at.x}&y=${at.y}`); } catch { /* a page in an iframe has no address */ }
}

for (const section of document.querySelectorAll("section[data-step]")) {
  const step = Number(section.dataset.step);
  [...section.querySelectorAll("img")].slice(0, 3).forEach(img => {
    const where = e => [Math.floor(e.offsetX / img.clientWidth * width), Math.floor(e.offsetY / img.clientHeight * height)];
    img.addEventListener("mousemove", e => show(step, ...where(e)));
    img.addEventListener("click", async e => { await show(step, ...where(e)); remember(); });
  });
}

document.addEventListener("keydown", async e => {
  const moves = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
  if (!at || !(e.key in moves)) return;
  e.preventDefault();
  await show(at.step, at.x + moves[e.key][0], at.y + moves[e.key][1]);
  remember();
});

const address = new URLSearchParams(location.hash.slice(1));
if (address.has("x")) show(Number(address.get("step") ?? 0), Number(address.get("x")), Number(address.get("y")));
