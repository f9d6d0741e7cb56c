// picture.js -- the sonar picture as fan, polar or round picture, its cursor, zoom and colour bar.

import { byId, context2d, fitCanvas, write } from "../dom.js";
import { drawColourBar, levelBar, paintColourBar } from "../draw/colour_bar.js";
import { drawGraticule } from "../draw/graticule.js";
import { drawMarks, placeInPicture } from "../draw/marks.js";
import { makePlan, underPoint } from "../draw/plan.js";
import { heightAbove } from "../draw/sight.js";
import { drawSoundings, soundingsText } from "../draw/soundings.js";
import { PictureRenderer } from "../draw/renderer.js";
import { clock } from "../format.js";
import { rulerFigures, rulerText } from "../measure.js";
import { poseFigures, poseTexts } from "../pose.js";
import { productIn } from "../product.js";
import { binRange, slotAt } from "../sonar.js";
import { watchGestures } from "./gestures.js";

const kHome = { factor: 1, x: 0, y: 0 };
const kMostZoom = 40;

export class PictureView {
  /** `prefix` of the names of its elements: empty, or "beside-" of the second sonar. */
  constructor(store, frames, choose, prefix = "") {
    this.store = store;
    this.part = (name) => byId(prefix + name);
    this.stage = this.part("picture-stage");
    this.canvas = this.part("picture");
    this.lines = this.part("graticule");
    this.zoom = kHome;
    this.redraw = frames.add(() => this.draw());
    this.redrawLines = frames.add(() => this.drawLines());
    this.redrawBar = frames.add(() => drawColourBar(this.part("colour-bar"), store));
    this.renderer = new PictureRenderer(this.canvas, this.redraw);
    new ResizeObserver(() => {
      this.redraw();
      this.redrawBar();
    }).observe(this.stage);
    store.on(["low", "high", "gain", "tvg", "map", "theme", "main", "sonar", "hello"], this.redrawBar);
    store.on(["sonar"], () => this.#newSonar());
    store.on(["mode"], () => {
      store.set({ cursor: null });
      this.#home();
    });
    store.on(["shown", "mode", "low", "high", "gain", "tvg", "map", "overlay", "smooth", "theme", "main"], this.redraw);
    store.on(["grid", "cursor", "beam", "markers", "ruler", "soundings"], this.redrawLines);
    store.on(["frozen"], () => (this.part("frozen").hidden = !store.get("frozen")));
    this.choose = choose;
    this.#listen();
  }

  /** Takes in every ping, also those that come faster than pictures are drawn. */
  add(ping) {
    if (productIn(this.store).gathers) this.renderer.addRound(ping);
  }

  /** What the round picture holds: its pings by column. */
  get round() {
    return this.renderer.round;
  }

  draw() {
    const { store } = this;
    const sonar = store.get("sonar");
    if (!sonar) return;
    const { width } = fitCanvas(this.canvas);
    this.#arrange();
    this.renderer.draw(this.plan, store);
    this.drawLines();
    this.afterDraw?.();  // While the canvas still has its picture.
    const ping = store.get("shown");
    this.part("empty").hidden = Boolean(ping);
    if (ping && !this.drawn) {
      this.drawn = performance.now();  // [ms] after the page was asked for
      this.firstDrawn?.();
    }
    write(this.part("picture-caption"), width < 420 || !ping ? sonar.name : this.#caption(sonar, ping));
  }

  // Above a fan there is room for lines of it; a polar picture reaches into the corners.
  #caption(sonar, ping) {
    const { store } = this;
    const vehicle = ping.vehicle ?? ping.pose;
    const now = performance.now();
    // The way down is looked for twice a second: large meshes cost milliseconds.
    if (!(now - this.lookedDown < 500)) {
      this.lookedDown = now;
      const height = heightAbove(store.get("scene")?.objects ?? [], vehicle.position);
      store.set({ ground: height === null ? null : vehicle.position[2] - height });
    }
    const texts = poseTexts(poseFigures(vehicle, store.get("hello"), store.get("ground")));
    const found = store.get("soundings") ? soundingsText(ping.tables) : null;
    return [`${sonar.name}   ping ${ping.number}   ${clock(ping.time)} s`, ...texts, ...(found ? [found] : [])].join(store.get("mode") === "polar" ? "   " : "\n");
  }

  drawLines() {
    const { context } = context2d(this.lines);
    if (this.plan) this.#paintLines(context, this.plan);
  }

  #paintLines(context, plan) {
    const { store } = this;
    drawGraticule(context, plan, {
      grid: store.get("grid"),
      cursor: store.get("cursor")?.row ? null : store.get("cursor"),
      headAngle: this.renderer.round.headAngle,
    });
    const ping = store.get("shown");
    if (!ping) return;
    const altitude = ping.pose.position[2] - (store.get("ground") ?? Infinity);
    if (store.get("soundings")) drawSoundings(context, plan, ping);
    const placesOf = ({ point }) => [placeInPicture(plan, ping.pose, point)].filter(Boolean);
    const ruler = store.get("ruler");
    const text = () => rulerText(rulerFigures(ping.pose, ruler.from.point, ruler.to.point, altitude, plan.sonar.down));
    drawMarks(context, plan.width, placesOf, { markers: store.get("markers"), ruler, text });
  }

