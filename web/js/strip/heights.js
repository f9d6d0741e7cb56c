// heights.js -- colours of the heights in a swath: which heights the first and the last stand for.

const kFew = 6000;   // heights that a span is taken from
const kOuter = 0.06;  // share of the beams at either edge that it is not taken from: they are the least certain

const isInner = (beam, beams) => beam >= kOuter * beams && beam < (1 - kOuter) * beams;

/** Heights of the first and the last colour of rows: all but the outer beams and the outer hundredths, rounded outwards [m]. */
export function spanOf(rows) {
  const step = Math.max(1, Math.ceil((rows.length * (rows[0]?.values.length ?? 0)) / kFew));
  const heights = rows.flatMap(({ values }, i) => [...values].filter((value, beam) => isInner(beam, values.length) && (beam + i) % step === 0 && Number.isFinite(value))).sort((a, b) => a - b);
  if (heights.length === 0) return [-1, 0];
  const [low, high] = [heights[Math.floor(0.01 * heights.length)], heights[Math.floor(0.99 * (heights.length - 1))]];
  const least = Math.max(high - low, 0.2);
  const middle = (low + high) / 2;
  return [Math.floor(10 * (middle - least / 2)) / 10, Math.ceil(10 * (middle + least / 2)) / 10];
}

/** Height of the sea's surface [m]; null without one. */
export function surfaceOf(store) {
  const keys = store.get("hello")?.keys;
  const level = keys?.surface?.value ? keys["surface.level"]?.value : undefined;
  return Number.isFinite(level) ? level : null;
}
