// find_glinting_faces.cpp -- collects the plane faces of a scene that reflect coherently.

#include <algorithm>
#include <cmath>

#include "echo/mirror/faces.h"
#include "echo/targets/face_glints.h"
#include "scene/alike.h"

namespace insonify {
namespace {

bool is_thin(const LeftOut& left_out, std::size_t instance, std::uint32_t triangle) {
  return instance < left_out.thickness.size() && left_out.thickness[instance] != nullptr &&
         std::isfinite((*left_out.thickness[instance])[triangle]);
}

void add_face(const Mesh& mesh, const MeshFaces& faces, std::uint32_t index, SurfaceLabel surface,
              GlintingFaces::Group& group) {
  const Face& face = faces.faces[index];
  const Vec3f middle = mesh.vertices[face.corner] + face.middle[0] * face.axes[0] + face.middle[1] * face.axes[1];
  group.middle_x.push_back(middle.x());
  group.middle_y.push_back(middle.y());
  group.middle_z.push_back(middle.z());
  group.first_x.push_back(face.axes[0].x());
  group.first_y.push_back(face.axes[0].y());
  group.first_z.push_back(face.axes[0].z());
  group.second_x.push_back(face.axes[1].x());
  group.second_y.push_back(face.axes[1].y());
  group.second_z.push_back(face.axes[1].z());
  group.first_half.push_back(face.half[0]);
  group.second_half.push_back(face.half[1]);
  group.surface.push_back(surface);
  group.face.push_back(index);
  group.covered.push_back(0);
}

// Adds the coherent faces of an instance to its group. Returns which of its triangles are of such faces.
LeftOut::ByTriangle<std::uint8_t> add_faces(const Scene& scene, std::size_t index, const MeshFaces& faces,
                                            const LeftOut& left_out, GlintingFaces::Group& group) {
  const Instance& instance = scene.instances[index];
  const Mesh& mesh = *instance.mesh;
  std::vector<std::uint8_t> taken(faces.faces.size(), 0);
  std::vector<std::uint8_t> glinting(mesh.triangles.size(), 0);
  for (std::uint32_t t = 0; t < faces.face_of.size(); ++t) {
    const std::uint32_t face = faces.face_of[t];
    const std::size_t slot = mesh.slot_of(t);
    if (face == MeshFaces::kNone || !reflects_coherently(scene, instance, slot) || is_thin(left_out, index, t)) {
      continue;
    }
    glinting[t] = 1;
    if (taken[face] == 0 && faces.faces[face].width() >= GlintingFaces::kLeastWidth) {
      taken[face] = 1;
      add_face(mesh, faces, face, surface_label(static_cast<std::uint16_t>(index), instance.materials[slot]), group);
    }
  }
  return group.surface.empty() ? nullptr : std::make_shared<const std::vector<std::uint8_t>>(std::move(glinting));
}

bool same_thickness(const LeftOut& left_out, std::size_t one, std::size_t other) {
  return left_out.thickness.empty() || left_out.thickness[one] == left_out.thickness[other];
}

}  // namespace

bool reflects_coherently(const Scene& scene, const Instance& instance, std::size_t slot) {
  const bool has_relief = slot < instance.reliefs.size() && instance.reliefs[slot] != nullptr;
  return !has_relief && scene.materials[instance.materials[slot]].rms_height > 0;
}

const GlintingFaces::Group* GlintingFaces::group_of(std::size_t instance) const {
  const auto found = std::ranges::lower_bound(groups, static_cast<int>(instance), {}, &Group::instance);
  return found == groups.end() || found->instance != static_cast<int>(instance) ? nullptr : &*found;
}

GlintingFaces find_glinting_faces(const Scene& scene, LeftOut& left_out, Workers& workers) {
  GlintingFaces found;
  found.of_mesh.resize(scene.instances.size());
  left_out.glinting.assign(scene.instances.size(), {});
  const std::vector<std::size_t> first = first_alike(scene);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    bool any = false;
    for (std::size_t slot = 0; slot < instance.materials.size(); ++slot) {
      any |= reflects_coherently(scene, instance, slot);
    }
    if (!instance.present || instance.endless || !any) {
      continue;
    }
    found.of_mesh[i] = shared_faces(instance.mesh, workers);
    GlintingFaces::Group group;
    if (first[i] == i || !same_thickness(left_out, i, first[i])) {
      left_out.glinting[i] = add_faces(scene, i, *found.of_mesh[i], left_out, group);
    } else if (const GlintingFaces::Group* const alike = found.group_of(first[i])) {
      left_out.glinting[i] = left_out.glinting[first[i]];
      group = *alike;
      for (SurfaceLabel& surface : group.surface) {
        surface = surface_label(static_cast<std::uint16_t>(i), material_of(surface));
      }
    }
    if (!group.surface.empty()) {
      group.instance = static_cast<int>(i);
      group.first_number = found.count();
      found.groups.push_back(std::move(group));
    }
  }
  return found;
}

}  // namespace insonify
