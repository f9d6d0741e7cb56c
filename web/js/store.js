// store.js -- what the page knows and shows; its parts listen to the entries that they draw.

/** Values by name, with listeners that hear of changes. */
export class Store {
  #values;
  #listeners = [];

  constructor(values) {
    this.#values = { ...values };
  }

  get(name) {
    return this.#values[name];
  }

  /** Calls `listener(store)` now, and whenever one of `names` changes. */
  on(names, listener) {
    this.#listeners.push({ names: new Set(names), listener });
    listener(this);
  }

  /** Sets some values. Listeners are called once, however many of their values changed. */
  set(values) {
    const changed = Object.keys(values).filter((name) => !Object.is(this.#values[name], values[name]));
    if (changed.length === 0) return;
    Object.assign(this.#values, values);
    for (const { names, listener } of this.#listeners) {
      if (changed.some((name) => names.has(name))) listener(this);
    }
  }
}

const kKept = ["map", "grid", "smooth", "corrected", "bottomLine", "soundings", "truth", "theme", "side", "controls", "showEchoes", "showFan", "showSector", "showPaths"];

/** A store of the page, with what the browser kept of the last visit unless that is not wanted. */
export function makeStore({ kept: keeps = true } = {}) {
  const store = new Store({
    link: { state: "connecting", text: "Connecting" },
    hello: null,        // the server's last `hello`
    status: null,       // the server's last `state`
    wanted: null,       // name of the sonar to watch, null: the one that was watched, or the first
    sonar: null,        // entry of hello.sonars that is watched
    ping: null,         // last decoded ping of that sonar
    shown: null,        // the ping that is drawn: `ping`, unless frozen
    scene: null,        // decoded scene
    path: [],           // positions of the vehicle at the pings since the last change [m]
    rate: null,         // pings a second that arrive here; null: not known yet
    pace: null,         // seconds of the scenario in a second of the clock
    frozen: false,
    mode: "fan",        // fan, polar or round
    main: "picture",    // the large view
    side: true,         // whether the small views are there
    controls: false,    // whether the controls are
    full: false,        // whether the large view has the whole screen
    low: -120,          // level of the darkest colour [dB]
    high: -40,          // level of the brightest colour [dB]
    gain: 0,            // gain of the display [dB]
    tvg: 0,             // X of the display's gain X log10(range / 1 m) [dB]
    map: "inferno",
    overlay: "none",
    over: "none",       // pings that the levels are taken over: see averaging.js
    beside: "",         // name of the second sonar
    grid: true,
    smooth: true,
    truth: true,        // whether labels are asked for, for the names under the cursor
    cursor: null,       // { range, azimuth, beam, bin } under the mouse
    beam: 0,            // beam of A-scan and waterfall while no mouse is over the picture
    object: -1,         // chosen object
    tool: null,         // what a click on the picture does: ruler, marker, or null: it chooses beam and object
    ruler: null,        // { from, to } as marks: see panels/marks.js; to is null until the second click
    markers: [],        // { name, position [m], time [s], sonar, ping, perhaps range [m] and side }
    ground: null,       // height of the first surface below the vehicle [m], null: none
    waterfallOf: "strongest",  // beam; depths of a multibeam
    corrected: false,   // whether the waterfall of a side-scan sonar has ranges on the bed
    bottomLine: false,  // whether it has the line of the first return
    soundings: true,    // whether the fan of a multibeam has its soundings
    camera: "chase",
    showEchoes: true,
    showFan: false,
    showSector: true,
    showPaths: true,
    theme: null,        // light, dark, or null: as the system
    ...(keeps ? kept() : {}),
  });
  if (keeps) store.on(kKept, keep);
  return store;
}

function kept() {
  try {
    const values = JSON.parse(localStorage.getItem("insonify") ?? "{}");
    return Object.fromEntries(kKept.filter((name) => name in values).map((name) => [name, values[name]]));
  } catch {
    return {};  // Storage is off, or holds something else.
  }
}

function keep(store) {
  try {
    localStorage.setItem("insonify", JSON.stringify(Object.fromEntries(kKept.map((name) => [name, store.get(name)]))));
  } catch {
    // Storage is off: the next visit begins with the defaults.
  }
}
