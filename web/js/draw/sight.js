// sight.js -- how far one sees from a point of the scene before a surface is in the way.

import { add, scale, subtract } from "../geometry.js";

const kMostTriangles = 50_000;  // Larger meshes are looked through: testing them would slow the picture.

/** Part of the way from one point to another [m, world] up to the first surface after the part `least`; 1 where there is none. */
export function clearPart(objects, from, to, least, most = kMostTriangles) {
  let part = 1;
  for (const object of objects) {
    const count = object.triangles.length / 3;
    if (count === 0 || count > most) continue;
    const [start, end] = [from, to].map((point) => intoObject(object.matrix, point));
    if (meetsBox(boxOf(object.vertices), start, end)) part = Math.min(part, firstHit(object, start, subtract(end, start), least));
  }
  return part;
}

// A point of the world in the frame of an object, whose matrix turns and shifts.
function intoObject(m, point) {
  const d = subtract(point, [m[12], m[13], m[14]]);
  return [0, 4, 8].map((column) => m[column] * d[0] + m[column + 1] * d[1] + m[column + 2] * d[2]);
}

const boxes = new WeakMap();  // of vertices, as [least, most]

function boxOf(vertices) {
  if (!boxes.has(vertices)) {
    const [least, most] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    for (let i = 0; i < vertices.length; ++i) {
      least[i % 3] = Math.min(least[i % 3], vertices[i]);
      most[i % 3] = Math.max(most[i % 3], vertices[i]);
    }
    boxes.set(vertices, [least, most]);
  }
  return boxes.get(vertices);
}

function meetsBox([least, most], start, end) {
  return [0, 1, 2].every((axis) => Math.min(start[axis], end[axis]) <= most[axis] && Math.max(start[axis], end[axis]) >= least[axis]);
}

// T. Moeller and B. Trumbore, Fast, minimum storage ray/triangle intersection (1997), for both sides of each triangle.
// Written out by coordinates: vectors of their own would cost ten times as much.
function firstHit({ vertices: v, triangles }, [ox, oy, oz], [dx, dy, dz], least) {
  let first = 1;
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [3 * triangles[i], 3 * triangles[i + 1], 3 * triangles[i + 2]];
    const [bx, by, bz] = [v[b] - v[a], v[b + 1] - v[a + 1], v[b + 2] - v[a + 2]];
    const [cx, cy, cz] = [v[c] - v[a], v[c + 1] - v[a + 1], v[c + 2] - v[a + 2]];
    const [px, py, pz] = [dy * cz - dz * cy, dz * cx - dx * cz, dx * cy - dy * cx];
    const size = bx * px + by * py + bz * pz;
    if (size === 0) continue;
    const [sx, sy, sz] = [ox - v[a], oy - v[a + 1], oz - v[a + 2]];
    const u = (sx * px + sy * py + sz * pz) / size;
    if (u < 0 || u > 1) continue;
    const [qx, qy, qz] = [sy * bz - sz * by, sz * bx - sx * bz, sx * by - sy * bx];
    const w = (dx * qx + dy * qy + dz * qz) / size;
    if (w < 0 || u + w > 1) continue;
    const part = (cx * qx + cy * qy + cz * qz) / size;
    if (part > least && part < first) first = part;
  }
  return first;
}

const kDeepest = 2000;  // [m]

/** Height of a point [m, world] above the first surface below it; null above none. */
export function heightAbove(objects, [x, y, z]) {
  const part = clearPart(objects, [x, y, z], [x, y, z - kDeepest], 0, Infinity);
  return part === 1 ? null : part * kDeepest;
}

const kTouch = 0.6;  // What is nearer than that touches the vehicle, and is looked over [m].

/** A point on the way from `from` to `to`, before the first surface by a tenth of the way to it, but not nearer than `least` [m]. */
export function clearPoint(objects, from, to, least) {
  const way = subtract(to, from);
  const length = Math.hypot(...way);
  const part = clearPart(objects, from, to, kTouch / length);
  if (part === 1) return to;
  return add(from, scale(way, Math.min(1, Math.max(0.9 * part, least / length))));
}
