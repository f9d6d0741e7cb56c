// shape.cpp -- putting parts together.

#include "kit/shape.h"

#include <algorithm>

namespace {

// Index of a material in the whole, added when new.
std::uint16_t slot_of(std::vector<std::string>& materials, const std::string& name) {
  const auto found = std::ranges::find(materials, name);
  const auto slot = static_cast<std::uint16_t>(found - materials.begin());
  if (found == materials.end()) {
    materials.push_back(name);
  }
  return slot;
}

Shape mirrored(const Shape& part) {
  Shape image = part;
  for (Vec3& vertex : image.vertices) {
    vertex.y() = -vertex.y();
  }
  for (Shape::Face& face : image.faces) {
    std::swap(face.corners[1], face.corners[2]);  // A mirror turns the winding round.
  }
  return image;
}

}  // namespace

std::uint32_t Shape::add_vertex(const Vec3& position) {
  vertices.push_back(position);
  return static_cast<std::uint32_t>(vertices.size() - 1);
}

void Shape::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint16_t material) {
  faces.push_back({{a, b, c}, material});
}

void Shape::add_quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, std::uint16_t material) {
  add_triangle(a, b, c, material);
  add_triangle(a, c, d, material);
}

void Shape::add(const Shape& part, const Pose& whole_from_part) {
  const auto start = static_cast<std::uint32_t>(vertices.size());
  for (const Vec3& vertex : part.vertices) {
    vertices.push_back(whole_from_part * vertex);
  }
  std::vector<std::uint16_t> slots;
  for (const std::string& name : part.materials) {
    slots.push_back(slot_of(materials, name));
  }
  for (const Face& face : part.faces) {
    const auto [a, b, c] = face.corners;
    add_triangle(start + a, start + b, start + c, slots[face.material]);
  }
}

void Shape::add_both_sides(const Shape& part) {
  add(part);
  add(mirrored(part));
}

void Shape::deform(const std::function<Vec3(const Vec3&)>& moved) {
  std::ranges::transform(vertices, vertices.begin(), moved);
}

Shape placed(const Shape& shape, const Pose& pose) {
  Shape moved = shape;
  moved.deform([&](const Vec3& vertex) { return pose * vertex; });
  return moved;
}

Pose at(const Vec3& position, double roll_deg, double pitch_deg, double yaw_deg) {
  using insonify::radians_from_degrees;
  const Eigen::Quaterniond turn = Eigen::AngleAxisd(radians_from_degrees(yaw_deg), Vec3::UnitZ()) *
                                  Eigen::AngleAxisd(radians_from_degrees(pitch_deg), Vec3::UnitY()) *
                                  Eigen::AngleAxisd(radians_from_degrees(roll_deg), Vec3::UnitX());
  return {position, turn};
}
