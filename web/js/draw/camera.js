// camera.js -- where the 3-D view is seen from: behind the vehicle, around a point, or from above.

import { add, cross, lookAt, multiply, perspective, radians, rollPitchYaw, rotate, scale, subtract, unit } from "../geometry.js";
import { clearPoint } from "./sight.js";

const kUp = [0, 0, 1];
const kFieldOfView = radians(48);

const kStarts = {
  chase: { yaw: 0, pitch: radians(24), distance: 0.36 },  // distances in parts of the sonar's range
  orbit: { yaw: radians(35), pitch: radians(32), distance: 1.1 },
  top: { yaw: 0, pitch: radians(89.5), distance: 1.25 },
};
// Camera of a scanning head, which looks to all sides.
const kAround = { yaw: 0, pitch: radians(42), distance: 0.75 };
const kNearest = 1.5;  // distance from the vehicle at which the camera stays, even behind a wall [m]

export class Camera {
  constructor() {
    this.reach = 30;
    this.around = false;  // whether the sonar looks to all sides
    this.objects = [];    // of the scene
    this.start("chase", null);
  }

  /** Begins a mode: chase and top follow the vehicle, orbit stays where the vehicle looks at now. */
  start(mode, vehicle) {
    this.mode = mode;
    const { yaw, pitch, distance } = mode === "chase" && this.around ? kAround : kStarts[mode];
    Object.assign(this, { yaw, pitch, distance: distance * this.reach, shift: [0, 0, 0] });
    this.target = vehicle ? this.#ahead(vehicle) : [0, 0, 0];
    if (mode === "orbit" && vehicle) this.yaw += headingOf(vehicle);
  }

  #ahead(vehicle) {
    const part = this.around ? 0.15 : { chase: 0.14, orbit: 0.35, top: 0.4 }[this.mode];
    const heading = headingOf(vehicle);
    return add(vehicle.position, scale([Math.cos(heading), Math.sin(heading), 0], part * this.reach));
  }

  turn(dx, dy) {
    this.yaw -= dx * 0.008;
    this.pitch = Math.max(-1.5, Math.min(1.56, this.pitch + dy * 0.008));
  }

  /** Moves the target in the picture's plane. */
  pan(dx, dy) {
    const perPixel = (this.distance * 0.9) / 500;
    const back = unit(subtract(this.eye, this.centre));
    const right = unit(cross(kUp, back));
    this.shift = add(this.shift, add(scale(right, -dx * perPixel), scale(cross(back, right), dy * perPixel)));
  }

  zoom(factor) {
    this.distance = Math.max(0.3, Math.min(20 * this.reach, this.distance / factor));
  }

  /** Prepares matrices for a picture of this shape. */
  place(vehicle, aspect) {
    const follows = this.mode !== "orbit" && vehicle;
    if (follows) this.target = this.#ahead(vehicle);
    const yaw = this.yaw + (follows ? headingOf(vehicle) : 0);
    this.centre = add(this.target, this.shift);
    const back = [-Math.cos(this.pitch) * Math.cos(yaw), -Math.cos(this.pitch) * Math.sin(yaw), Math.sin(this.pitch)];
    this.eye = add(this.centre, scale(back, this.distance));
    // Behind the vehicle it comes closer where a wall would be between them.
    if (this.mode === "chase" && vehicle) this.eye = clearPoint(this.objects, vehicle.position, this.eye, kNearest);
    const far = this.distance + 6 * this.reach;
    this.view = lookAt(this.eye, this.centre, kUp);
    this.projection = perspective(kFieldOfView, aspect, Math.max(0.02, far / 5000), far);
    this.matrix = multiply(this.projection, this.view);
  }
}

/** Place of a point of the world on a picture of this size; null for one behind the camera or beside the picture. */
export function screenPlace({ matrix: m }, [x, y, z], width, height) {
  const [across, up, , depth] = [0, 1, 2, 3].map((row) => m[row] * x + m[4 + row] * y + m[8 + row] * z + m[12 + row]);
  if (!(depth > 0) || Math.abs(across) > depth || Math.abs(up) > depth) return null;
  return [(1 + across / depth) / 2 * width, (1 - up / depth) / 2 * height];
}

/** Yaw of a vehicle [rad], steady while it looks steeply up or down. */
function headingOf(vehicle) {
  const ahead = rotate(vehicle.orientation, [1, 0, 0]);
  return Math.hypot(ahead[0], ahead[1]) > 0.05 ? Math.atan2(ahead[1], ahead[0]) : rollPitchYaw(vehicle.orientation)[2];
}
