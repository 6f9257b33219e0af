// Where a person's name stands: behind the person, within the ring of the wanted distance or beyond it, never across it;
// and where the length of a line stands: beside the line.

const NEAR_PX = { above: 9, below: 19 }; // from the body to the line that the letters stand on
const FAR_PX = { above: 6, below: 15 }; // from the ring
const LETTERS_PX = 12;
const LETTER_PX = 8; // width of a bold one
const AIR_PX = 3;
const LINE_PX = 15;
const ASIDE_PX = { across: 22, down: 13 }; // from an upright and from a level line to the middle of its length
const FARTHER = [1, 1.6, 2.2]; // times as far aside from the line, where that is taken
const SHARES = [0.5, 0.35, 0.65, 0.2, 0.8]; // of the line

/** The space that a name takes on a line [units of the drawing]. */
export const nameBox = (x, line, half, px) => ({
  left: x - half - AIR_PX * px,
  right: x + half + AIR_PX * px,
  top: line - LETTERS_PX * px,
  bottom: line + AIR_PX * px,
});

/** The space that a short text takes around its middle, about [units of the drawing]. */
export const labelBox = (x, y, words, px) =>
  nameBox(x, y + ((LETTERS_PX - AIR_PX) / 2) * px, (words.length * LETTER_PX * px) / 2, px);

/** Where the middle of a line's length may be, the best first: the nearest to the line, and above it. */
export function labelPlaces([x1, y1], [x2, y2], px) {
  const length = Math.hypot(x2 - x1, y2 - y1) || 1;
  const upwards = x2 < x1 ? -1 : 1;
  const across = (upwards * (y2 - y1) * ASIDE_PX.across * px) / length;
  const down = (upwards * (x1 - x2) * ASIDE_PX.down * px) / length;
  const asides = FARTHER.flatMap((far) => SHARES.flatMap((share) => [1, -1].map((side) => [share, side * far])));
  return asides.map(([share, far]) => [x1 + share * (x2 - x1) + far * across, y1 + share * (y2 - y1) + far * down]);
}

/** Whether two boxes share a place. */
export const overlap = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

/** How much of a place two boxes share. */
const shared = (a, b) =>
  overlap(a, b)
    ? (Math.min(a.right, b.right) - Math.max(a.left, b.left)) * (Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top))
    : 0;

/**
 * The place whose box is on the drawing, covers no name and least of the bodies; the first of equals, if there is any.
 *
 * @param {{box: object}[]} places the best first
 * @param {{names: object[], bodies: object[]}} taken boxes that are there already
 * @param {{width: number, height: number}} drawing
 */
export function leastCovering(places, { names, bodies }, { width, height }) {
  const covered = ({ box }) => bodies.reduce((sum, body) => sum + shared(box, body), 0);
  return places
    .filter(({ box }) => box.left >= 0 && box.top >= 0 && box.right <= width && box.bottom <= height)
    .filter(({ box }) => !names.some((name) => overlap(box, name)))
    .reduce((best, place) => (best && covered(best) <= covered(place) ? best : place), undefined);
}

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
