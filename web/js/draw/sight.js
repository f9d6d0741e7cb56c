// sight.js -- how far one sees from a point of the scene before a surface is in the way.

import { add, cross, dot, scale, subtract } from "../geometry.js";

const kMostTriangles = 50_000;  // Larger meshes are looked through: testing them would slow the picture.

/** Part of the way from one point to another [m, world] up to the first surface after the part `least`; 1 where there is none. */
export function clearPart(objects, from, to, least) {
  let part = 1;
  for (const object of objects) {
    const count = object.triangles.length / 3;
    if (count === 0 || count > kMostTriangles) continue;
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
function firstHit({ vertices, triangles }, start, way, least) {
  let first = 1;
  const corner = (i) => vertices.subarray(3 * i, 3 * i + 3);
  for (let i = 0; i < triangles.length; i += 3) {
    const a = corner(triangles[i]);
    const ab = subtract(corner(triangles[i + 1]), a);
    const ac = subtract(corner(triangles[i + 2]), a);
    const across = cross(way, ac);
    const size = dot(ab, across);
    if (size === 0) continue;
    const off = subtract(start, a);
    const u = dot(off, across) / size;
    if (u < 0 || u > 1) continue;
    const along = cross(off, ab);
    const v = dot(way, along) / size;
    if (v < 0 || u + v > 1) continue;
    const part = dot(ac, along) / size;
    if (part > least && part < first) first = part;
  }
  return first;
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
