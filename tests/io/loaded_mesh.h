// loaded_mesh.h -- loads a mesh file and its log messages for tests.

#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "io/mesh/mesh_file.h"
#include "scene/mesh_checks.h"

namespace insonify {

/// Rounding error of sums and products of a few floats.
inline constexpr double kFloat = 1e-5;

/// A mesh and the messages logged about its file, whose folder is left out.
struct Loaded {
  Mesh mesh;
  std::vector<std::string> notes;
};

inline Loaded load(const std::filesystem::path& path, const Submesh& submesh = {}) {
  Loaded loaded;
  loaded.mesh = load_mesh_file(path, submesh, [&](Severity severity, std::string note) {
    EXPECT_TRUE(note.starts_with(path.string() + ": ")) << note;
    note.replace(0, path.string().size(), path.filename().string());
    loaded.notes.push_back((severity == Severity::kWarning ? "warning: " : "info: ") + note);
  });
  return loaded;
}

inline void expect_bounds(const Mesh& mesh, const Vec3& low, const Vec3& high) {
  const Box3 box = bounds_of(mesh);
  EXPECT_LT((box.low - low).cwiseAbs().maxCoeff(), kFloat) << box.low.transpose();
  EXPECT_LT((box.high - high).cwiseAbs().maxCoeff(), kFloat) << box.high.transpose();
}

}  // namespace insonify
