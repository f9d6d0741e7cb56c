// scene_renderer.js -- draws scene, vehicle, sector, paths and echoes in three dimensions by WebGL2.

import { themeColour } from "../dom.js";
import { norm, poseMatrix, subtract } from "../geometry.js";
import { colourTable } from "./colour_maps.js";
import { isSoftware, makeProgram, openGl, poolBins, Table } from "./gl.js";
import { setLevelUniforms } from "./level_shader.js";
import { deleteScene, uploadScene, Vertices } from "./meshes.js";
import { kEcho, kFan, kLine, kSurface, kWater } from "./scene_shaders.js";
import { crossLines, echoPoints, fanShape, sectorShape, vehicleParts } from "./shapes.js";

const kIdentity = new Float32Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
const kTrajectory = [0.55, 0.75, 0.9, 0.75];
const kFlown = [1.0, 0.66, 0.15, 0.95];
const kSector = [0.35, 0.85, 1.0, 0.55];
const kFace = [0.35, 0.85, 1.0, 0.05];
const kPoint = [1.0, 0.3, 0.35, 1.0];  // of a point target

export class SceneRenderer {
  constructor(canvas, redraw) {
    this.canvas = canvas;
    this.uploaded = [];
    this.gl = openGl(canvas, () => {
      this.#build();
      redraw();
    }, !isSoftware());
    this.#build();
  }

