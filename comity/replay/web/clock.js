// The one time cursor: everything on the page shows the moment that it names.

const FRAME_S = 0.1; // a tab that was in the background does not leap ahead

export class Clock {
  /** @param {number} end when the episode ends [s] */
  constructor(end) {
    this.end = end;
    this.t = 0;
    this.speed = 1;
    this.playing = false;
    this.listeners = [];
  }

  /** Call a function now and whenever the time, the speed or playing changes. */
  follow(listener) {
    this.listeners.push(listener);
    listener(this);
  }

  tell() {
    for (const listener of this.listeners) listener(this);
  }

  seek(t) {
    this.t = Math.min(Math.max(t, 0), this.end);
    this.tell();
  }

  /** Stop playing and go to a time. */
  visit(t) {
    this.pause();
    this.seek(t);
  }

  toggle() {
    if (!this.playing && this.t >= this.end) this.t = 0;
    this.playing = !this.playing;
    this.tell();
    if (this.playing) this.run();
  }

  pause() {
    if (this.playing) this.toggle();
  }

  run() {
    let before = null;
    const frame = (now) => {
      if (!this.playing) return;
      const passed = before === null ? 0 : Math.min((now - before) / 1000, FRAME_S);
      before = now;
      this.t = Math.min(this.t + passed * this.speed, this.end);
      this.playing = this.t < this.end;
      this.tell();
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }
}

/** The time that an address names with `#t=12.30`; null where it names none. */
export function timeInAddress(address = location.href) {
  const found = /(?:^#|&)t=(\d+(?:\.\d+)?)/.exec(new URL(address).hash);
  return found ? Number(found[1]) : null;
}

/** Keep `#t=` in the address, a moment after the cursor came to rest, and follow an address that is typed. */
export function linkToAddress(clock) {
  let waiting = 0;
  const rested = () => {
    clearTimeout(waiting);
    if (!clock.playing) waiting = setTimeout(() => write(clock), 150);
  };
  clock.follow(rested);
  addEventListener("hashchange", ({ newURL }) => {
    const t = timeInAddress(newURL); // the address itself may have been written anew since
    if (t === null) rested(); // it names no time: the address says again which one is shown
    else if (t.toFixed(2) !== clock.t.toFixed(2)) clock.seek(t);
  });
}

function write(clock) {
  if (clock.t === 0 && !location.hash) return;
  history.replaceState(null, "", `#t=${clock.t.toFixed(2)}`);
}
