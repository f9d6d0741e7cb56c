// pose.js -- where a vehicle is and looks to, as an operator reads it: heading, depth, altitude.

import { number } from "./format.js";
import { degrees, rollPitchYaw } from "./geometry.js";

/** Compass heading of a yaw [rad], in a world with x east and y north [degrees, 0 to 360]. */
export const headingOf = (yaw) => (((90 - degrees(yaw)) % 360) + 360) % 360;

/** { heading, pitch, roll [degrees], z, depth, altitude [m] }: depth is null without a sea surface, altitude without `ground`,
 * the height of the first surface below [m]. */
export function poseFigures(vehicle, hello, ground) {
  const [roll, pitch, yaw] = rollPitchYaw(vehicle.orientation);
  const z = vehicle.position[2];
  const level = hello?.keys?.surface?.value ? hello.keys["surface.level"]?.value : undefined;
  return {
    heading: headingOf(yaw), pitch: degrees(pitch), roll: degrees(roll), z,
    depth: Number.isFinite(level) ? level - z : null,
    altitude: Number.isFinite(ground ?? NaN) ? z - ground : null,
  };
}

/** These figures as two texts: the attitude, and the place above and below. */
export function poseTexts({ heading, pitch, roll, z, depth, altitude }) {
  const angle = String(Math.round(heading) % 360).padStart(3, "0");
  const height = depth === null ? `z ${number(z, 1)} m` : `depth ${number(depth, 1)} m`;
  return [`heading ${angle}°   pitch ${number(pitch)}°   roll ${number(roll)}°`, altitude === null ? height : `${height}   altitude ${number(altitude, 1)} m`];
}
