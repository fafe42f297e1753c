// What the rasterizer does with one fragment, in its own arithmetic: coverage in integers, depth in float32, the tests.
// Equal to raster/coverage.py, raster/depth.py and raster/fragment_ops.py; tests compare the rows of histories.

const FUNCTIONS = {
  0x200: () => false, 0x201: (a, b) => a < b, 0x202: (a, b) => a === b, 0x203: (a, b) => a <= b,
  0x204: (a, b) => a > b, 0x205: (a, b) => a !== b, 0x206: (a, b) => a >= b, 0x207: () => true,
};
const STENCIL_OPERATIONS = {
  0x1E00: s => s, 0: () => 0, 0x1E01: (s, ref) => ref,
  0x1E02: (s, ref, largest) => s === largest ? s : (s + 1) & 255, 0x1E03: s => s === 0 ? 0 : s - 1,
  0x8507: (s, ref, largest) => (s + 1) & largest, 0x8508: (s, ref, largest) => (s - 1) & largest,
  0x150A: (s, ref, largest) => s ^ largest,
};
const SAFE = 1 << 25;  // corners in 1/256 pixel below which every product stays below 2 ** 53

// Return whether triangle t covers the centre of a pixel.
export function covers(corners, t, column, row, downwards) {
  const at = 6 * t;
  for (let k = at; k < at + 6; k++) if (Math.abs(corners[k]) >= SAFE) return coversLarge(corners, t, column, row, downwards);
  for (let k = 0; k < 6; k += 2) {
    const x0 = corners[at + k], y0 = corners[at + k + 1], x1 = corners[at + (k + 2) % 6], y1 = corners[at + (k + 3) % 6];
    const across = y0 - y1, along = x0 - x1;
    const inclusive = across < 0 || (across === 0 && (along < 0) === (downwards === 1));
    if (across * (x0 - 256 * column) - along * (y0 - 256 * row) < (inclusive ? 0 : 1)) return false;
  }
  return true;
}

function coversLarge(corners, t, column, row, downwards) {
  const c = Array.from(corners.subarray(6 * t, 6 * t + 6), BigInt), x = BigInt(256 * column), y = BigInt(256 * row);
  for (let k = 0; k < 6; k += 2) {
    const across = c[k + 1] - c[(k + 3) % 6], along = c[k] - c[(k + 2) % 6];
    const inclusive = across < 0n || (across === 0n && (along < 0n) === (downwards === 1));
    if (across * (c[k] - x) - along * (c[k + 1] - y) < (inclusive ? 0n : 1n)) return false;
  }
  return true;
}

// Return the depth of triangle t at a pixel, in buffer units.
export function fragmentDepth(planes, t, column, row, [low, high], largest, single) {
  const round = single ? Math.fround : value => value;
  const [z0, dz, dzRow, offset] = planes.subarray(4 * t, 4 * t + 4);
  let z = round(round(round(round(dz * column) + z0) + round(dzRow * row)) + offset);
  z = z < high ? z : high;
  z = z > low ? z : low;
  return largest ? evenRound(round(z * largest)) : z;
}

// Return a number rounded to the nearest integer, half to even.
function evenRound(value) {
  const below = Math.floor(value), rest = value - below;
  return rest > 0.5 || (rest === 0.5 && below % 2) ? below + 1 : below;
}

// Return window z of a depth in buffer units.
export function windowZ(units, largest) {
  return Math.fround(largest ? Math.min(units, largest) / largest : units);
}

// Return {verdict, stencil, depth} after the tests; `ops` are the fields of FragmentOps by name.
export function processFragment(ops, inside, alpha, z, storedZ, s) {
  if (!inside) return {verdict: "scissor", stencil: s, depth: storedZ};
  if (ops.alpha_test && !FUNCTIONS[ops.alpha_func](alpha, ops.alpha_ref)) return {verdict: "alpha failed", stencil: s, depth: storedZ};
  const stencilPassed = !ops.stencil_test || FUNCTIONS[ops.stencil_func](ops.ref & ops.read_mask, s & ops.read_mask);
  const depthPassed = !ops.depth_test || FUNCTIONS[ops.depth_func](z, storedZ);
  if (ops.stencil_test) {
    const operation = STENCIL_OPERATIONS[stencilPassed ? (depthPassed ? ops.zpass : ops.zfail) : ops.sfail];
    const after = operation(s, ops.ref, ops.stencil_largest);
    s = (s & ~ops.write_mask & 255) | (after & ops.write_mask);
  }
  const passed = stencilPassed && depthPassed;
  return {
    verdict: passed ? "passed" : stencilPassed ? "depth failed" : "stencil failed",
    stencil: s, depth: ops.depth_write && passed ? z : storedZ,
  };
}
