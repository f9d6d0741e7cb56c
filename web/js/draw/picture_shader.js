// picture_shader.js -- GLSL of fan, polar and round picture: from a point of the plane to beam and bin, and its colour.

import { kLevelGlsl } from "./level_shader.js";

export const kPictureVertex = `#version 300 es
uniform vec4 view;  // plane = view.xy + clip * view.zw
out vec2 plane;
void main() {
  vec2 clip = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  plane = view.xy + clip * view.zw;
  gl_Position = vec4(clip, 0, 1);
}`;

export const kPictureFragment = `#version 300 es
precision highp float;
precision highp int;
${kLevelGlsl}
const float kPi = 3.14159265358979;
const int kFan = 0, kPolar = 1, kRound = 2;
const int kLabels = 1, kElevation = 2, kShadow = 3, kMultipath = 4;
uniform int mode;
uniform bool smooth_cells;
uniform sampler2D beam_table;    // beam, with its fraction, by azimuth
uniform sampler2D ages;          // of each column of the round picture, 0 new to 1 old; below 0 empty
uniform sampler2D overlay_values;
uniform sampler2D palette;
uniform vec2 azimuths;           // port and starboard edge of the fan [rad]
uniform float up;                // azimuth that is drawn upwards [rad]
uniform float sign_ahead;        // -1 where the fan looks down
uniform ivec2 size;              // beams, bins
uniform int overlay;
uniform float elevation_half;    // elevation of the strongest colours [rad]
in vec2 plane;                   // fan, round: metres to the right and upwards; polar: beam and range
out vec4 colour;

float beam_of(float azimuth) {
  if (mode == kRound) return fract(0.5 - azimuth / (2.0 * kPi)) * float(size.x);
  float place = (azimuths.x - azimuth) / (azimuths.x - azimuths.y) * float(textureSize(beam_table, 0).x - 1);
  if (place < 0.0 || place > float(textureSize(beam_table, 0).x - 1)) return -1.0;
  int below = int(place);
  float here = texelFetch(beam_table, ivec2(below, 0), 0).r;
  float next = texelFetch(beam_table, ivec2(min(below + 1, textureSize(beam_table, 0).x - 1), 0), 0).r;
  if (min(here, next) < 0.0) return fract(place) < 0.5 ? here : next;  // At the edge of a gap between beams.
  return mix(here, next, fract(place));
}

uint at(int column, int bin) {
  return texelFetch(levels, ivec2(column, clamp(bin, 0, size.y - 1)), 0).r;
}

// Where a pixel covers several bins, the strongest counts: no echo is lost between pixels.
float along(int beam, float bin, int covered, float gain_here) {
  int column = mode == kRound ? (beam + size.x) % size.x : clamp(beam, 0, size.x - 1);
  if (covered > 1) {
    uint strongest = 0u;
    int first = int(floor(bin)) - covered / 2;
    for (int i = 0; i < covered; ++i) strongest = max(strongest, at(column, first + i));
    return brightness(strongest, gain_here);
  }
  if (!smooth_cells) return brightness(at(column, int(floor(bin))), gain_here);
  float below = floor(bin - 0.5);
  return mix(brightness(at(column, int(below)), gain_here), brightness(at(column, int(below) + 1), gain_here),
             bin - 0.5 - below);
}

float shown(vec2 place, int covered, float gain_here) {
  if (!smooth_cells) return along(int(floor(place.x)), place.y, covered, gain_here);
  float below = floor(place.x - 0.5);
  return mix(along(int(below), place.y, covered, gain_here), along(int(below) + 1, place.y, covered, gain_here),
             place.x - 0.5 - below);
}

vec3 overlaid(float value, ivec2 cell) {
  float label = texelFetch(overlay_values, cell, 0).r;
  vec3 grey = vec3(0.85 * value);
  if (overlay == kLabels) {
    if (label < 0.0) return grey;
    return texelFetch(palette, ivec2(int(label) % 256, 0), 0).rgb * (0.16 + 0.98 * value);
  }
  if (overlay == kElevation) {
    if (label < -9.0) return grey * 0.5;
    float part = clamp(label / elevation_half, -1.0, 1.0);
    vec3 hue = part < 0.0 ? mix(vec3(0.95), vec3(0.10, 0.45, 1.0), -part) : mix(vec3(0.95), vec3(1.0, 0.33, 0.12), part);
    return hue * (0.16 + 0.98 * value);
  }
  if (overlay == kShadow) return label > 0.0 ? mix(grey, vec3(0.13, 0.42, 0.85), 0.15 + 0.65 * label / 255.0) : grey;
  if (label < 1.5) return grey;
  return (label < 2.5 ? vec3(0.1, 0.85, 1.0) : vec3(1.0, 0.25, 0.85)) * (0.22 + 0.9 * value);
}

void main() {
  float range = mode == kPolar ? plane.y : length(plane);
  float beam = mode == kPolar ? plane.x : beam_of(atan(-plane.x, sign_ahead * plane.y) + up);
  float bin = (range - min_range) / bin_length;
  float step_of_pixel = mode == kPolar ? abs(dFdy(plane.y)) : length(vec2(dFdx(plane.x), dFdy(plane.x)));
  if (beam < 0.0 || beam >= float(size.x) || bin < 0.0 || bin >= float(size.y)) discard;
  int covered = clamp(int(ceil(step_of_pixel / bin_length - 0.2)), 1, 24);
  float value = shown(vec2(beam, bin), covered, gain_at(range));
  ivec2 cell = ivec2(int(beam), int(bin));
  colour = vec4(overlay == 0 ? colour_of(value) : overlaid(value, cell), 1);
  if (mode == kRound) {
    float age = texelFetch(ages, ivec2(cell.x, 0), 0).r;
    colour = age < 0.0 ? vec4(0.11, 0.145, 0.175, 1) : vec4(colour.rgb * (1.0 - 0.45 * age), 1);
  }
}`;
