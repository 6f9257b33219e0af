// Where a person's name stands: behind the person, within the ring of the wanted distance or beyond it, never across it.

const NEAR_PX = { above: 9, below: 19 }; // from the body to the line that the letters stand on
const FAR_PX = { above: 6, below: 15 }; // from the ring
const LETTERS_PX = 12;
const LETTER_PX = 8; // width of a bold one
const AIR_PX = 3;
const LINE_PX = 15;

/** The space that a name takes on a line [units of the drawing]. */
export const nameBox = (x, line, half, px) => ({
  left: x - half - AIR_PX * px,
  right: x + half + AIR_PX * px,
  top: line - LETTERS_PX * px,
  bottom: line + AIR_PX * px,
});

/** The space that a short text takes around its middle, about [units of the drawing]. */
export const labelBox = (x, y, words, px) =>
  nameBox(x, y + (LETTERS_PX / 2) * px, (words.length * LETTER_PX * px) / 2, px);

/** Whether two boxes share a place. */
export const overlap = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

/**
 * Where the letters' line may be over or under the person's middle, downwards [units of the drawing], the best first.
 *
 * @param {object} about as for `nameLine`, with the room on both sides instead of `room`
 * @param {{over: number, under: number}} rooms how much there is from the person's middle to either wall
 */
export function nameLines(about, { over, under }) {
  const sides = [about.above, !about.above];
  const lines = sides.map((above) => nameLine({ ...about, above, room: above ? over : under }));
  const farther = sides.map((above, i) => lines[i] + (above ? -1 : 1) * LINE_PX * about.px);
  return [...lines, ...farther];
}

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
function nameLine({ above, half, body, ring, px, room }) {
  const side = above ? "above" : "below";
  const farthest = body + (above ? NEAR_PX.above + LETTERS_PX : NEAR_PX.below + AIR_PX) * px;
  const within = Math.hypot(farthest, half + AIR_PX * px) < ring;
  const beyond = ring + (FAR_PX[side] + (above ? LETTERS_PX : AIR_PX)) * px < room;
  const line = within || !beyond ? body + NEAR_PX[side] * px : ring + FAR_PX[side] * px;
  return above ? -line : line;
}
