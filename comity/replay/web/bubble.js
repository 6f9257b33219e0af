// What the robot says and does, in a bubble beside it for as long as it lasts.

import { el } from "./dom.js";
import { said } from "./wordings.js";
import { plain } from "./words.js";

const EDGE_PX = 4;
const TAIL_PX = 12;

export class Bubble {
  constructor() {
    this.element = el("div", { class: "bubble", hidden: true, "aria-live": "polite" });
  }

  /** Tell what is done now: acts as in the account of the run, the same ones without drawing them again. */
  tell(acts) {
    this.element.hidden = acts.length === 0;
    const shown = acts.map((act) => `${act.act} ${act.start_s}`).join("|");
    if (shown !== this.shown) this.element.replaceChildren(...acts.flatMap(told).filter(Boolean));
    this.shown = shown;
  }

  /**
   * Stand above or below a body, inside the frame.
   *
   * @param {number} x of the body's middle [px]
   * @param {number} y of the body's middle [px]
   * @param {number} radius of the body [px]
   * @param {number} width of the frame [px]
   * @param {boolean} below on which side
   */
  place(x, y, radius, width, below) {
    const half = this.element.offsetWidth / 2 + EDGE_PX;
    const inside = Math.min(Math.max(x, half), width - half);
    const top = below ? y + radius : Math.max(y - radius, this.element.offsetHeight + TAIL_PX);
    this.element.classList.toggle("below", below);
    this.element.style.left = `${inside}px`;
    this.element.style.top = `${top}px`;
    this.element.style.setProperty("--tail", `${x - inside}px`);
  }
}

function told(act) {
  if (act.text !== null) return said(act);
  return el("p", { class: "gesture" }, el("span", { "aria-hidden": "true" }, "✦"), plain(act.act));
}
