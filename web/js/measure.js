// measure.js -- points of the picture in the world and back, what the ruler reads, and markers as files.

import { degrees, dot, rotate, sonarPoint, subtract, toWorld } from "./geometry.js";
import { number } from "./format.js";
import { headingOf } from "./pose.js";

const kSteps = 40;  // of the bisection below

/** Point of the world [m] at a range and an azimuth of a ping: at its elevation where that is known, else on the ground within
 * the sonar's aperture, else in the middle of the aperture. `ground` is the height of the ground [m], or null. */
export function worldPoint(sonar, pose, { range, azimuth }, elevation, ground) {
  const at = (angle) => toWorld(pose, sonarPoint(range, azimuth, angle));
  if (Number.isFinite(elevation)) return at(elevation);
  let [low, high] = [-0.5, 0.5].map((part) => sonar.elevationCentre + part * sonar.elevationAperture);
  const above = (angle) => at(angle)[2] - ground;
  if (!Number.isFinite(ground ?? NaN) || above(low) * above(high) > 0) return at(sonar.elevationCentre);
  for (let i = 0; i < kSteps; ++i) {
    const middle = (low + high) / 2;
    if (above(low) * above(middle) <= 0) high = middle;
    else low = middle;
  }
  return at(low);
}

/** { range [m], azimuth [rad] } of a point of the world in the frame of a pose, whatever its elevation. */
export function seenAt(pose, point) {
  const [w, x, y, z] = pose.orientation;
  const [ahead, port, up] = rotate([w, -x, -y, -z], subtract(point, pose.position));
  return { range: Math.hypot(ahead, port, up), azimuth: Math.atan2(port, ahead) };
}

const kShadowWidth = 3;  // degrees between the ends of what may be a shadow

/** What a ruler between two points of a picture reads: { length [m], heading [degrees], rise, drop }. Of a sonar that looks `down`,
 * `drop` is how much lower the second point is [m], else null; `rise` is the height of what throws a shadow from the nearer to the farther end, on flat ground `altitude` [m] below the sonar: its top lies on the way
 * from the sonar to the shadow's end, so h = H (1 - r1 / r2) (P. Blondel, The Handbook of Sidescan Sonar, 2009). Null without an
 * altitude, or where the ends lie in other directions. */
export function rulerFigures(pose, from, to, altitude, down = false) {
  const way = subtract(to, from);
  const [a, b] = [seenAt(pose, from), seenAt(pose, to)];
  const [near, far] = [a.range, b.range].sort((x, y) => x - y);
  const aligned = Math.abs(degrees(a.azimuth - b.azimuth)) <= kShadowWidth;
  return {
    length: Math.sqrt(dot(way, way)),
    heading: headingOf(Math.atan2(way[1], way[0])),
    drop: down ? from[2] - to[2] : null,
    rise: !down && aligned && altitude > 0 && far > 0 ? altitude * (1 - near / far) : null,
  };
}

export function rulerText({ length, heading, rise, drop = null, across = null, along = null, ground = false }) {
  const parts = [`${number(length, 2)} m`, `heading ${String(Math.round(heading) % 360).padStart(3, "0")}°`];
  if (across !== null) parts.push(`across ${number(across, 2)} m (${ground ? "ground" : "slant"})`);
  if (along !== null) parts.push(`along ${number(along, 2)} m`);
  if (drop !== null) parts.push(drop < 0 ? `${number(-drop, 2)} m higher` : `${number(drop, 2)} m lower`);
  if (rise !== null) parts.push(`height by shadow ${number(rise, 2)} m`);
  return parts.join("   ");
}

/** The first of M1, M2 ... that no marker has. */
export function freeName(markers) {
  const names = new Set(markers.map(({ name }) => name));
  for (let i = 1; ; ++i) if (!names.has(`M${i}`)) return `M${i}`;
}

const quoted = (text) => (/[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

/** Markers as a table (RFC 4180): world metres, seconds of the scenario, slant range on the ping, side of a side-scan sonar. */
export const csvOf = (markers) =>
  ["name,x,y,z,time,sonar,ping,range,side", ...markers.map(({ name, position, time, sonar, ping, range, side }) => [quoted(name), ...position.map((x) => x.toFixed(3)), time.toFixed(3), quoted(sonar), ping, range?.toFixed(3) ?? "", side ?? ""].join(","))].map((line) => `${line}\r\n`).join("");

/** Markers as GeoJSON features, whose coordinates are metres in the world. */
export const geoJsonOf = (markers) => JSON.stringify({
  type: "FeatureCollection",
  note: "metres in the world: x, y, z up; not longitude and latitude",
  features: markers.map(({ position, ...properties }) => ({ type: "Feature", geometry: { type: "Point", coordinates: position }, properties })),
});
