// session.js -- what messages of the server do to the store.

import { Connection } from "./link/connection.js";
import { decode } from "./link/decode.js";
import { radians } from "./geometry.js";
import { Averager } from "./averaging.js";
import { Rates } from "./rates.js";
import { describeSonar } from "./sonar.js";

const kMostPath = 20_000;
const kOverlays = ["instance", "material", "elevation", "shadow", "multipath"];

/** What pictures of a sonar depend on, as a text. */
const shapeOf = ({ levels: _levels, shown_gain: _gain, reference: _reference, gain_db: _gainDb, ...shape }) => JSON.stringify(shape);

export class Session {
  #rates = new Rates();
  #averager = new Averager();
  #scene = null;

  /** Calls `taken(ping, frozen)` for every ping, `saved(message)` for a saved scenario, `refused(reason)` if a token is needed. */
  constructor(store, notes, { taken, saved, changed, refused }) {
    Object.assign(this, { store, notes, taken, saved, changed });
    this.connection = new Connection({
      opened: () => this.#watch(),
      link: (link) => this.#link(link),
      refused,
      text: (message) => this.#text(message),
      binary: (buffer) => this.#binary(buffer),
    });
    store.on(["sonar", "overlay", "truth", "showEchoes", "cursor", "frozen"], () => this.#watch());
    store.on(["frozen"], () => store.get("frozen") || store.set({ shown: store.get("ping") }));
    setInterval(() => this.#rate(), 250);
  }

  /** Sends a request, or says that there is nobody to send it to. */
  request(message) {
    if (this.connection.send(message)) return true;
    this.notes.error("No connection: nothing was changed.", message.op);
    return false;
  }

  /** Tries again, with another token. */
  tell(token) {
    this.connection.tell(token);
  }

  /** Ends the connection, until it is wanted again. */
  pause() {
    this.connection.pause();
  }

  resume() {
    this.connection.resume();
  }

  choose(name) {
    const sonar = this.store.get("hello")?.sonars.find((each) => each.name === name);
    if (sonar) this.#setSonar(sonar);
  }

  #link(link) {
    const before = this.store.get("link").state;
    this.store.set({ link });
    if (link.state === "lost" && link.reason && before !== "open" && link.reason !== this.#refusal) {
      this.notes.error(`The server opens no connection: ${link.reason}`);
    }
    this.#refusal = link.state === "connecting" ? this.#refusal : link.reason ?? "";
    if (link.state === "lost" && before === "open") {
      this.notes.error(link.reason ? `The server ended the connection: ${link.reason}` : "The connection is lost.");
    }
    if (link.state === "open" && this.store.get("hello")) this.notes.note("Connected again.");
    if (link.state === "open") return;
    this.#watched = "";
    this.#rates.reset();
  }

  #watched = "";
  #refusal = "";  // what was said last

  // Asks for the tables that are shown, and for no others.
  #watch() {
    const { store } = this;
    const sonar = store.get("sonar")?.name;
    if (!sonar || !this.connection.open) return;
    const tables = new Set(["level"]);
    // They are five sixths of a ping: only while they are read, or can be on a picture that stays.
    const cursor = store.get("cursor");
    const reads = (cursor && !cursor.row) || store.get("frozen");
    if (store.get("truth") && reads) tables.add("instance").add("material").add("elevation");
    if (store.get("showEchoes")) tables.add("elevation");
    if (store.get("sonar").down) tables.add("sounding_range").add("detection");
    if (kOverlays.includes(store.get("overlay"))) tables.add(store.get("overlay"));
    const request = { op: "watch", sonar, tables: [...tables] };
    const text = JSON.stringify(request);
    if (text === this.#watched) return;
    this.#watched = text;
    this.connection.send(request);
  }

  #text(message) {
    const { store, notes } = this;
    switch (message.op) {
      case "hello": this.#hello(message); break;
      case "state": store.set({ status: message }); break;
      case "levels": this.#levels(message); break;
      case "error": notes.error(message.text, message.of); break;
      case "note": notes.note(message.text); break;
      case "markers": store.set({ markers: message.markers }); break;
      case "saved": this.saved(message); break;
      case "closing": break;  // The connection says it when it is closed.
      default: notes.error(`The server said ${message.op}, which is not known here.`);
    }
  }

