// level_shader.js -- GLSL that all pictures of levels share: from a cell to its place between the darkest and the brightest
// colour, and to that colour.

export const kLevelGlsl = `
uniform highp usampler2D levels;   // 0: no echo; otherwise level = value / 100 - 400 dB
uniform sampler2D colour_map;
uniform float low, high;           // levels of the darkest and the brightest colour [dB]
uniform float gain, tvg;           // gain of the display [dB] and X of its X log10(range / 1 m)
uniform float min_range, bin_length;

// Gain of the display at a range [dB].
float gain_at(float range) {
  return gain + (tvg == 0.0 ? 0.0 : tvg * 0.4342944819 * log(max(range, 0.01)));
}

float brightness(uint value, float gain_here) {
  if (value == 0u) return 0.0;
  return clamp((float(value) * 0.01 - 400.0 + gain_here - low) / (high - low), 0.0, 1.0);
}

vec3 colour_of(float value) {
  float place = value * 255.0;
  int below = int(place);
  return mix(texelFetch(colour_map, ivec2(below, 0), 0).rgb, texelFetch(colour_map, ivec2(min(below + 1, 255), 0), 0).rgb,
             fract(place));
}
`;

/** Sets the uniforms of kLevelGlsl from the store. */
export function setLevelUniforms(gl, at, store, minRange, binLength) {
  const low = store.get("low");
  gl.uniform1f(at.low, low);
  gl.uniform1f(at.high, Math.max(store.get("high"), low + 0.1));
  gl.uniform1f(at.gain, store.get("gain"));
  gl.uniform1f(at.tvg, store.get("tvg"));
  gl.uniform1f(at.min_range, minRange);
  gl.uniform1f(at.bin_length, binLength);
}
