// Numbers as text: as Python prints them in a pixel history, and with all digits that a buffer holds.

// Return a number like Python's format "%.{digits}g".
export function general(value, digits) {
  if (value === 0) return "0";
  let [mantissa, exponent] = rounded(value, digits).split("e");
  exponent = Number(exponent);
  if (exponent >= -4 && exponent < digits) return trimmed(positional(mantissa, exponent));
  return `${trimmed(mantissa)}e${exponent < 0 ? "-" : "+"}${String(Math.abs(exponent)).padStart(2, "0")}`;
}

// Return a number in exponential form; a tie goes to the even digit, where toExponential takes the larger number.
function rounded(value, digits) {
  const exact = value.toExponential(60), [mantissa, exponent] = exact.split("e");
  const rest = mantissa.replace(/\D/g, "").slice(digits), last = Number(mantissa.replace(/\D/g, "")[digits - 1]);
  if (!/^50*$/.test(rest) || last % 2) return value.toExponential(digits - 1);
  return `${mantissa.slice(0, mantissa.indexOf(".") + digits)}e${exponent}`;
}

function positional(mantissa, exponent) {
  const sign = mantissa.startsWith("-") ? "-" : "", all = mantissa.replace(/\D/g, "");
  if (exponent < 0) return `${sign}0.${"0".repeat(-exponent - 1)}${all}`;
  return `${sign}${all.slice(0, exponent + 1).padEnd(exponent + 1, "0")}.${all.slice(exponent + 1)}`;
}

function trimmed(text) {
  return text.includes(".") ? text.replace(/\.?0*$/, "") : text;
}

// Return two numbers with enough digits to tell them apart, at least six.
export function unlike(a, b) {
  for (let digits = 6; digits < 18; digits++) {
    const pair = [general(a, digits), general(b, digits)];
    if (a === b || pair[0] !== pair[1]) return pair;
  }
  return [general(a, 17), general(b, 17)];
}

// Return the shortest text that is read as this float32 again.
export function shortest(value) {
  if (!Number.isFinite(value)) return String(value);
  for (let digits = 1; digits < 9; digits++) if (Math.fround(Number(value.toPrecision(digits))) === value) return general(value, digits);
  return general(value, 9);
}

// Return the value of one cell as text; `lines` puts the channels of a colour below each other.
export function cellText({values, shape, kind}, i, separator = " ") {
  const channels = shape[2] ?? 1, one = value => kind.startsWith("float") ? shortest(value) : String(value);
  if (kind === "bool") return values[i] ? "yes" : "no";
  return Array.from(values.subarray(i * channels, (i + 1) * channels), one).join(separator);
}