  #hello(hello) {
    const { store } = this;
    const name = store.get("wanted") ?? store.get("sonar")?.name;
    const described = hello.sonars.find((sonar) => sonar.name === name) ?? hello.sonars[0];
    this.#refresh(described);
    store.set({ hello });
    this.#setSonar(described);
    this.#watch();
  }

  // Where the sonar itself is the same, pictures go on, and only what they are shown with is new.
  #refresh(described) {
    const sonar = this.store.get("sonar");
    if (sonar?.shape !== shapeOf(described)) return;
    Object.assign(sonar, { levels: described.levels, shown_gain: described.shown_gain, reference: described.reference });
    this.changed();
  }

  // As the first turn of a scanning head goes on, louder echoes are known.
  #levels({ sonar: name, levels }) {
    const described = this.store.get("hello")?.sonars.find((each) => each.name === name);
    if (!described) return;
    described.levels = levels;
    if (this.store.get("sonar")?.name === name) this.#refresh(described);
  }

  #setSonar(described) {
    const { store } = this;
    const before = store.get("sonar");
    if (before?.shape === shapeOf(described)) return;
    const sonar = { ...describeSonar(described), shape: shapeOf(described) };
    const same = before?.name === sonar.name;
    if (!same) this.#rates.reset();
    if (!same && (sonar.product.main || before?.product.main)) store.set({ main: sonar.product.main ?? "picture" });
    store.set({
      sonar, ping: null, shown: null, cursor: null, path: [],
      mode: this.#modeFor(sonar, same),
      waterfallOf: this.#waterfallFor(sonar, same),
      beam: same ? Math.min(store.get("beam"), sonar.beams - 1) : Math.floor(sonar.beams / 2),
    });
    this.changed();
  }

  // The fan of a very narrow sonar is a line, and a side-scan sonar has none: it begins as polar picture, and the next sonar as the one before it.
  #modeFor(sonar, same) {
    const now = this.store.get("mode");
    const kNarrow = radians(4);
    const { pictures, gathers } = sonar.product;
    const isNarrow = sonar.product.sides || !gathers && (sonar.beams === 1 || sonar.ports[0] - sonar.starboards.at(-1) < kNarrow);
    const wanted = same ? now : isNarrow ? "polar" : this.#modeBefore || now;
    if (!same) this.#modeBefore = isNarrow ? this.#modeBefore || now : "";
    return pictures.includes(wanted) ? wanted : pictures[0];
  }

  // That of a multibeam begins with depths, which others do not have.
  #waterfallFor(sonar, same) {
    const now = this.store.get("waterfallOf");
    if (sonar.down) return same ? now : "depths";
    return now === "depths" ? "strongest" : now;
  }

  #modeBefore = "";  // that of the sonar before a narrow one

  #binary(buffer) {
    try {
      const message = decode(buffer);
      if (message.kind === "ping") this.#ping(message);
      else if (message.kind === "scene") this.store.set({ scene: this.#scene = message });
      else this.#moved(message);
    } catch (error) {
      this.notes.error(`A message of the server cannot be read: ${error.message}`);
    }
  }

  #ping(made) {
    const { store } = this;
    const sonar = store.get("sonar");
    if (!sonar || made.sonar !== sonar.name || made.beams !== sonar.beams || made.bins !== sonar.bins) return;
    const ping = sonar.product.gathers ? made : this.#averager.take(made, store.get("over"));
    const path = store.get("path");
    // A change restarts the run: pings count from 0.
    const last = store.get("ping");
    const restarted = last && (ping.number < last.number || ping.change !== last.change);
    const again = last && !restarted && ping.number === last.number;  // With the tables that were asked for since.
    const position = (ping.vehicle ?? ping).position;
    if (!again) this.#rates.add(performance.now(), ping);
    const patch = { ping, path: again ? path : restarted ? [position] : [...path.slice(-kMostPath), position] };
    const shown = store.get("shown");
    const completes = (again && shown?.number === ping.number) || (shown && !shown.tables.instance && ping.tables.instance);
    const frozen = store.get("frozen");
    if (!again) this.taken(ping, frozen);
    if (frozen && !completes) {
      store.set(patch);
      return;
    }
    store.set({ ...patch, shown: ping });
  }

  #moved({ objects }) {
    for (const { index, matrix } of objects) {
      if (this.#scene?.objects[index]) this.#scene.objects[index].matrix = matrix;
    }
    this.store.set({ moved: {} });
  }

  #rate() {
    const now = performance.now();
    this.store.set({ rate: this.#rates.pingsPerSecond(now), pace: this.#rates.timeFactor(now) });
  }
}
