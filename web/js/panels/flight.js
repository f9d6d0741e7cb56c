// flight.js -- sums the inputs of keyboard, sticks and gamepad, and sends changes to the server.

import { byId, write } from "../dom.js";
import { degrees, quaternionOf, radians, rollPitchYaw } from "../geometry.js";
import { number } from "../format.js";

const kAxes = ["surge", "sway", "heave", "roll", "pitch", "yaw"];
const kRepeat = 500;  // milliseconds after which a held command is sent again

export class Flight {
  #wishes = new Map();  // source -> { surge ... yaw } within -1 and 1
  #sent = "";
  #timer = 0;

  constructor(store, request, notes) {
    this.request = request;
    this.notes = notes;
    this.speed = 1;
    this.turn = 20;
    this.#sliders();
    setUpPlace(store, request, notes);
    window.addEventListener("blur", () => this.stop());
    document.addEventListener("visibilitychange", () => document.hidden && this.stop());
  }

  /** What a source wants now; parts that it leaves out are 0. */
  wish(source, wishes) {
    if (kAxes.some((axis) => wishes[axis])) this.#wishes.set(source, wishes);
    else this.#wishes.delete(source);
    this.#send();
  }

  stop() {
    this.#wishes.clear();
    this.#send();
  }

  #sum(axis) {
    let sum = 0;
    for (const wishes of this.#wishes.values()) sum += wishes[axis] ?? 0;
    return Math.max(-1, Math.min(1, sum));
  }

  #send() {
    const [surge, sway, heave, roll, pitch, yaw] = kAxes.map((axis) => this.#sum(axis));
    const round = (value) => Math.round(value * 1000) / 1000 || 0;
    const linear = [surge, sway, heave].map((part) => round(part * this.speed));
    const angular = [roll, pitch, yaw].map((part) => round(part * this.turn));
    const moves = [...linear, ...angular].some((value) => value !== 0);
    const text = JSON.stringify([linear, angular]);
    clearTimeout(this.#timer);
    if (moves) this.#timer = setTimeout(() => { this.#sent = ""; this.#send(); }, kRepeat);
    if (text === this.#sent || (!moves && this.#sent === "")) return;
    this.notes.expect("fly", byId("error-fly"));
    this.request({ op: "fly", linear, angular });
    this.#sent = moves ? text : "";
  }

  #sliders() {
    for (const [id, name, unit] of [["fly-speed", "speed", "m/s"], ["fly-turn", "turn", "°/s"]]) {
      const input = byId(id);
      const show = () => {
        this[name] = Number(input.value);
        write(byId(`${id}-text`), `${number(this[name], name === "speed" ? 1 : 0)} ${unit}`);
        this.#send();
      };
      input.addEventListener("input", show);
      show();
    }
  }
}

const kPlace = ["x", "y", "z", "roll", "pitch", "yaw"];

// Puts the vehicle somewhere, by numbers.
function setUpPlace(store, request, notes) {
  byId("place-here").addEventListener("click", () => {
    const vehicle = store.get("ping")?.vehicle;
    if (!vehicle) return;
    const values = [...vehicle.position, ...rollPitchYaw(vehicle.orientation).map(degrees)];
    kPlace.forEach((name, i) => (byId(`place-${name}`).value = Number(values[i].toFixed(3))));
  });
  byId("place-go").addEventListener("click", () => {
    const values = kPlace.map((name) => Number(byId(`place-${name}`).value || NaN));
    const line = byId("error-place");
    notes.expect("place", line);
    const bad = values.findIndex((value) => !Number.isFinite(value));
    if (bad >= 0) {
      notes.error(`${kPlace[bad]} must be a number.`, "place");
      return;
    }
    request({ op: "place", position: values.slice(0, 3), orientation: quaternionOf(values.slice(3).map(radians)) });
  });
}
