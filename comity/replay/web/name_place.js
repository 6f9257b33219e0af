// Where a person's name stands: behind the person, within the ring of the wanted distance or beyond it, never across it.

const NEAR_PX = { above: 9, below: 19 }; // from the body to the line that the letters stand on
const FAR_PX = { above: 6, below: 15 }; // from the ring
const LETTERS_PX = 12;
const AIR_PX = 3;

/**
 * The height of the letters' line over or under the person's middle, downwards [units of the drawing].
 *
 * @param {boolean} above whether the name stands above the person
 * @param {number} half half the length of the name
 * @param {number} body the radius of the person
 * @param {number} ring the radius of the ring
 * @param {number} px how large a pixel of the screen is
 * @param {number} room how much there is from the person's middle to the wall; where it is too little the name stays near
 */
export function nameLine({ above, half, body, ring, px, room }) {
  const side = above ? "above" : "below";
  const farthest = body + (above ? NEAR_PX.above + LETTERS_PX : NEAR_PX.below + AIR_PX) * px;
  const within = Math.hypot(farthest, half + AIR_PX * px) < ring;
  const beyond = ring + (FAR_PX[side] + (above ? LETTERS_PX : AIR_PX)) * px < room;
  const line = within || !beyond ? body + NEAR_PX[side] * px : ring + FAR_PX[side] * px;
  return above ? -line : line;
}
