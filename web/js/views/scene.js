// scene.js -- the 3-D view: camera, picking, and the line that says where the vehicle is.

import { byId, context2d, fitCanvas, write } from "../dom.js";
import { Camera, screenPlace } from "../draw/camera.js";
import { drawMarker } from "../draw/marks.js";
import { SceneRenderer } from "../draw/scene_renderer.js";
import { number, triple } from "../format.js";
import { degrees, rollPitchYaw } from "../geometry.js";
import { watchGestures } from "./gestures.js";

const kModes = ["chase", "orbit", "top"];

export class SceneView {
  constructor(store, frames, choose) {
    this.store = store;
    this.canvas = byId("scene");
    this.camera = new Camera();
    this.redraw = frames.add(() => this.draw(), () => (store.get("main") === "scene" ? 0 : 4000));  // It costs most.
    this.renderer = new SceneRenderer(this.canvas, this.redraw);
    new ResizeObserver(this.redraw).observe(this.canvas);
    store.on(["scene"], () => {
      const scene = store.get("scene");
      if (scene) this.renderer.setScene(scene);
      this.camera.objects = scene?.objects ?? [];
      this.redraw();
    });
    store.on(["sonar"], () => this.#newSonar());
    store.on(["camera"], () => this.#begin(store.get("camera")));
    store.on(["shown", "path", "object", "theme", "main", "low", "high", "gain", "tvg", "map", "hello", "moved", "markers",
      "showEchoes", "showFan", "showSector", "showPaths"], this.redraw);
    for (const mode of kModes) byId(`camera-${mode}`).addEventListener("click", () => {
      store.set({ camera: mode });
      this.#begin(mode);
    });
    this.#listen(choose);
  }

  get #vehicle() {
    const ping = this.store.get("shown");
    return ping?.vehicle ?? ping?.pose ?? null;
  }

  #begin(mode) {
    this.camera.start(mode, this.#vehicle);
    this.waits = !this.#vehicle;  // for the first ping, which says where the vehicle is
    for (const other of kModes) byId(`camera-${other}`).setAttribute("aria-pressed", String(other === mode));
    this.redraw();
  }

  #newSonar() {
    const { max_range: reach, product } = this.store.get("sonar") ?? {};
    if (!reach || (reach === this.camera.reach && product.gathers === this.camera.around)) return;
    this.camera.distance *= reach / this.camera.reach;
    this.camera.reach = reach;
    const other = product.gathers !== this.camera.around;
    this.camera.around = product.gathers;
    if (other) this.#begin(this.store.get("camera"));
    this.redraw();
  }

  #listen(choose) {
    watchGestures(byId("scene-stage"), {
      drag: (dx, dy, second) => {
        if (second) this.camera.pan(dx, dy);
        else this.camera.turn(dx, dy);
        this.redraw();
      },
      zoom: (factor) => {
        this.camera.zoom(factor);
        this.redraw();
      },
      click: (x, y) => {
        const { scale } = fitCanvas(this.canvas);
        if (!this.camera.eye) return;
        choose(this.renderer.pick(this.camera, this.store, Math.round(x * scale), Math.round(y * scale)));
      },
      home: () => this.#begin(this.store.get("camera")),
    });
    byId("scene-stage").addEventListener("keydown", (event) => {
      const turns = { ArrowLeft: [-12, 0], ArrowRight: [12, 0], ArrowUp: [0, 12], ArrowDown: [0, -12] };
      if (!event.altKey || !(event.key in turns)) return;
      event.preventDefault();
      this.camera.turn(...turns[event.key]);
      this.redraw();
    });
  }

  // Over what is in front of them: an operator looks for them.
  #drawMarkers() {
    const { context, width, height } = context2d(byId("scene-marks"));
    context.font = "12px system-ui, sans-serif";
    for (const { name, position } of this.store.get("markers")) {
      const at = screenPlace(this.camera, position, width, height);
      if (at) drawMarker(context, at, name);
    }
  }

  draw() {
    const { width, height } = fitCanvas(this.canvas);
    if (width < 2 || height < 2) return;
    const vehicle = this.#vehicle;
    if (this.waits && vehicle) this.#begin(this.store.get("camera"));
    this.camera.place(vehicle, width / height);
    this.renderer.draw(this.camera, this.store);
    this.#drawMarkers();
    if (!vehicle) return;
    const [roll, pitch, yaw] = rollPitchYaw(vehicle.orientation).map(degrees);
    const angles = [["yaw", yaw], ["pitch", pitch], ["roll", roll]].map(([name, angle]) => `${name} ${number(angle, 0)}°`);
    // The narrow view has a line for each: nothing is cut off.
    write(byId("pose"), `${triple(vehicle.position)} m${width < 480 ? "\n" : "   "}${angles.join(" ")}`);
  }
}