  get captionText() {
    return this.part("picture-caption").textContent;
  }

  get bar() {
    return levelBar(this.store);
  }

  /** How many pixels of the screen a bin would need to be seen whole. */
  get pixelsNeeded() {
    const { sonar, toScreen } = this.plan;
    return sonar.bins / Math.abs(toScreen(0, sonar.max_range)[1] - toScreen(0, sonar.min_range)[1]);
  }

  /** Paints the picture as it is shown, with lines and colour bar, on a canvas with `scale` pixels for each of the screen. */
  paint(context, scale) {
    const { store, plan } = this;
    const bar = 286;
    [this.canvas.width, this.canvas.height] = [Math.round(plan.width * scale), Math.round(plan.height * scale)];
    this.renderer.draw(plan, store);
    context.drawImage(this.canvas, 0, 0);
    context.save();
    context.scale(scale, scale);
    this.#paintLines(context, plan);
    context.translate(plan.width - bar - 8, plan.height - 52);
    paintColourBar(context, levelBar(store), bar);
    context.restore();
    this.redraw();  // As large as it is on the screen.
  }

  #newSonar() {
    const sonar = this.store.get("sonar");
    this.renderer.setSonar(sonar);
    this.#home();
  }

  // The plan holds at once, also for a mouse that moves before the picture is drawn.
  #arrange() {
    const sonar = this.store.get("sonar");
    const { clientWidth, clientHeight } = this.canvas;
    this.plan = sonar ? makePlan(sonar, this.store.get("mode"), clientWidth, clientHeight, this.zoom) : null;
  }

  #home() {
    this.zoom = kHome;
    this.#arrange();
    this.redraw();
  }

  #listen() {
    const { stage, store } = this;
    watchGestures(stage, {
      hover: (x, y) => store.set({ cursor: this.plan ? underPoint(this.plan, x, y) : null }),
      leave: () => store.set({ cursor: null }),
      click: (x, y) => {
        const cursor = this.plan ? underPoint(this.plan, x, y) : null;
        if (cursor) this.click(cursor);
      },
      drag: (dx, dy) => this.#pan(dx, dy),
      zoom: (factor, x, y) => this.#zoomAt(factor, x, y),
      home: () => this.#home(),
    });
    stage.addEventListener("keydown", (event) => this.#moveCursor(event));
  }

  /** What a click at a cursor does. */
  click(cursor) {
    this.store.set({ cursor, beam: cursor.beam });
    this.choose(cursor);
  }

  #pan(dx, dy) {
    if (this.zoom.factor === 1) return;
    const { factor, x, y } = this.zoom;
    this.zoom = { factor, x: x + dx / this.plan.width, y: y + dy / this.plan.height };
    this.#arrange();
    this.redraw();
  }

  // The point under the mouse stays where it is.
  #zoomAt(by, x, y) {
    if (!this.plan) return;
    const factor = Math.min(kMostZoom, Math.max(1, this.zoom.factor * by));
    if (factor === 1) {
      this.#home();
      return;
    }
    const point = this.plan.toPlane(x, y);
    this.zoom = { ...this.zoom, factor };
    const { sonar, mode, width, height } = this.plan;
    const [newX, newY] = makePlan(sonar, mode, width, height, this.zoom).toScreen(...point);
    this.zoom.x += (x - newX) / width;
    this.zoom.y += (y - newY) / height;
    this.#arrange();
    this.redraw();
  }

  // Alt and an arrow move the cursor to the middle of the next bin or beam, with Shift of the tenth next.
  #moveCursor(event) {
    const sonar = this.store.get("sonar");
    const moves = { ArrowUp: [1, 0], ArrowDown: [-1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] };
    if (!event.altKey || !(event.key in moves) || !sonar) return;
    event.preventDefault();
    const [ahead, beams] = moves[event.key].map((count) => count * (event.shiftKey ? 10 : 1));
    const bins = ahead * (this.store.get("mode") === "fan" ? sonar.sign : 1);
    const from = this.store.get("cursor");
    const clamp = (value, count) => Math.max(0, Math.min(count - 1, value));
    const bin = clamp((from?.bin ?? Math.floor(sonar.bins / 2)) + bins, sonar.bins);
    const range = binRange(sonar, bin);
    if (sonar.product.gathers) {
      const turn = (from?.azimuth ?? 0) - beams * (sonar.ports[0] - sonar.starboards[0]);
      const azimuth = Math.atan2(Math.sin(turn), Math.cos(turn));
      this.store.set({ cursor: { range, azimuth, beam: 0, bin, slot: slotAt(azimuth) } });
      return;
    }
    const beam = clamp((from?.beam ?? Math.floor(sonar.beams / 2)) + beams, sonar.beams);
    this.store.set({ cursor: { range, azimuth: sonar.beamAzimuths[beam], beam, bin }, beam });
  }
}
