// scene_shaders.js -- GLSL of the 3-D view: surfaces, lines, echoes and the sonar picture in its plane.

import { kLevelGlsl } from "./level_shader.js";

const kHead = "#version 300 es\nprecision highp float;\nprecision highp int;\n";

const kFog = `
uniform vec3 eye, fog_colour;
uniform float fog_length;  // [m]
vec3 fogged(vec3 colour, vec3 world) {
  float part = distance(world, eye) / fog_length;
  return mix(fog_colour, colour, exp(-part * part));
}
`;

export const kWater = [`${kHead}
out float height;
void main() {
  vec2 clip = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  height = 0.5 + 0.5 * clip.y;
  gl_Position = vec4(clip, 0.999999, 1);
}`, `${kHead}
uniform vec3 near_colour, fog_colour;
in float height;
out vec4 colour;
void main() { colour = vec4(mix(fog_colour, near_colour, smoothstep(0.45, 1.0, height)), 1); }`];

export const kSurface = [`${kHead}
layout(location = 0) in vec3 position;
uniform mat4 camera, object;
out vec3 world;
void main() {
  world = (object * vec4(position, 1)).xyz;
  gl_Position = camera * vec4(world, 1);
}`, `${kHead}${kFog}
uniform vec3 tint;
uniform vec4 id;        // with alpha 1: drawn to find what lies under the mouse
uniform float glow;     // of the chosen object
in vec3 world;
out vec4 colour;
void main() {
  if (id.a > 0.5) { colour = id; return; }
  vec3 normal = normalize(cross(dFdx(world), dFdy(world)));
  vec3 to_eye = normalize(eye - world);
  if (dot(normal, to_eye) < 0.0) normal = -normal;
  float light = 0.30 + 0.30 * (0.5 + 0.5 * normal.z) + 0.48 * max(dot(normal, to_eye), 0.0);
  vec3 lit = tint * light;
  lit = mix(lit, vec3(1.0, 0.62, 0.12) * (0.35 + 0.75 * light), glow);
  colour = vec4(fogged(lit, world), 1);
}`];

export const kLine = [`${kHead}
layout(location = 0) in vec3 position;
uniform mat4 camera, object;
out vec3 world;
void main() {
  world = (object * vec4(position, 1)).xyz;
  gl_Position = camera * vec4(world, 1);
}`, `${kHead}
uniform vec4 tint;
in vec3 world;
out vec4 colour;
void main() { colour = vec4(tint.rgb * tint.a, tint.a); }`];

export const kEcho = [`${kHead}
layout(location = 0) in vec4 echo;  // place in the sonar's frame [m], brightness
uniform mat4 camera, object;
uniform float pixels;               // diameter of a point of 1 m at a distance of 1 m
uniform float length_of_cell;       // [m]
out float value;
void main() {
  value = echo.w;
  gl_Position = camera * object * vec4(echo.xyz, 1);
  gl_PointSize = clamp(pixels * length_of_cell / gl_Position.w, 1.5, 7.0);
}`, `${kHead}
uniform sampler2D colour_map;
in float value;
out vec4 colour;
void main() {
  vec3 tint = texelFetch(colour_map, ivec2(int(value * 255.0), 0), 0).rgb;
  float alpha = 0.35 + 0.65 * value;
  colour = vec4(tint * alpha, alpha);
}`];

export const kFan = [`${kHead}
layout(location = 0) in vec4 corner;  // x, y in the sonar's frame [m], beam, bin
uniform mat4 camera, object;
out vec2 place;
void main() {
  place = corner.zw;
  gl_Position = camera * object * vec4(corner.xy, 0, 1);
}`, `${kHead}${kLevelGlsl}
in vec2 place;
out vec4 colour;
void main() {
  ivec2 size = textureSize(levels, 0);
  ivec2 cell = clamp(ivec2(place), ivec2(0), size - 1);
  float value = brightness(texelFetch(levels, cell, 0).r, gain_at(min_range + (float(cell.y) + 0.5) * bin_length));
  float alpha = 0.25 + 0.75 * value;
  colour = vec4(colour_of(value) * alpha, alpha);
}`];
