// How people are told apart: by the colours of their pictures, and where there are too many by hollow signs.

/** Class and style of what shows a person. */
export const lookOf = ({ colour: { light, dark, distinct } }) => ({
  class: `of-person${distinct ? "" : " hollow"}`,
  style: `--light: ${light}; --dark: ${dark}`,
});

/** The look with one more class. */
export const withClass = (name, look) => ({ ...look, class: `${name} ${look.class}` });
