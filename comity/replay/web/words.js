// Names and numbers as people read them.

/** `conversational_distance` as people say it. */
export const plain = (name) => String(name).replaceAll("_", " ");

/** A name that stands in a drawing, cut where it would cover the others: the whole of it is in the title. */
export const short = (name, most = 26) => (name.length > most ? `${name.slice(0, most - 1).trim()}…` : name);

/** A value with its unit, as everywhere in Comity: degrees to a tenth, other numbers to a thousandth. */
export function measured(value, unit, digits = unit === "deg" ? 1 : 3) {
  if (value === null || value === undefined) return "–";
  if (typeof value !== "number") return Array.isArray(value) ? value.join("..") : plain(value);
  const number = (Math.round(value * 10 ** digits) / 10 ** digits + 0).toFixed(digits);
  return unit && unit !== "1" ? `${number} ${unit}` : number;
}

/** A time on the clock. */
export const seconds = (t) => `${t.toFixed(2)} s`;

/** A fact: a number without needless zeros, a word, a range, or that it was kept back. */
export function fact(value, unit) {
  if (value === null || value === undefined) return "not disclosed";
  const text = Array.isArray(value) ? value.join("..") : plain(value);
  return unit && unit !== "1" && typeof value !== "string" ? `${text} ${unit}` : text;
}
