// gl.js -- WebGL2: contexts, programs and textures.

/** The context of a canvas, with smooth edges where that is asked for; `redraw` is called when the graphics driver gives it back after it was lost. */
export function openGl(canvas, redraw, antialias = false) {
  const gl = canvas.getContext("webgl2", { antialias, premultipliedAlpha: true, powerPreference: "high-performance" });
  if (!gl) throw new Error("This browser has no WebGL2, which the pictures are drawn with.");
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
  canvas.addEventListener("webglcontextrestored", redraw);
  return gl;
}

let software = null;

/** Whether WebGL is computed by the processor, where smooth edges cost too much. */
export function isSoftware() {
  if (software !== null) return software;
  const gl = document.createElement("canvas").getContext("webgl2");
  const names = gl?.getExtension("WEBGL_debug_renderer_info");
  software = !names || /swiftshader|llvmpipe|software|basic render/i.test(gl.getParameter(names.UNMASKED_RENDERER_WEBGL));
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return software;
}

/** A program with its uniform locations by name. */
export function makeProgram(gl, vertexText, fragmentText) {
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertexText], [gl.FRAGMENT_SHADER, fragmentText]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
      throw new Error(`Shader: ${gl.getShaderInfoLog(shader)}`);
    }
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    throw new Error(`Shaders: ${gl.getProgramInfoLog(program)}`);
  }
  const at = {};
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) ?? 0;
  for (let i = 0; i < count; ++i) {
    const { name } = gl.getActiveUniform(program, i);
    at[name] = gl.getUniformLocation(program, name);
  }
  return { program, at };
}

const kFormats = {
  uint16: ["R16UI", "RED_INTEGER", "UNSIGNED_SHORT"],
  float32: ["R32F", "RED", "FLOAT"],
  rgba8: ["RGBA8", "RGBA", "UNSIGNED_BYTE"],
};

/** A table that shaders read by texelFetch; its storage is kept while its size stays. */
export class Table {
  constructor(gl, format) {
    this.gl = gl;
    this.format = kFormats[format];
    this.texture = gl.createTexture();
    this.width = 0;
    this.height = 0;
  }

  bind(unit) {
    this.gl.activeTexture(this.gl.TEXTURE0 + unit);
    this.gl.bindTexture(this.gl.TEXTURE_2D, this.texture);
  }

  /** Replaces the whole table. `data` may be null: zeros. */
  fill(width, height, data) {
    const { gl } = this;
    const [inner, format, type] = this.format;
    this.bind(0);
    if (width === this.width && height === this.height && data) {
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, gl[format], gl[type], data);
      return;
    }
    gl.texImage2D(gl.TEXTURE_2D, 0, gl[inner], width, height, 0, gl[format], gl[type], data);
    for (const [name, value] of [["MIN_FILTER", "NEAREST"], ["MAG_FILTER", "NEAREST"], ["WRAP_S", "CLAMP_TO_EDGE"], ["WRAP_T", "CLAMP_TO_EDGE"]]) {
      gl.texParameteri(gl.TEXTURE_2D, gl[`TEXTURE_${name}`], gl[value]);
    }
    [this.width, this.height] = [width, height];
  }

  /** Replaces a part of it. */
  write(x, y, width, height, data) {
    const { gl } = this;
    const [, format, type] = this.format;
    this.bind(0);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, x, y, width, height, gl[format], gl[type], data);
  }
}

/** Levels [bins][beams] whose bins fit a texture of `limit` rows: neighbouring bins become the strongest of them. */
export function poolBins(levels, beams, bins, limit) {
  const group = Math.ceil(bins / limit);
  if (group <= 1) return { levels, bins, group: 1 };
  const rows = Math.ceil(bins / group);
  const pooled = new Uint16Array(beams * rows);
  for (let bin = 0; bin < bins; ++bin) {
    const to = beams * Math.floor(bin / group);
    for (let b = 0; b < beams; ++b) pooled[to + b] = Math.max(pooled[to + b], levels[beams * bin + b]);
  }
  return { levels: pooled, bins: rows, group };
}
