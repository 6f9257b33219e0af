// Every text that can be seen and stands out too little from its ground (WCAG 2.2, 1.4.3): its ratio, class and words.
() => {
  const NUMBERS = /[\d.]+/g;
  const parse = (colour) => {
    const [r, g, b, alpha = 1] = colour.match(NUMBERS).map(Number);
    return [r, g, b, alpha];
  };
  const linear = (v) => (v / 255 <= 0.03928 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4);
  const luminance = ([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
  const over = (top, below) => [0, 1, 2].map((i) => top[3] * top[i] + (1 - top[3]) * below[i]);
  const above = function* (element) {
    for (let one = element; one; one = one.parentElement) yield one;
  };
  const grounds = (element) => {
    if (element.closest(".world svg")) return inWorld(element);
    const layers = [...above(element)].map((one) => parse(getComputedStyle(one).backgroundColor)).reverse();
    return [layers.reduce((below, top) => over(top, below), [255, 255, 255])];
  };
  const fill = (one) => parse(getComputedStyle(one).fill);
  const veil = (one) => [...fill(one).slice(0, 3), getComputedStyle(one).opacity * getComputedStyle(one).fillOpacity];
  const inWorld = (element) => {
    const all = (kinds) => [...document.querySelectorAll(kinds)];
    if (getComputedStyle(element).stroke !== "none") return all(".room").map((one) => fill(one).slice(0, 3)); // its halo
    const bare = all(".room, .furniture").map((one) => fill(one).slice(0, 3));
    const seen = bare.flatMap((below) => [below, ...all(".gaze").map((one) => over(veil(one), below))]);
    return seen.flatMap((below) => [below, ...all(".ring").map((one) => over(veil(one), below))]);
  };
  const contrast = (...colours) => {
    const [dark, light] = colours.map(luminance).sort((one, other) => one - other);
    return (light + 0.05) / (dark + 0.05);
  };
  const weak = new Set();
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const element = texts.currentNode.parentElement;
    const words = texts.currentNode.textContent.trim();
    if (!words || element.closest("script, noscript, title") || !element.checkVisibility()) continue;
    const least = element.closest("[aria-hidden=true]") ? 3 : 4.5; // signs are graphics: their words are beside them
    const style = getComputedStyle(element);
    const [r, g, b, alpha] = parse(element instanceof SVGElement ? style.fill : style.color);
    const opacity = [...above(element)].reduce((all, one) => all * getComputedStyle(one).opacity, alpha);
    const ratio = Math.min(...grounds(element).map((below) => contrast(over([r, g, b, opacity], below), below)));
    if (ratio < least) weak.add(`${ratio.toFixed(2)} ${element.getAttribute("class")} ${words.slice(0, 30)}`);
  }
  return [...weak];
};
