// meshes.js -- vertex arrays of the 3-D view.

/** Meshes by shape; objects of the same shape share theirs. */
export function uploadScene(gl, scene) {
  const shapes = new Map();
  return scene.objects.map((object) => {
    if (!shapes.has(object.shape)) shapes.set(object.shape, indexedMesh(gl, object.vertices, object.triangles));
    return { object, mesh: shapes.get(object.shape) };
  });
}

export function deleteScene(gl, uploaded) {
  for (const mesh of new Set(uploaded.map((entry) => entry.mesh))) {
    mesh.buffers.forEach((buffer) => gl.deleteBuffer(buffer));
    gl.deleteVertexArray(mesh.array);
  }
}

function indexedMesh(gl, vertices, triangles) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  const buffers = [gl.createBuffer(), gl.createBuffer()];
  gl.bindBuffer(gl.ARRAY_BUFFER, buffers[0]);
  gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.STATIC_DRAW);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers[1]);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
  gl.bindVertexArray(null);
  return { array, buffers, count: triangles.length };
}

/** A list of vertices with `parts` numbers each, which may change with every ping. */
export class Vertices {
  constructor(gl, parts) {
    this.gl = gl;
    this.parts = parts;
    this.array = gl.createVertexArray();
    this.buffer = gl.createBuffer();
    this.count = 0;
    gl.bindVertexArray(this.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, parts, gl.FLOAT, false, 0, 0);
    gl.bindVertexArray(null);
  }

  fill(numbers, count = numbers.length / this.parts) {
    const { gl } = this;
    this.count = count;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, numbers.subarray(0, count * this.parts), gl.DYNAMIC_DRAW);
  }

  draw(primitive) {
    if (this.count === 0) return;
    this.gl.bindVertexArray(this.array);
    this.gl.drawArrays(primitive, 0, this.count);
  }
}
