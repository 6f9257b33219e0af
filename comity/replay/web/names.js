// Names that come from files as keys: `constructor` and `__proto__` are people like any other.

/** JSON whose objects have the keys of the text, and inherit none. */
export const parsed = (text) =>
  JSON.parse(text, (_, value) =>
    value !== null && typeof value === "object" && !Array.isArray(value)
      ? Object.setPrototypeOf(value, null)
      : value,
  );

/** What is known by name, of several such objects together; later ones go before. */
export const together = (...all) => Object.setPrototypeOf(Object.fromEntries(all.flatMap(entries)), null);

const entries = (known) => Object.entries(known ?? {});
