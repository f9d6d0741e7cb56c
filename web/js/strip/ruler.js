// ruler.js -- what the ruler reads between two rows of a waterfall: across, along by the poses of the pings, and heights by shadows.

import { dot, subtract } from "../geometry.js";
import { levelDb } from "../link/decode.js";
import { rulerFigures, rulerText } from "../measure.js";
import { binAt } from "../sonar.js";
import { axesOf, groundRange, heightByShadow } from "./place.js";

const kAcross = 0.1;     // A ruler that goes along by a greater part of what it goes across spans no shadow.
const kShadowDb = 6;     // A shadow is darker than what lies behind it by that much.
const kMostRows = 32;    // rows whose levels are averaged

// Mean intensity of bins [from, to) of a beam over rows; null without a bin.
function meanOf(rows, beam, from, to) {
  let [sum, count] = [0, 0];
  for (const { tables, beams, bins } of rows) {
    for (let bin = Math.max(0, from); bin < Math.min(bins, to); ++bin, ++count) {
      const level = levelDb(tables.level[bin * beams + beam]);
      sum += level === null ? 0 : 10 ** (level / 10);
    }
  }
  return count > 0 ? sum / count : null;
}

/** Whether it is dark between two slant ranges of a side, and bright behind. */
export function spansShadow(sonar, rows, beam, near, far) {
  const [first, last] = [binAt(sonar, near), binAt(sonar, far)];
  if (first < 0 || last - first < 2) return false;
  const [inside, behind] = [meanOf(rows, beam, first + 1, last), meanOf(rows, beam, last + 1, 2 * last - first + 1)];
  return inside !== null && behind > 0 && inside < behind * 10 ** (-kShadowDb / 10);
}

/** Figures of a ruler between two marks of a side-scan waterfall: those of rulerFigures() with `across` and `along` [m]. `rise` is there where
 * the ruler spans a shadow. */
export function sideFigures({ sonar, corrected }, history, from, to) {
  const indices = [from, to].map(({ number, time }) => history.find(number, time));
  const rows = indices.map((index) => history.row(index));
  if (!rows[0] || !rows[1]) return null;
  const signed = ({ beam, range }, row) => (beam === 0 ? -1 : 1) * (corrected ? groundRange(range, row.bottom) : range);
  const across = Math.abs(signed(from, rows[0]) - signed(to, rows[1]));
  const along = Math.abs(dot(subtract(rows[1].pose.position, rows[0].pose.position), axesOf(rows[0]).ahead));
  const [first, last] = [...indices].sort((a, b) => a - b);
  const between = Array.from({ length: Math.min(kMostRows, last - first + 1) }, (_, i) => history.row(first + i));
  const [near, far] = [from.range, to.range].sort((a, b) => a - b);
  const isShadow = from.beam === to.beam && along <= kAcross * across && spansShadow(sonar, between, from.beam, near, far);
  const { altitude, bottom } = rows[0];
  return { ...rulerFigures(rows[0].pose, from.point, to.point, NaN), across, along, ground: corrected, rise: isShadow ? heightByShadow(altitude ?? 0, bottom ?? 0, near, far) : null };
}

/** What a ruler reads in a waterfall. */
export function stripRulerText(shown, history, { from, to }) {
  const { sonar } = shown;
  const figures = sonar.product.sides ? sideFigures(shown, history, from, to) : null;
  const pose = history.row(history.find(from.number, from.time))?.pose ?? history.newest.pose;
  return rulerText(figures ?? rulerFigures(pose, from.point, to.point, NaN, sonar.down));
}
