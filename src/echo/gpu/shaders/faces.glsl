// faces.glsl -- edges of the plane face that reflects a ray, and the tilt that stands for diffraction at them: FaceEdges
// and FaceTilt of the host.

struct FaceEdges {
  vec3 axes[2];
  float low[2], high[2];
  bool finite;
};

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer PlaneFaces { PlaneFace at[]; };

// @param point  The hit, in the scene.
FaceEdges face_edges(PlacedMesh placed, uint triangle, vec3 point) {
  FaceEdges edges;
  edges.axes[0] = edges.axes[1] = vec3(0.0);
  edges.low[0] = edges.low[1] = -kFarEdge;
  edges.high[0] = edges.high[1] = kFarEdge;
  edges.finite = false;
  const uint index = placed.face_of == 0 ? 0xffffffffu : Uints(placed.face_of).at[triangle];
  if (index != 0xffffffffu) {
    const PlaneFace face = PlaneFaces(placed.faces).at[index];
    const vec3 from_corner = placed.mesh_from_scene * vec4(point, 1.0) - face.corner;
    edges.finite = true;
    for (int axis = 0; axis < 2; ++axis) {
      const float place = face.middle[axis] - dot(face.axes[axis], from_corner);
      edges.axes[axis] = mat3(placed.scene_from_mesh) * face.axes[axis];
      edges.low[axis] = place - face.half_length[axis];
      edges.high[axis] = place + face.half_length[axis];
    }
  }
  return edges;
}

vec3 face_tilt(FaceEdges face, uint column, uint row, uint seed, float wavelength, float incidence) {
  if (!face.finite) {
    return vec3(0.0);
  }
  const FacetSlopes slopes = facet_slopes(column, row, seed ^ kDiffractionSeed);
  const float cosine = max(abs(incidence), kLeastTiltCosine);
  return slopes.along * diffraction_slope(face.low[0], face.high[0], wavelength, cosine) * face.axes[0] +
         slopes.across * diffraction_slope(face.low[1], face.high[1], wavelength, cosine) * face.axes[1];
}

FaceSide side_of(FaceEdges face, int axis, vec3 direction, vec3 reflected, vec3 normal, float cosine, float slope) {
  FaceSide side = face_side_of_ray(0.0, 0.0, face.axes[axis], direction, reflected, normal, cosine, slope);
  side.low = face.low[axis];
  side.high = face.high[axis];
  return side;
}
