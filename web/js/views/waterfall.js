// waterfall.js -- pings over time, the newest on top: both sides of a side-scan sonar, the depths of a multibeam's swath, the chosen
// beam, or the strongest echo at each range. Wheel, drag and keys go back through the rows that are kept.

import { byId, context2d, fitCanvas, write } from "../dom.js";
import { drawColourBar, levelBar } from "../draw/colour_bar.js";
import { bearing, clock, number } from "../format.js";
import { BottomTracker, kNoBottom, pitchCosine } from "../strip/bottom.js";
import { spanOf, surfaceOf } from "../strip/heights.js";
import { StripHistory } from "../strip/history.js";
import { peakOf, stripKind } from "../strip/kinds.js";
import { drawStripLines } from "../strip/lines.js";
import { kHeightMap, kRows, StripRenderer } from "../strip/renderer.js";
import { stripRulerText } from "../strip/ruler.js";
import { isRecording } from "../panels/timeline.js";
import { watchGestures } from "./gestures.js";

const kUsual = 3;      // height of a ping [CSS pixels]
const kLeast = 1;
const kMost = 12;
const kScale = 16;     // height of the labels below the rows [CSS pixels]
const kWide = 420;     // A narrower view has less text [CSS pixels].

export class WaterfallView {
  /** `choose(mark)` is called for a click, with { point, sonar, number, time, range, beam }. */
  constructor(store, frames, choose = () => {}) {
    this.store = store;
    this.choose = choose;
    this.canvas = byId("waterfall");
    this.lines = byId("waterfall-scale");
    this.history = new StripHistory(kRows);
    this.pixels = kUsual;
    this.top = null;  // index of the row at the top while one looks back; null: the newest
    this.redraw = frames.add(() => this.draw(), () => (store.get("main") === "waterfall" ? 0 : 1000));
    this.redrawLines = frames.add(() => this.drawLines());
    this.renderer = new StripRenderer(this.canvas, () => this.#fill());
    new ResizeObserver(this.redraw).observe(byId("waterfall-stage"));
    this.clear();
    store.on(["sonar", "waterfallOf"], () => this.#begin());
    store.on(["beam"], () => store.get("waterfallOf") === "beam" && this.#begin());
    store.on(["low", "high", "gain", "tvg", "map", "theme", "main", "corrected", "hello"], this.redraw);
    store.on(["cursor", "markers", "ruler", "bottomLine", "grid"], this.redrawLines);
    store.on(["frozen"], () => this.#freeze());
    this.#listen();
  }

  // A waterfall begins with the ping that is shown.
  #begin() {
    this.clear();
    const shown = this.store.get("shown");
    if (shown && shown.sonar === this.store.get("sonar")?.name) this.add(shown);
  }

  /** Forgets all rows. */
  clear() {
    const { store } = this;
    const sonar = store.get("sonar");
    this.history.clear();
    this.setTop(null);
    if (!sonar) return;
    const beam = store.get("waterfallOf") === "beam" ? Math.min(store.get("beam"), sonar.beams - 1) : -1;
    const kind = stripKind(sonar, store.get("waterfallOf"));
    const { limit } = this.renderer;
    const group = Math.ceil(kind.columns(sonar, 1) / limit);
    this.strip = { sonar, kind, group, beam: sonar.product.gathers ? 0 : beam, columns: kind.columns(sonar, group) };
    this.tracker = sonar.product.sides ? new BottomTracker(sonar) : null;
    this.renderer.prepare(kind.heights, this.strip.columns);
    this.redraw();
  }

  get count() {
    return this.history.count;
  }

  /** Ages of the rows, newest first [s]. */
  get ages() {
    const { history } = this;
    return Array.from({ length: history.count - history.first }, (_, i) => history.newest.age - history.row(history.count - 1 - i).age);
  }

  // A graphics context that was lost has come back empty.
  #fill() {
    if (!this.strip) return;
    this.renderer.prepare(this.strip.kind.heights, this.strip.columns);
    for (let i = this.history.first; i < this.history.count; ++i) this.renderer.write(this.history.slot(i), this.history.row(i));
    this.redraw();
  }

  /** Takes in every ping, also while the picture is not drawn. */
  add(ping) {
    const { history, store, strip } = this;
    if (!strip) return;
    this.#goBack(ping);
    const values = strip.kind.values(strip.sonar, ping, strip);
    const row = { sonar: ping.sonar, number: ping.number, time: ping.time, pose: ping.pose, values, ...strip.kind.kept(ping, strip.sonar, strip), ...this.#bottomOf(ping) };
    if (!strip.kind.heights) row.peak = peakOf(strip.sonar, values, strip.group, store.get("tvg"));
    history.add(row, strip.sonar.period ?? Infinity);
    this.renderer.write(history.slot(history.count - 1), row);
    this.#hold();
    if (this.pointer && !store.get("frozen")) this.#hover(...this.pointer);
    this.redraw();
  }

  // A recording that was set back shows rows again, or others.
  #goBack(ping) {
    const { history } = this;
    const last = history.newest;
    if (!last || !isRecording(this.store) || ping.time >= last.time) return;
    const index = history.find(ping.number, ping.time);
    if (index < 0) this.clear();
    else history.cut(index);
    this.setTop(null);
  }

  // First return and height above the bed: by the levels where the bottom is seen, else by the scene.
  #bottomOf(ping) {
    const ground = this.store.get("ground");
    const height = ground === null ? null : Math.max(0, ping.pose.position[2] - ground);
    if (!this.tracker) return { ground };
    const { range, quality } = this.tracker.add(ping.tables.level);
    const cosine = pitchCosine(ping.pose);
    const altitude = quality >= kNoBottom ? range * cosine : height ?? this.history.newest?.altitude ?? null;
    return { altitude, bottom: altitude === null ? null : altitude / Math.max(cosine, 0.1), tracked: quality >= kNoBottom };
  }

  /** How many rows fit. */
  get visible() {
    return Math.max(1, this.canvas.clientHeight / this.pixels);
  }

  /** Index of the row at the top. */
  get topRow() {
    return this.top ?? this.history.count - 1;
  }

  /** Puts a row at the top, as far as there are rows; the newest: live, unless it is frozen. */
  setTop(index) {
    const { history } = this;
    const newest = history.count - 1;
    const lowest = Math.min(newest, history.first + Math.floor(this.visible) - 1);
    const isLive = index === null || index >= newest;
    this.top = isLive && !this.store.get("frozen") ? null : Math.max(lowest, Math.min(index ?? newest, newest));
    if (this.top === null) this.rest = 0;
    byId("waterfall-live").hidden = this.top === null || this.store.get("frozen");
    this.redraw();
  }

  // The row at the top stays there as others are added, as long as it is kept.
  #hold() {
    if (this.top !== null) this.top = Math.max(this.top, this.history.first);
  }

