// Where everybody was: unpacked from steps, with straight lines between two frames.

export class Track {
  constructor({ count, t, bodies }) {
    this.t = unpacked(t, count, 1000);
    this.bodies = new Map(
      bodies.map(({ name, radius, x, y, heading }) => [
        name,
        {
          name,
          radius,
          x: unpacked(x, count, 1000),
          y: unpacked(y, count, 1000),
          heading: unpacked(heading, count, 1000),
        },
      ]),
    );
  }

  /** Where a body is at a time: x, y [m], heading [rad], and its radius [m]. */
  pose(name, t) {
    const body = this.bodies.get(name);
    const [i, share] = this.between(t);
    const turn = body.heading[i + 1] - body.heading[i];
    return {
      x: body.x[i] + share * (body.x[i + 1] - body.x[i]),
      y: body.y[i] + share * (body.y[i + 1] - body.y[i]),
      heading: body.heading[i] + share * (turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI))),
      radius: body.radius,
    };
  }

  /** The frame before a time, and how far the next one is on its way. */
  between(t) {
    let low = 0;
    let high = Math.max(this.t.length - 2, 0);
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.t[middle] <= t) low = middle;
      else high = middle - 1;
    }
    const length = this.t[low + 1] - this.t[low];
    return [low, length > 0 ? Math.min(Math.max((t - this.t[low]) / length, 0), 1) : 0];
  }

  /** Speed of a body [m/s], over a few frames: places are kept to a millimetre. */
  speeds(name) {
    const { x, y } = this.bodies.get(name);
    return Array.from(this.t, (_, i) => {
      const [a, b] = [Math.max(i - 2, 0), Math.min(i + 2, this.t.length - 1)];
      const length = this.t[b] - this.t[a];
      return length > 0 ? Math.hypot(x[b] - x[a], y[b] - y[a]) / length : 0;
    });
  }
}

function unpacked(steps, count, perUnit) {
  const values = new Float64Array(Math.max(count, 2));
  let sum = 0;
  for (let i = 0; i < values.length; i++) {
    sum += steps[i] ?? 0;
    values[i] = sum / perUnit;
  }
  return values;
}
