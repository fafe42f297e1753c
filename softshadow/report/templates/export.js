// Copying and saving: comma-separated values, and pictures as PNG.

// Copy a text; return whether that was possible.
export async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {  // a page in an iframe may not
    return false;
  }
}

// Offer a file to save.
export function save(blob, name) {
  const link = Object.assign(document.createElement("a"), {href: URL.createObjectURL(blob), download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

// Return the values of an array as comma-separated values, a line per row; channels are separated by spaces.
export function arrayCsv({values, shape}) {
  const [height, width] = shape, channels = shape[2] ?? 1, lines = [];
  for (let y = 0; y < height; y++) {
    const cells = [];
    for (let x = 0; x < width; x++) cells.push(Array.from(values.subarray((y * width + x) * channels, (y * width + x + 1) * channels)).join(" "));
    lines.push(cells.join(","));
  }
  return lines.join("\n") + "\n";
}

// Save a canvas as PNG.
export function savePng(canvas, name) {
  canvas.toBlob(blob => save(blob, name));
}
