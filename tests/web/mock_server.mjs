// mock_server.mjs -- a stand-in for `insonify serve`: speaks the protocol of docs/design/viewer.md, notes every request, and
// can misbehave on purpose.

import path from "node:path";
import { fileURLToPath } from "node:url";
import { WebSocketServer } from "ws";
import { sourceRoot } from "./checks.mjs";
import { kHostile, makePing, makeScene, makeSonars } from "./mock_sonar.mjs";
import { serveFiles } from "./static_files.mjs";

const kPage = path.join(sourceRoot(), "web");

export class MockServer {
  constructor({ noise = false, rate = 10 } = {}) {
    Object.assign(this, { made: new Map(), noise, rate, requests: [] });
    this.reset();
  }

  /** Everything as at the start; pages hear of it when they connect again. */
  reset() {
    const { rate } = this;
    this.token = undefined;
    Object.assign(this, { watched: "fls", number: 0, headAngle: 0 });
    this.sonars = makeSonars();
    this.vehicle = { position: [0, 0, 0], yaw: 0 };
    this.fly = { linear: [0, 0, 0], angular: [0, 0, 0] };
    this.state = { op: "state", paused: false, follow: true, speed: 1, sonar: "fls", recording: null, recorded_pings: 0, pings_per_second: rate, ms_per_ping: 7.5, dropped: 0, clients: 1, pings_since_change: 0 };
    this.keys = {
      "sonars[0].max_range": { value: 30, least: 0, most: 100000, help: "Far edge of the last bin.", unit: "m" },
      "sonars[0].bin_count": { value: 250, least: 1, most: 65536, help: "Range bins per beam.", unit: "" },
      "sonars[0].gain": { value: 1, least: 0, most: 1e9, help: "Multiplies the intensity.", unit: "" },
      "sonars[1].max_range": { value: 15, least: 0, most: 100000, help: "Far edge of the last bin.", unit: "m" },
      model: { value: "calibrated", choices: ["paper", "calibrated"], help: "Model of the echo.", unit: "" },
      ground_truth: { value: "full", choices: ["none", "labels", "full"], help: "What is kept.", unit: "" },
      "sonars[0].receiver.noise": { value: true, help: "Whether noise is drawn.", unit: "" },
      "sonars[0].receiver.speckle": { value: true, help: "Whether echoes interfere.", unit: "" },
      "sonars[0].receiver.time_varied_gain": { value: null, kind: "number", optional: true, least: 0, most: 60, help: "X of the gain.", unit: "dB/decade" },
      "water.salinity": { value: 35, least: 0, most: 50, help: "Practical salinity.", unit: "PSU" },
      surface: { value: false, kind: "part", help: "Whether there is a surface." },
      "surface.wind_speed": { value: 0, least: 0, most: 30, help: "Wind speed.", unit: "m/s" },
    };
    this.materials = [0, 1, 2];
    this.recording = null;
  }

