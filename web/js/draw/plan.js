// plan.js -- where a range and an azimuth lie on the picture, and what lies under a point of it.
//
// The plane of fan and round picture has metres to starboard and metres ahead, of a vertical scanning head metres ahead and
// metres up, of a multibeam metres to starboard and metres up, so that its fan looks down; that of the polar picture beams and ranges.

import { wrapped } from "../geometry.js";
import { beamAt, binAt, slotAt } from "../sonar.js";

const kMargins = {
  fan: { top: 24, side: 8, bottom: 6 },
  polar: { top: 32, side: 54, bottom: 26 },
  round: { top: 32, side: 54, bottom: 26 },
};
const kSmall = { top: 26, side: 10, bottom: 10 };
// What lies over the lower corners of the large picture: figures on the left, colour bar on the right [CSS pixels].
const kCorners = { left: 330, right: 302, height: 104 };

const kStep = 8;  // by which a picture gives way [CSS pixels]
const kHome = { factor: 1, x: 0, y: 0 };

/** What the picture shows: mode, size on the screen in CSS pixels, and zoom = { factor, x, y }, x and y parts of the size. A
 * large picture that would reach into its lower corners, where figures stand, ends above them. */
export function makePlan(sonar, mode, width, height, zoom) {
  if (width < 420) return planWithin(sonar, mode, width, height, zoom, kSmall);
  const margin = kMargins[mode];
  // The edges of a wide fan are nearly level: their labels stand below them.
  const bottom = mode === "fan" && !sonar.down && Math.max(sonar.ports[0], -sonar.starboards.at(-1)) > 1.2 ? 26 : margin.bottom;
  const corners = [[kCorners.left, height - kCorners.height], [width - kCorners.right, height - 56]];
  if (sonar.down) corners.push(...corners.map(([x]) => [x, height]));  // Its arc is the lowest in the middle.
  const free = { ...margin, bottom };
  while (free.bottom < bottom + kCorners.height) {
    const whole = planWithin(sonar, mode, width, height, kHome, free);
    if (!corners.some(([x, y]) => whole.holds(x, y))) break;
    free.bottom += kStep;
  }
  return planWithin(sonar, mode, width, height, zoom, free);
}

function planWithin(sonar, mode, width, height, zoom, margin) {
  const bounds = boundsOf(sonar, mode);
  const free = { width: Math.max(10, width - 2 * margin.side), height: Math.max(10, height - margin.top - margin.bottom) };
  const span = { x: bounds.right - bounds.left, y: bounds.top - bounds.bottom };
  let perX = free.width / span.x;  // pixels a unit of the plane
  let perY = free.height / span.y;
  if (mode !== "polar") perX = perY = Math.min(perX, perY);
  perX *= zoom.factor;
  perY *= zoom.factor;
  const middle = { x: (bounds.left + bounds.right) / 2, y: (bounds.top + bounds.bottom) / 2 };
  const left = width / 2 + zoom.x * width;
  const top = margin.top + free.height / 2 + zoom.y * height;
  const plan = {
    sonar, mode, width, height, bounds,
    toScreen: (x, y) => [left + (x - middle.x) * perX, top - (y - middle.y) * perY],
    toPlane: (x, y) => [middle.x + (x - left) / perX, middle.y - (y - top) / perY],
    place: (range, azimuth) => plan.toScreen(...planePoint(sonar, mode, range, azimuth)),
    holds: (x, y) => underPoint(plan, x, y) !== null,
  };
  const [x0, y0] = plan.toPlane(0, height);
  const [x1, y1] = plan.toPlane(width, 0);
  plan.view = [(x0 + x1) / 2, (y0 + y1) / 2, (x1 - x0) / 2, (y1 - y0) / 2];
  return plan;
}

function boundsOf(sonar, mode) {
  const reach = sonar.max_range;
  if (mode === "round") return { left: -reach, right: reach, bottom: -reach, top: reach };
  if (mode === "polar") return { left: 0, right: sonar.beams, bottom: sonar.min_range, top: reach };
  const [port, starboard] = [sonar.ports[0], sonar.starboards.at(-1)];
  const across = (azimuth) => Math.sin(Math.min(Math.abs(azimuth), Math.PI / 2)) * Math.sign(azimuth);
  const widest = Math.max(Math.abs(across(port)), Math.abs(across(starboard)), 0.15);  // The apex stays in the middle.
  const back = Math.min(0, Math.cos(Math.max(Math.abs(port), Math.abs(starboard))));
  const [bottom, top] = sonar.down ? [-reach, -back * reach] : [back * reach, reach];
  return { left: -widest * reach, right: widest * reach, bottom, top };
}

function planePoint(sonar, mode, range, azimuth) {
  if (mode !== "polar") return [-range * Math.sin(azimuth - sonar.up), sonar.sign * range * Math.cos(azimuth - sonar.up)];
  const beam = beamAt(sonar, azimuth);
  if (beam < 0) return [sonar.ports.filter((port) => port > azimuth).length, range];  // Beside the fan, or in a gap.
  const [port, starboard] = [sonar.ports[beam], sonar.starboards[beam]];
  return [beam + (port - azimuth) / (port - starboard), range];
}

/** { range, azimuth, beam, bin } under a point of the screen, or null beside the picture. */
export function underPoint(plan, x, y) {
  const { sonar, mode } = plan;
  const [u, v] = plan.toPlane(x, y);
  if (mode === "polar") {
    const beam = Math.floor(u);
    const bin = binAt(sonar, v);
    if (beam < 0 || beam >= sonar.beams || bin < 0) return null;
    const azimuth = sonar.ports[beam] + (u - beam) * (sonar.starboards[beam] - sonar.ports[beam]);
    return { range: v, azimuth, beam, bin };
  }
  const range = Math.hypot(u, v);
  const azimuth = wrapped(Math.atan2(-u, sonar.sign * v) + sonar.up);
  const bin = binAt(sonar, range);
  const beam = mode === "round" ? 0 : beamAt(sonar, azimuth);
  if (bin < 0 || beam < 0) return null;
  return { range, azimuth, beam, bin, slot: mode === "round" ? slotAt(azimuth) : undefined };
}
