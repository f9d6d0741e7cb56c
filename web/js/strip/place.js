// place.js -- places of side-scan pings in the world: a level bed below the sonar, as mosaics take it.

import { add, dot, norm, rotate, scale, subtract } from "../geometry.js";

/** Level axes of a row: ahead and to port of the sonar. */
export function axesOf({ pose }) {
  const [x, y] = rotate(pose.orientation, [0, 1, 0]);
  const length = Math.hypot(x, y) || 1;
  const port = [x / length, y / length, 0];
  return { ahead: [port[1], -port[0], 0], port };
}

/** Ground range of a slant range where the bed's first return is at `bottom` [m]; 0 in the water column. */
export const groundRange = (range, bottom) => Math.sqrt(Math.max(0, range * range - (bottom ?? 0) ** 2));

/** Point of the bed [m] that a row has at a slant range to a side (0 port, 1 starboard); what is in the water column is below the sonar. */
export function bedPoint(row, side, range) {
  const { port } = axesOf(row);
  const down = range < (row.bottom ?? 0) ? range : row.altitude ?? 0;
  return add(add(row.pose.position, scale(port, (side === 0 ? 1 : -1) * groundRange(range, row.bottom))), [0, 0, -down]);
}

/** { ahead, port, range [m] } of a point of the world as a row's sonar has it, levelled. */
export function offsetsOf(row, point) {
  const way = subtract(point, row.pose.position);
  const axes = axesOf(row);
  const ahead = dot(way, axes.ahead);
  return { ahead, port: dot(way, axes.port), range: norm(subtract(way, scale(axes.ahead, ahead))) };
}

const kNear = 1e-3;  // [m]

/** Indices from `first` to `last` of the rows that have passed a point: where it comes from ahead of a row behind its successor, on
 * the same line. The nearer of both is returned. */
export function passesOf(history, first, last, point) {
  const found = [];
  let before = null;
  for (let i = Math.max(first, history.first); i <= last; ++i) {
    const row = history.row(i);
    if (!row) break;
    const { ahead } = offsetsOf(row, point);
    if (before !== null && !row.seam && before * ahead <= 0 && Math.abs(before - ahead) > kNear) {
      found.push(Math.abs(before) < Math.abs(ahead) ? i - 1 : i);
    }
    before = ahead;
  }
  return [...new Set(found)];
}

/** Height of what throws a shadow from the slant range `begin` of its foot to `end` [m], on a level bed whose first return is at
 * `bottom`, `altitude` below the sonar [m]: h = H (X - x) / X, height_from_shadow() of insonify/survey/shadow_height.h. Null where
 * that is none. */
export function heightByShadow(altitude, bottom, begin, end) {
  const [x, far] = [groundRange(begin, bottom), groundRange(end, bottom)];
  return altitude > 0 && x > 0 && far > x ? (altitude * (far - x)) / far : null;
}
