// format.js -- numbers as an operator reads them.

const kMinus = "\u2212";

/** A number with `digits` decimals and a true minus sign. */
export function number(value, digits = 0) {
  if (!Number.isFinite(value)) return "–";
  const text = Math.abs(value).toFixed(digits);
  return value < 0 && Number(text) !== 0 ? kMinus + text : text;
}

/** Metres, with as many decimals as a bin is worth. */
export const metres = (value, binLength = 0.1) => `${number(value, binLength < 0.02 ? 3 : 2)} m`;

export const decibels = (value) => `${number(value, 1)} dB`;

/** A bearing from an azimuth, which is positive to port [rad], with P or S for its side; a turned head's azimuth may exceed half a turn. That of a
 * `vertical` head is positive up, and its bearing the slope: "60.0° down". */
export function bearing(azimuth, vertical = false) {
  const turn = (-azimuth * 180) / Math.PI;
  const degrees = turn - 360 * Math.round(turn / 360);
  if (vertical) return slope(-degrees, 1);
  const text = `${Math.abs(degrees).toFixed(1)}°`;
  if (Number(Math.abs(degrees).toFixed(1)) === 0) return text;
  return `${text} ${degrees > 0 ? "S" : "P"}`;
}

/** An angle above the front of a vertical head's housing, within half a turn [degrees], as the angle from the horizontal. */
export function slope(angle, digits) {
  const steep = Number(Math.min(Math.abs(angle), 180 - Math.abs(angle)).toFixed(digits));
  const back = Math.abs(angle) > 90;
  if (steep === 0) return back ? "back" : "front";
  if (steep === 90) return angle > 0 ? "up" : "down";
  return `${steep.toFixed(digits)}° ${angle > 0 ? "up" : "down"}${back ? ", back" : ""}`;
}

export const triple = (point, digits = 2) => point.map((value) => number(value, digits)).join(", ");

/** Spacing of the range rings [m]. */
export function ringSpacing(range) {
  if (range <= 2) return 0.5;
  if (range <= 5) return 1;
  if (range <= 10) return 2;
  if (range <= 25) return 5;
  if (range <= 60) return 10;
  if (range <= 120) return 20;
  return niceStep(range / 5);
}

/** The next of 1, 2, 5, 10, 20 ... that is at least `step`. */
export function niceStep(step) {
  const power = 10 ** Math.floor(Math.log10(step));
  const part = step / power;
  return power * (part <= 1 ? 1 : part <= 2 ? 2 : part <= 5 ? 5 : 10);
}

/** Multiples of `step` within [low, high]. */
export function ticks(low, high, step) {
  const found = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; ++i) found.push(i * step);
  return found;
}

/** A time as 1:02.3 from the start. */
export function clock(seconds) {
  const minutes = Math.floor(seconds / 60);
  return `${minutes}:${(seconds - 60 * minutes).toFixed(1).padStart(4, "0")}`;
}
