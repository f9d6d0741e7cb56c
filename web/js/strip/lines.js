// lines.js -- what lies over the rows of a waterfall: scale, ages, first return, seams, markers, ruler and cursor.

import { themeColour } from "../dom.js";
import { drawCross } from "../draw/graticule.js";
import { drawMarks } from "../draw/marks.js";
import { number } from "../format.js";

const kFont = "11px system-ui, sans-serif";
const kBottom = "rgb(110 210 255)";  // line of the first return
const kGap = 6;                      // between labels of the scale [pixels]

/** Draws all lines. `view` = { plan, history, sonar, kind, first, last: rows in view, corrected, ... }. */
export function drawStripLines(context, view) {
  const { plan, sonar, corrected } = view;
  context.font = kFont;
  context.lineWidth = 1;
  drawScale(context, view);
  context.save();
  context.beginPath();
  context.rect(plan.left, plan.top, plan.width, plan.height);
  context.clip();
  drawSeams(context, view);
  if (view.bottomLine && sonar.product.sides && !corrected) drawBottom(context, view);
  drawAges(context, view);
  drawMarks(context, plan.left + plan.width, (mark) => placesOf(view, mark), view);
  const { cursor } = view;
  if (cursor?.row) drawCross(context, placeOf(view, cursor.index, cursor.row, cursor));
  context.restore();
  if (view.back) drawBar(context, view);
}

function placeOf({ plan, kind, sonar, corrected }, index, row, place) {
  return [plan.xOf(kind.share(sonar, row, place, { corrected })), plan.yOf(index)];
}

// Places of a mark: in the row of its ping, or where the sonar has passed it.
function placesOf(view, mark) {
  const { history, kind, sonar, first, last } = view;
  const of = (index, place) => placeOf(view, index, history.row(index), place);
  const number = mark.number ?? mark.ping;
  const own = mark.sonar === sonar.name ? history.find(number, mark.time) : -1;
  if (own >= 0) {
    const place = kind.seen(sonar, history.row(own), mark.point) ?? (mark.range === undefined ? null : { range: mark.range });
    return place ? [of(own, place)].filter(([x]) => Number.isFinite(x)) : [];
  }
  return kind.passes(history, first, last, mark.point).flatMap((index) => {
    const place = kind.seen(sonar, history.row(index), mark.point);
    return place ? [of(index, place)] : [];
  }).filter(([x]) => Number.isFinite(x));
}

// Text on a plate: an outline would smear small figures over a picture.
function write(context, words, x, y) {
  const wide = context.measureText(words).width + 6;
  const left = context.textAlign === "center" ? x - wide / 2 : x - 3;
  context.globalAlpha = 0.78;
  context.fillStyle = themeColour("--panel");
  context.fillRect(left, y - 13, wide, 14);
  context.globalAlpha = 1;
  context.fillStyle = themeColour("--text");
  context.fillText(words, x, y);
}

// Lines at round ranges, or between beams, and their labels below.
function drawScale(context, { plan, history, kind, sonar, last, grid, scale }) {
  const { left, top, width, bottom } = plan;
  context.textBaseline = "bottom";
  context.textAlign = "center";
  const rows = Math.min(bottom, top + (last - history.first + 1) * plan.pixels);
  const written = [];
  for (const { share, text } of kind.ticks(sonar, width)) {
    const x = plan.xOf(share);
    if (grid || kind.heights) {
      // Over the rows as over a picture, below them as on the page.
      context.fillStyle = themeColour("--ring");
      if (grid) context.fillRect(x, top, 1, rows - top);
      context.fillStyle = themeColour("--line");
      context.fillRect(x, grid ? rows : bottom - 4, 1, grid ? bottom - rows : 4);
    }
    const half = context.measureText(text).width / 2 + kGap;
    const place = Math.max(left + half, Math.min(left + width - half, x));
    // A label that would be cut stands at the edge; one that would lie on another is left out.
    if (Math.abs(place - x) > half || written.some(([from, to]) => place - half < to && place + half > from)) continue;
    written.push([place - half, place + half]);
    write(context, text, place, bottom + scale - 2);
  }
}

// Ages of rows, and how far the sonar has come since.
function drawAges(context, { plan, history, first, last, isSmall }) {
  context.textAlign = "left";
  context.textBaseline = "bottom";
  const newest = history.newest;
  if (!newest) return;
  for (const part of [0.25, 0.5, 0.75]) {
    const row = history.row(last - Math.floor(part * (last - first)));
    if (!row || row === newest) continue;
    const age = newest.age - row.age;
    const way = newest.way - row.way;
    const text = `${number(-age, age < 10 ? 1 : 0)} s${!isSmall && way > 0.1 ? `   ${number(way, way < 10 ? 1 : 0)} m` : ""}`;
    write(context, text, plan.left + 4, plan.top + part * plan.height + 4);
  }
}

// Between a row and one that does not follow it, another line begins.
function drawSeams(context, { plan, history, first, last }) {
  context.fillStyle = themeColour("--warn");
  for (let i = Math.max(first, history.first + 1); i <= last; ++i) {
    if (history.row(i)?.seam) context.fillRect(plan.left, plan.yOf(i) + plan.pixels / 2 - 0.5, plan.width, 1);
  }
}

function drawBottom(context, { plan, history, kind, sonar, first, last, corrected }) {
  context.strokeStyle = kBottom;
  context.lineWidth = 1.4;
  for (const beam of [0, 1]) {
    context.beginPath();
    let isDown = false;
    for (let i = last; i >= Math.max(first, history.first); --i) {
      const row = history.row(i);
      if (row?.tracked && row.bottom > 0) {
        const x = plan.xOf(kind.share(sonar, row, { beam, range: row.bottom }, { corrected }));
        if (isDown) context.lineTo(x, plan.yOf(i));
        else context.moveTo(x, plan.yOf(i));
      }
      isDown = Boolean(row?.tracked) && !row.seam;
    }
    context.stroke();
  }
  context.lineWidth = 1;
}

// Which part of the rows that are kept is in view.
function drawBar(context, { plan, history, first, last }) {
  const kept = history.count - history.first;
  const y = (index) => plan.top + ((history.count - 1 - index) / kept) * plan.height;
  context.fillStyle = themeColour("--line");
  context.fillRect(plan.left + plan.width - 5, plan.top, 5, plan.height);
  context.fillStyle = themeColour("--accent");
  context.fillRect(plan.left + plan.width - 5, y(last), 5, Math.max(8, y(Math.max(first, history.first)) - y(last)));
}
