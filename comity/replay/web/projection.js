// From metres in the room to units of the drawing, y upwards to y downwards.

export const SCALE = 100; // drawing units in a metre: browsers round text sizes below 1
export const MARGIN_M = 0.3;

export class Projection {
  /** @param {number[][]} outline corners of the room [m] */
  constructor(outline) {
    const xs = outline.map(([x]) => x);
    const ys = outline.map(([, y]) => y);
    this.left = Math.min(...xs) - MARGIN_M;
    this.top = Math.max(...ys) + MARGIN_M;
    this.width = (Math.max(...xs) - this.left + MARGIN_M) * SCALE;
    this.height = (this.top - Math.min(...ys) + MARGIN_M) * SCALE;
  }

  at(x, y) {
    return [(x - this.left) * SCALE, (this.top - y) * SCALE];
  }

  /** Corners as SVG has them. */
  points(corners) {
    const numbers = corners.map(([x, y]) => this.at(x, y).map((n) => n.toFixed(1)));
    return numbers.map((pair) => pair.join(",")).join(" ");
  }
}

export function middle(corners) {
  const sum = corners.reduce(([a, b], [x, y]) => [a + x, b + y], [0, 0]);
  return sum.map((n) => n / corners.length);
}