  #build() {
    const { gl } = this;
    const programs = { water: kWater, surface: kSurface, line: kLine, echo: kEcho, fan: kFan };
    this.programs = Object.fromEntries(Object.entries(programs).map(([name, texts]) => [name, makeProgram(gl, ...texts)]));
    this.lists = { trajectory: new Vertices(gl, 3), flown: new Vertices(gl, 3), sector: new Vertices(gl, 3), face: new Vertices(gl, 3), echoes: new Vertices(gl, 4), fan: new Vertices(gl, 4), points: new Vertices(gl, 3) };
    this.vehicle = vehicleParts().map(({ colour, vertices }) => {
      const list = new Vertices(gl, 3);
      list.fill(vertices);
      return { colour, list };
    });
    this.levels = new Table(gl, "uint16");
    this.map = new Table(gl, "rgba8");
    this.of = {};  // what was uploaded last
    this.uploaded = this.scene ? uploadScene(gl, this.scene) : [];
  }

  setScene(scene) {
    deleteScene(this.gl, this.uploaded);
    this.scene = scene;
    this.uploaded = uploadScene(this.gl, scene);
  }

  draw(camera, store) {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.disable(gl.BLEND);
    gl.depthMask(true);
    gl.disable(gl.DEPTH_TEST);
    this.#drawWater();
    gl.enable(gl.DEPTH_TEST);
    this.#drawSurfaces(camera, store, false);
    const ping = store.get("shown");
    if (camera.mode === "top") gl.clear(gl.DEPTH_BUFFER_BIT);  // The vehicle is seen through what is above it.
    if (ping) this.#drawVehicle(camera, ping.vehicle ?? ping.pose);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    this.#drawPoints(camera);
    if (store.get("showPaths")) this.#drawPaths(camera, store);
    const sonar = store.get("sonar");
    if (ping && sonar && ping.beams === sonar.beams && ping.bins === sonar.bins) this.#drawSonar(camera, store, sonar, ping);
    gl.depthMask(true);
    gl.bindVertexArray(null);
  }

  /** Index of the object under a pixel of the canvas, or -1. */
  pick(camera, store, x, y) {
    const { gl } = this;
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
    gl.depthMask(true);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.#drawSurfaces(camera, store, true);
    const pixel = new Uint8Array(4);
    gl.readPixels(x, this.canvas.height - 1 - y, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    this.draw(camera, store);
    return pixel[0] + 256 * pixel[1] + 65536 * pixel[2] - 1;
  }

  #use(name, camera, object = kIdentity) {
    const { gl } = this;
    const { program, at } = this.programs[name];
    gl.useProgram(program);
    gl.uniformMatrix4fv(at.camera, false, camera.matrix);
    gl.uniformMatrix4fv(at.object, false, object);
    return at;
  }

  #drawWater() {
    const { gl } = this;
    const { program, at } = this.programs.water;
    gl.useProgram(program);
    gl.uniform3f(at.near_colour, ...rgbOf("--scene-near"));
    gl.uniform3f(at.fog_colour, ...rgbOf("--scene-far"));
    gl.bindVertexArray(null);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  #setFog(at, camera) {
    const { gl } = this;
    gl.uniform3f(at.eye, ...camera.eye);
    gl.uniform3f(at.fog_colour, ...rgbOf("--scene-far"));
    gl.uniform1f(at.fog_length, 1.3 * (camera.distance + 1.2 * camera.reach));
  }

  #drawSurfaces(camera, store, asIds) {
    const { gl } = this;
    const at = this.#use("surface", camera);
    this.#setFog(at, camera);
    const chosen = store.get("object");
    this.uploaded.forEach(({ object, mesh }, index) => {
      const code = index + 1;
      if (asIds) gl.uniform4f(at.id, (code & 255) / 255, ((code >> 8) & 255) / 255, ((code >> 16) & 255) / 255, 1);
      else gl.uniform4f(at.id, 0, 0, 0, 0);
      gl.uniform1f(at.glow, index === chosen ? 0.45 : 0);
      gl.uniform3f(at.tint, ...object.colour);
      gl.uniformMatrix4fv(at.object, false, object.matrix);
      gl.bindVertexArray(mesh.array);
      gl.drawElements(gl.TRIANGLES, mesh.count, gl.UNSIGNED_INT, 0);
    });
  }

  #drawVehicle(camera, pose) {
    const { gl } = this;
    const size = Math.max(1, norm(subtract(camera.eye, pose.position)) / 14);  // It can be seen from afar.
    const at = this.#use("surface", camera, poseMatrix(pose, size));
    this.#setFog(at, camera);
    gl.uniform4f(at.id, 0, 0, 0, 0);
    gl.uniform1f(at.glow, 0);
    for (const { colour, list } of this.vehicle) {
      gl.uniform3f(at.tint, ...colour);
      list.draw(gl.TRIANGLES);
    }
  }

  // As large as they can be seen in the whole of the sonar's reach.
  #drawPoints(camera) {
    const { gl, lists } = this;
    this.#once("points", this.scene?.points.length > 0 && this.scene, ({ points }) => lists.points.fill(crossLines(points, Math.max(0.15, camera.reach / 60))));
    if (!this.scene?.points.length) return;
    gl.uniform4f(this.#use("line", camera).tint, ...kPoint);
    lists.points.draw(gl.LINES);
  }

  #drawPaths(camera, store) {
    const { gl, lists } = this;
    const at = this.#use("line", camera);
    this.#once("trajectory", store.get("hello")?.trajectory, (points) => lists.trajectory.fill(new Float32Array(points.flat())));
    this.#once("flown", store.get("path"), (points) => lists.flown.fill(new Float32Array(points.flat())));
    gl.uniform4f(at.tint, ...kTrajectory);
    lists.trajectory.draw(gl.LINE_STRIP);
    gl.uniform4f(at.tint, ...kFlown);
    lists.flown.draw(gl.LINE_STRIP);
  }

  #drawSonar(camera, store, sonar, ping) {
    const { gl, lists } = this;
    const matrix = poseMatrix(sonar.product.pose(ping));
    if (store.get("showSector")) {
      this.#once("sector", sonar, () => {
        const { lines, faces } = sectorShape(sonar);
        lists.sector.fill(lines);
        lists.face.fill(faces);
      });
      const at = this.#use("line", camera, matrix);
      gl.uniform4f(at.tint, ...kFace);
      lists.face.draw(gl.TRIANGLES);
      gl.uniform4f(at.tint, ...kSector);
      lists.sector.draw(gl.LINES);
    }
    this.map.fill(256, 1, colourTable(store.get("map")));
    this.map.bind(1);
    if (store.get("showFan")) this.#drawFan(camera, store, sonar, ping, matrix);
    if (store.get("showEchoes")) this.#drawEchoes(camera, store, sonar, ping, matrix);
  }

  #drawFan(camera, store, sonar, ping, matrix) {
    const { gl, lists } = this;
    const { levels, bins, group } = poolBins(ping.tables.level, ping.beams, ping.bins, gl.getParameter(gl.MAX_TEXTURE_SIZE));
    this.#once("fan", sonar, () => lists.fan.fill(fanShape({ ...sonar, bins })));
    this.#once("levels", ping, () => this.levels.fill(ping.beams, bins, levels));
    this.levels.bind(0);
    this.map.bind(1);
    const at = this.#use("fan", camera, matrix);
    gl.uniform1i(at.levels, 0);
    gl.uniform1i(at.colour_map, 1);
    setLevelUniforms(gl, at, store, sonar.min_range, sonar.binLength * group);
    gl.disable(gl.DEPTH_TEST);
    lists.fan.draw(gl.TRIANGLES);
    gl.enable(gl.DEPTH_TEST);
  }

  #drawEchoes(camera, store, sonar, ping, matrix) {
    const { gl, lists } = this;
    const contrast = ["low", "high", "gain", "tvg"].map((name) => store.get(name)).join();
    if (this.of.echoes !== ping || this.of.contrast !== contrast) {
      Object.assign(this.of, { echoes: ping, contrast });
      const { points, count } = echoPoints(sonar, ping, store);
      lists.echoes.fill(points, count);
    }
    const at = this.#use("echo", camera, matrix);
    gl.uniform1i(at.colour_map, 1);
    gl.uniform1f(at.length_of_cell, Math.max(sonar.binLength, sonar.max_range / 400));
    gl.uniform1f(at.pixels, 1.6 * this.canvas.height);
    gl.disable(gl.DEPTH_TEST);  // They lie on the surfaces they came from.
    lists.echoes.draw(gl.POINTS);
    gl.enable(gl.DEPTH_TEST);
  }

  #once(name, value, upload) {
    if (this.of[name] === value || !value) return;
    this.of[name] = value;
    upload(value);
  }
}

function rgbOf(name) {
  const colour = themeColour(name);
  return [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16) / 255);
}
