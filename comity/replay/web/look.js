// How people are told apart: by colour, and where the colours come round again by hollow signs.

const COLOURS = 6;

/** The classes of the person at a place of the list. */
export const lookOf = (i) => `person-${i % COLOURS}${i < COLOURS ? "" : " hollow"}`;
