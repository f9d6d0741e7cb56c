// geometry.js -- poses, quaternions [w, x, y, z] and 4 x 4 matrices, column by column as WebGL has them.

export const radians = (degrees) => (degrees * Math.PI) / 180;
export const degrees = (angle) => (angle * 180) / Math.PI;

/** An angle within half a turn of 0 [rad]. */
export const wrapped = (angle) => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a, factor) => [a[0] * factor, a[1] * factor, a[2] * factor];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const norm = (a) => Math.hypot(...a);
export const unit = (a) => scale(a, 1 / (norm(a) || 1));

/** Turns a vector by a unit quaternion. */
export function rotate([w, x, y, z], v) {
  const t = scale(cross([x, y, z], v), 2);
  return add(add(v, scale(t, w)), cross([x, y, z], t));
}

export const toWorld = (pose, point) => add(pose.position, rotate(pose.orientation, point));

/** Point at a range, an azimuth (positive to port) and an elevation (positive up) in the sonar's frame [m, rad]. */
export function sonarPoint(range, azimuth, elevation = 0) {
  const flat = range * Math.cos(elevation);
  return [flat * Math.cos(azimuth), flat * Math.sin(azimuth), range * Math.sin(elevation)];
}

/** Roll, pitch and yaw about fixed axes [rad] from a unit quaternion. */
export function rollPitchYaw([w, x, y, z]) {
  return [
    Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
    Math.asin(Math.max(-1, Math.min(1, 2 * (w * y - z * x)))),
    Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
  ];
}

export function quaternionOf([roll, pitch, yaw]) {
  const [cr, cp, cy] = [roll, pitch, yaw].map((angle) => Math.cos(angle / 2));
  const [sr, sp, sy] = [roll, pitch, yaw].map((angle) => Math.sin(angle / 2));
  return [cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy];
}

/** Matrix of a pose, scaled. */
export function poseMatrix(pose, size = 1) {
  const columns = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => scale(rotate(pose.orientation, axis), size));
  return new Float32Array([...columns[0], 0, ...columns[1], 0, ...columns[2], 0, ...pose.position, 1]);
}

export function multiply(a, b) {
  const product = new Float32Array(16);
  for (let column = 0; column < 4; ++column) {
    for (let row = 0; row < 4; ++row) {
      for (let k = 0; k < 4; ++k) product[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    }
  }
  return product;
}

export function perspective(fieldOfView, aspect, near, far) {
  const f = 1 / Math.tan(fieldOfView / 2);
  return new Float32Array([f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0]);
}

export function lookAt(eye, target, up) {
  const back = unit(subtract(eye, target));
  const right = unit(cross(up, back));
  const top = cross(back, right);
  return new Float32Array([
    right[0], top[0], back[0], 0, right[1], top[1], back[1], 0, right[2], top[2], back[2], 0,
    -dot(right, eye), -dot(top, eye), -dot(back, eye), 1,
  ]);
}

/** A pose turned by an angle about its own z. */
export function turned({ position, orientation: [w, x, y, z] }, angle) {
  const [c, s] = [Math.cos(angle / 2), Math.sin(angle / 2)];
  return { position, orientation: [w * c - z * s, x * c + y * s, y * c - x * s, z * c + w * s] };
}
