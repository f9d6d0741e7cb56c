// decode.js -- the server's binary messages (docs/design/viewer.md) as typed arrays.

import { radians } from "../geometry.js";

const kPing = 1;
const kScene = 2;
const kMoved = 3;
const kArrays = { uint8: Uint8Array, uint16: Uint16Array, int32: Int32Array, uint32: Uint32Array, float32: Float32Array };

/** { kind: "ping" | "scene" | "moved", ... }; throws a readable Error on anything else. */
export function decode(buffer) {
  if (buffer.byteLength < 8) throw new Error(`A message of ${buffer.byteLength} bytes is shorter than its own header.`);
  const [kind, length] = new Uint32Array(buffer, 0, 2);
  if (8 + length > buffer.byteLength) throw new Error(`A header of ${length} bytes does not fit its message.`);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8, length)));
  const start = 8 + length;
  if (kind === kPing) return decodePing(header, buffer, start);
  if (kind === kScene) return decodeScene(header, buffer, start);
  if (kind === kMoved) return { kind: "moved", objects: header.objects };
  throw new Error(`Messages of kind ${kind} are not known here.`);
}

function decodePing(header, buffer, start) {
  const cells = header.beams * header.bins;
  const perBeam = ["sounding_range", "detection"];
  const tables = {};
  for (const { name, type, offset } of header.tables) {
    if (!(type in kArrays)) throw new Error(`Table ${name} has an unknown type, ${type}.`);
    tables[name] = new kArrays[type](buffer, start + offset, perBeam.includes(name) ? header.beams : cells);
  }
  if (!tables.level) throw new Error("A ping without levels.");
  return {
    kind: "ping",
    ...header,
    headAngle: radians(header.head_angle ?? 0),
    pose: { position: header.position, orientation: header.orientation },
    tables,
  };
}

function decodeScene(header, buffer, start) {
  const objects = header.objects.map((object) => ({
    ...object,
    vertices: new Float32Array(buffer, start + object.vertices.offset, 3 * object.vertices.count),
    triangles: new Uint32Array(buffer, start + object.triangles.offset, 3 * object.triangles.count),
    shape: `${object.vertices.offset}:${object.triangles.offset}`,  // Objects of one shape share it.
  }));
  return { kind: "scene", objects, sonars: header.sonars, points: header.points ?? [], note: header.note ?? "" };
}

/** Level of a value of the table `level` [dB]; null: no echo. */
export const levelDb = (value) => (value === 0 ? null : value / 100 - 400);
