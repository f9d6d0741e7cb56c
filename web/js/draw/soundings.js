// soundings.js -- where the beams of a multibeam met the bottom, over its fan.

const kColours = [null, "rgb(90 200 255)", "rgb(110 255 120)"];  // by amplitude, by phase: as `insonify draw` has them

/** Draws the soundings of a ping, if it has some. */
export function drawSoundings(context, plan, { tables: { sounding_range: ranges, detection } }) {
  if (!ranges || plan.mode === "round") return;
  const size = plan.width < 420 ? 1.5 : 2.5;
  ranges.forEach((range, beam) => {
    if (!Number.isFinite(range)) return;
    const [x, y] = plan.place(range, plan.sonar.beamAzimuths[beam]);
    context.fillStyle = "rgb(0 10 16 / 80%)";
    context.fillRect(x - size / 2 - 0.75, y - size / 2 - 0.75, size + 1.5, size + 1.5);
    context.fillStyle = kColours[detection?.[beam]] ?? kColours[1];
    context.fillRect(x - size / 2, y - size / 2, size, size);
  });
}

/** How many soundings were found, and how. */
export function soundingsText({ detection }) {
  if (!detection) return null;
  const count = (how) => detection.reduce((sum, each) => sum + (each === how ? 1 : 0), 0);
  return `soundings: ${count(1)} by amplitude (blue), ${count(2)} by phase (green)`;
}