  async start(port = 0) {
    this.http = serveFiles(kPage, { "/access": (url) => (this.#admits(url) ? [200, "come in\n"] : [401, "the token is missing or wrong\n"]) });
    this.sockets = new WebSocketServer({ server: this.http, verifyClient: ({ req }) => this.#admits(new URL(req.url, "http://localhost")), handleProtocols: (offered) => (offered.has("insonify.viewer.v1") ? "insonify.viewer.v1" : false) });
    this.sockets.on("connection", (socket, request) => this.#join(socket, request));
    await new Promise((done) => this.http.listen(port, "127.0.0.1", done));
    this.port = this.http.address().port;
    this.timers = [setInterval(() => this.#tick(), 1000 / this.rate), setInterval(() => this.say(this.state), 1000)];
    return `http://127.0.0.1:${this.port}/`;
  }

  async stop() {
    this.timers.forEach(clearInterval);
    for (const socket of this.sockets.clients) socket.terminate();
    this.sockets.close();
    this.http.closeAllConnections();
    await new Promise((done) => this.http.close(done));
  }

  say(message) {
    for (const socket of this.sockets.clients) socket.send(typeof message === "object" && !Buffer.isBuffer(message) ? JSON.stringify(message) : message);
  }

  /** Where it has a `token`, it wants that. */
  #admits(url) {
    return this.token === undefined || url.searchParams.get("token") === this.token;
  }

  hello() {
    return {
      op: "hello", version: "0.0.0", scenario_name: "mock", record_formats: [["h5", "HDF5"], ["mcap", "MCAP"]], recording: this.recording, presets: ["oculus", "gemini"], sonars: this.sonars, objects: [kHostile, "wall", "bed"], materials: ["steel", "concrete", "sand"],
      object_materials: this.materials, trajectory: [[-8, 0, 0], [0, 0, 0], [8, 2, 0]], keys: this.keys,
    };
  }

  #join(socket, request) {
    this.lastUrl = request.url;
    socket.send(JSON.stringify(this.hello()));
    socket.send(makeScene());
    socket.send(JSON.stringify(this.state));
    socket.watch = { sonar: this.watched, tables: ["level"] };
    socket.on("message", (data) => this.#answer(JSON.parse(data), socket));
    if (this.prepared) socket.send(this.prepared);
  }

  #answer(request, socket) {
    this.requests.push(request);
    const { op } = request;
    if (op === "watch") {
      socket.watch = { sonar: request.sonar, tables: request.tables ?? ["level"] };
      this.watched = request.sonar;
    }
    if (op === "pause") this.state.paused = request.on;
    if (op === "follow") this.state.follow = request.on;
    if (op === "speed") this.state.speed = request.factor;
    if (op === "fly") {
      this.fly = request;
      this.state.follow &&= ![...request.linear, ...request.angular].some((part) => part !== 0);
    }
    if (op === "place") this.vehicle.position = request.position;
    if (op === "seek") this.number = Math.round(request.time / this.sonars.find(({ name }) => name === this.watched).period);
    if (op === "step" && request.back) this.number -= 2;
    if (op === "step" || op === "seek") this.#ping(true);
    if (op === "record") this.state.recording = request.on ? `out/live.${request.format}` : null;
    if (op === "mark") this.say({ op: "markers", markers: request.markers });
    if (op === "save") this.say({ op: "saved", yaml: "world: none\n", path: null });
    if (op === "material") this.#setMaterial(request);
    if (op === "set") this.#set(request.settings);
    if (op !== "watch" && op !== "fly") this.say(this.state);
  }

  #setMaterial({ object, material }) {
    this.materials[this.hello().objects.indexOf(object)] = this.hello().materials.indexOf(material);
    this.say(this.hello());
  }

  #set(settings) {
    for (const setting of settings) {
      const [key, text] = setting.split(/=(.*)/s);
      const entry = this.keys[key];
      if (!entry) continue;
      const value = text === "true" ? true : text === "false" ? false : entry.kind === "part" ? text !== "null" : text !== "" && Number.isFinite(Number(text)) ? Number(text) : text;
      if (entry.most !== undefined && !(value > entry.least && value <= entry.most)) {
        this.say({ op: "error", of: "set", text: `--set: ${key} = ${text} must be greater than ${entry.least} and at most ${entry.most}` });
        return;
      }
      entry.value = value;
      if (key === "sonars[0].max_range") this.sonars[0].max_range = value;
      if (key === "sonars[0].bin_count") this.sonars[0].bins = value;
    }
    this.number = 0;
    this.say(this.hello());
  }

  #sonar(watch) {
    return this.sonars.find(({ name }) => name === watch.sonar);
  }

  #tick() {
    if (this.state.paused) return;
    const dt = 1 / this.rate;
    const { vehicle, fly } = this;
    vehicle.yaw += (fly.angular[2] * dt * Math.PI) / 180;
    const [c, s] = [Math.cos(vehicle.yaw), Math.sin(vehicle.yaw)];
    const [surge, sway, heave] = fly.linear;
    vehicle.position = vehicle.position.map((x, i) => x + dt * [c * surge - s * sway, s * surge + c * sway, heave][i]);
    this.#ping();
  }

  /** @param asked  Whether pages have asked for this one, and get it however slow they are. */
  #ping(asked = false) {
    if (this.sockets.clients.size === 0) return;
    const sockets = [...this.sockets.clients].filter(({ watch }) => watch && this.#sonar(watch));
    if (sockets.some(({ watch }) => this.#sonar(watch).type === "msis")) this.headAngle += (this.sonars[1].step * Math.PI) / 180;
    const lacks = this.keys.model.value === "paper" ? ["shadow", "multipath"] : [];
    for (const socket of sockets) {
      const { watch } = socket;
      const sonar = this.#sonar(watch);
      const headAngle = sonar.type === "msis" ? Math.atan2(Math.sin(this.headAngle), Math.cos(this.headAngle)) : 0;
      const tables = watch.tables.filter((table) => !lacks.includes(table));
      const ping = makePing(sonar, this.number, this.vehicle, headAngle, tables, this.noise, this.made);
      if (asked || socket.bufferedAmount === 0) socket.send(ping);  // A slow page gets fewer, as of the real server.
    }
    ++this.number;
    this.state.pings_since_change = this.number;
    this.state.time = (this.number - 1) * this.#sonar({ sonar: this.watched }).period;
  }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  console.log(await new MockServer({ noise: true, rate: 5 }).start(Number(process.argv[2] ?? 8765)));
}