  /** Goes back by so many rows, or forth. */
  scroll(rows) {
    this.rest = (this.rest ?? 0) + rows;
    const whole = Math.trunc(this.rest);
    if (whole === 0) return;
    this.rest -= whole;
    this.setTop(this.topRow - whole);
    this.#hover(...(this.pointer ?? [-1, -1]));
  }

  /** Goes back by a page, or forth. */
  page(pages) {
    this.scroll(pages * Math.max(1, Math.floor(this.visible * 0.9)));
  }

  // A frozen waterfall stays as it is while rows are added.
  #freeze() {
    const frozen = this.store.get("frozen");
    if (frozen && this.top === null && this.history.count > 0) {
      this.top = this.history.count - 1;
      this.thawsLive = true;
    } else if (!frozen) {
      this.setTop(this.thawsLive ? null : this.top);
      this.thawsLive = false;
    }
    this.redraw();
  }

  /** Where rows lie on the stage: { left, top, width, height, pixels, rowY(index), indexAt(y) }. */
  get plan() {
    const { canvas, pixels, topRow } = this;
    const [left, top, width, height] = [canvas.offsetLeft, canvas.offsetTop, canvas.clientWidth, canvas.clientHeight];
    return {
      left, top, width, height, pixels, bottom: top + height,
      xOf: (share) => left + share * width,
      yOf: (index) => top + (topRow - index + 0.5) * pixels,
      indexAt: (y) => topRow - Math.floor((y - top) / pixels),
    };
  }

  /** Returns whether there was a row to show. */
  draw() {
    const { history, renderer, store, strip } = this;
    fitCanvas(this.canvas);
    if (!strip) {
      renderer.clear();
      return false;
    }
    const rows = Math.max(0, this.topRow - history.first + 1);
    this.shown = this.#shown();
    renderer.draw(store, { top: history.slot(Math.max(0, this.topRow)), rows, visible: this.visible }, this.shown);
    write(byId("waterfall-caption"), this.#caption());
    drawColourBar(byId("waterfall-bar"), store, this.bar);
    this.drawLines();
    this.afterDraw?.();  // While the canvas still has its picture.
    return history.count > 0;
  }

  #rowsInView() {
    const last = this.topRow;
    return Array.from({ length: Math.max(0, Math.min(Math.ceil(this.visible), last - this.history.first + 1)) }, (_, i) => this.history.row(last - i));
  }

  // Colours and geometry of the rows in view.
  #shown() {
    const { store, strip } = this;
    const corrected = store.get("corrected") && strip.sonar.product.sides;
    if (strip.kind.heights) return { ...strip, corrected, span: spanOf(this.#rowsInView()) };
    // The strongest of all beams would be brighter than most colours: theirs reach to the loudest that is seen.
    const loudest = strip.sonar.product.sides ? -Infinity : Math.max(...this.#rowsInView().map(({ peak }) => peak));
    return { ...strip, corrected, high: Math.max(store.get("high"), Math.ceil(loudest + store.get("gain"))) };
  }

  /** What the colour bar shows. */
  get bar() {
    const { high, kind, span } = this.shown;
    if (!kind.heights) return levelBar(this.store, high);
    const level = surfaceOf(this.store);
    return { low: span[0], high: span[1], map: kHeightMap, text: level === null ? "z of the soundings [m]" : `z of the soundings [m], surface at ${number(level, 1)}` };
  }

  get captionText() {
    return byId("waterfall-caption").textContent;
  }

  #caption() {
    const { history, store, strip, shown } = this;
    const { sonar, beam, kind } = strip;
    const level = shown.high > store.get("high") ? `, to ${number(shown.high)} dB` : "";
    const what = kind.caption?.(sonar, shown) ?? (sonar.product.waterfall ?? (beam >= 0 ? `Beam ${beam}   ${bearing(sonar.beamAzimuths[beam])}` : "Strongest"));
    const row = history.row(this.topRow);
    if (this.canvas.clientWidth < kWide || !row) return this.canvas.clientWidth < kWide ? what.replace(/   (slant|ground) range$/, "") + level : what + level;
    const back = history.newest.age - row.age;
    const texts = [what + level, `ping ${row.number}`, `${clock(row.time)} s`];
    if (row.altitude !== null && row.altitude !== undefined) texts.push(`altitude ${number(row.altitude, 1)} m`);
    if (this.top !== null && back > 0) texts.push(`${number(back, 1)} s back`);
    return texts.join("   ");
  }

  drawLines() {
    const { context, width } = context2d(this.lines);
    if (!this.strip || !this.shown) return;
    const { store, history } = this;
    drawStripLines(context, {
      plan: this.plan, history, width, first: Math.ceil(this.topRow - this.visible), last: this.topRow, ...this.shown,
      back: this.top !== null, isSmall: this.canvas.clientWidth < kWide, scale: kScale,
      grid: store.get("grid"), bottomLine: store.get("bottomLine"), cursor: store.get("cursor"),
      markers: store.get("markers"), ruler: store.get("ruler"),
      text: () => stripRulerText(this.shown, history, store.get("ruler")),
    });
  }

  /** The place under a point of the stage, with its row; null beside the rows. */
  under(x, y) {
    const { plan, strip, shown } = this;
    if (!shown || x < plan.left || x >= plan.left + plan.width || y < plan.top || y >= plan.bottom) return null;
    const index = plan.indexAt(y);
    const row = this.history.row(index);
    const place = row && strip.kind.at(strip.sonar, row, (x - plan.left) / plan.width, shown);
    return place ? this.#cursorAt(index, place) : null;
  }

  #cursorAt(index, place) {
    const { strip, history } = this;
    const row = history.row(index);
    return { ...place, row, index, world: strip.kind.point(strip.sonar, row, place) };
  }

  #hover(x, y) {
    const cursor = this.under(x, y);
    if (cursor || this.store.get("cursor")?.row) this.store.set({ cursor });
  }

  #listen() {
    const { store } = this;
    const stage = byId("waterfall-stage");
    watchGestures(stage, {
      hover: (x, y) => {
        this.pointer = [x, y];
        this.#hover(x, y);
      },
      leave: () => {
        this.pointer = null;
        if (store.get("cursor")?.row) store.set({ cursor: null });
      },
      click: (x, y) => {
        const cursor = this.under(x, y);
        if (cursor) this.click(cursor);
      },
      drag: (dx, dy) => this.scroll(-dy / this.pixels),
      wheel: (pixels, zooms) => (zooms ? this.#zoom(Math.exp(-0.0015 * pixels)) : this.scroll(pixels / this.pixels)),
      zoom: (factor) => this.#zoom(factor),
      home: () => store.get("tool") || this.setTop(null),
    });
    stage.addEventListener("keydown", (event) => this.#moveCursor(event));
    byId("waterfall-live").addEventListener("click", () => this.setTop(null));
  }

  /** What a click at a cursor does. */
  click(cursor) {
    const { row, world, range, beam } = cursor;
    this.store.set({ cursor });
    this.choose({ point: world, sonar: row.sonar, number: row.number, time: row.time, range, beam });
  }

  // Rows become higher, or lower.
  #zoom(factor) {
    this.pixels = Math.max(kLeast, Math.min(kMost, this.pixels * factor));
    this.setTop(this.top);
  }

  // Alt and an arrow move the cursor to the next row or column, with Shift to the tenth next.
  #moveCursor(event) {
    const moves = { ArrowUp: [1, 0], ArrowDown: [-1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] };
    if (!event.altKey || !(event.key in moves) || !this.strip || this.history.count === 0) return;
    event.preventDefault();
    const { strip, history, store, shown } = this;
    const [rows, columns] = moves[event.key].map((count) => count * (event.shiftKey ? 10 : 1));
    const from = store.get("cursor")?.row ? store.get("cursor") : null;
    const index = Math.max(history.first, Math.min(history.count - 1, (from?.index ?? this.topRow - Math.floor(this.visible / 3)) + rows));
    const row = history.row(index);
    const start = from ?? strip.kind.at(strip.sonar, row, 0.75, shown);
    if (!start) return;
    const place = placeAt(strip, row, strip.kind.step(strip.sonar, start, columns));
    if (place) store.set({ cursor: this.#cursorAt(index, place) });
  }
}

// The place in the middle of a bin, or of a beam's sounding.
function placeAt({ sonar, kind }, row, { beam, bin }) {
  if (kind.heights) return kind.at(sonar, row, (beam + 0.5) / sonar.beams);
  const azimuth = sonar.product.sides ? sonar.beamAzimuths[beam] : row.azimuth;
  return azimuth === null ? null : { beam, bin, range: sonar.min_range + (bin + 0.5) * sonar.binLength, azimuth };
}
