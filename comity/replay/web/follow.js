// Following the time within a panel that scrolls: the page stays where it is, and so does the keyboard.

const PATIENCE_MS = 4000; // whoever has just scrolled a panel reads there

export class Follower {
  /**
   * @param {HTMLElement} box the panel's part that scrolls; what it holds is placed relative to it
   * @param {function(): number} covered how much of its top is covered by what stays there [px]
   */
  constructor(box, covered = () => 0) {
    Object.assign(this, { box, covered });
    this.touched = -Infinity;
    const touch = () => {
      this.touched = performance.now();
    };
    for (const kind of ["wheel", "touchmove", "pointerdown", "keydown"])
      box.addEventListener(kind, touch, { passive: true });
  }

  /** Bring an element into sight, once, and not under the reader's hands. */
  follow(element) {
    if (!element || element === this.followed) return;
    if (performance.now() - this.touched < PATIENCE_MS) return;
    this.followed = element;
    const { box } = this;
    const [top, bottom] = this.extent(element);
    if (top >= box.scrollTop + this.covered() && bottom <= box.scrollTop + box.clientHeight) return;
    const covered = this.covered(); // nothing peeks out from under what covers the top
    box.scrollTop = covered > 0 ? top - covered : (top + bottom - box.clientHeight) / 2;
  }

  /** Scroll just as far as it takes to see an element. */
  nudge(element) {
    const { box } = this;
    const [top, bottom] = this.extent(element);
    if (top < box.scrollTop + this.covered()) box.scrollTop = top - this.covered();
    else if (bottom > box.scrollTop + box.clientHeight) box.scrollTop = bottom - box.clientHeight;
  }

  extent(element) {
    const top = element.getBoundingClientRect().top - this.box.getBoundingClientRect().top + this.box.scrollTop;
    return [top, top + element.offsetHeight];
  }
}
