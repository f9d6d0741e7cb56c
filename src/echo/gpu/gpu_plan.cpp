// gpu_plan.cpp -- packs a plan's numbers and tables into one buffer.

#include "echo/gpu/gpu_plan.h"

#include <cstring>

namespace insonify {
namespace {

// Appends tables to bytes.
class Packer {
 public:
  explicit Packer(std::vector<std::byte>& bytes) : bytes_(bytes) {}

  /// @return Offset of the table.
  template <typename Value>
  shader::address add(const std::vector<Value>& table) {
    const std::size_t offset = bytes_.size(), size = table.size() * sizeof(Value);
    bytes_.resize(offset + size);
    if (size > 0) {
      std::memcpy(&bytes_[offset], table.data(), size);
    }
    return offset;
  }

 private:
  std::vector<std::byte>& bytes_;
};

shader::PlanTables numbers_of(const FlatPlan& plan) {
  const Logistic sigmoid = plan.shape.terms();
  return {.columns = static_cast<std::uint32_t>(plan.lattice.columns),
          .rows = static_cast<std::uint32_t>(plan.lattice.rows),
          .columns_per_beam = static_cast<std::uint32_t>(plan.lattice.columns_per_beam),
          .beams = static_cast<std::uint32_t>(plan.beam_count),
          .bins = static_cast<std::uint32_t>(plan.bin_count),
          .cone = plan.lattice.shape == BeamShape::kCone ? 1U : 0U,
          .shaped = plan.shape.model().sigmoid == Sigmoid::kNone ? 0U : 1U,
          .slope = sigmoid.slope,
          .midpoint = sigmoid.midpoint,
          .scale = sigmoid.scale,
          .offset = sigmoid.offset,
          .neper_per_metre = plan.neper_per_metre,
          .true_max_range = plan.true_max_range,
          .reach = plan.reach(),
          .bins_per_metre = plan.bins_per_metre,
          .first_bin_at = plan.first_bin_at,
          .middle_elevation = plan.middle_elevation,
          .beams_per_radian = plan.beams_per_radian,
          .stagger = plan.stagger};
}

// Calls visit(address) for each address of a table.
template <typename Visit>
void for_each_table(shader::PlanTables& tables, const Visit& visit) {
  for (shader::address* table :
       {&tables.cos_azimuth, &tables.sin_azimuth, &tables.azimuth, &tables.column_width, &tables.column_measure,
        &tables.row_set, &tables.touching, &tables.elevation, &tables.cos_t, &tables.sin_t, &tables.share,
        &tables.interval, &tables.edges, &tables.port_edges, &tables.starboard_edges}) {
    visit(*table);
  }
}

void pack(const FlatPlan& plan, std::vector<std::byte>& bytes) {
  bytes.resize(sizeof(shader::PlanTables));
  Packer packer(bytes);
  const Lattice& lattice = plan.lattice;
  shader::PlanTables tables = numbers_of(plan);
  tables.cos_azimuth = packer.add(lattice.cos_azimuth);
  tables.sin_azimuth = packer.add(lattice.sin_azimuth);
  tables.azimuth = packer.add(lattice.azimuth);
  tables.column_width = packer.add(lattice.column_width);
  tables.column_measure = packer.add(lattice.column_measure);
  tables.row_set = packer.add(lattice.row_set);
  tables.touching = packer.add(lattice.touching);
  tables.elevation = packer.add(lattice.elevation);
  tables.cos_t = packer.add(lattice.cos_t);
  tables.sin_t = packer.add(lattice.sin_t);
  tables.share = packer.add(lattice.share);
  tables.interval = packer.add(lattice.interval);
  tables.edges = packer.add(lattice.edges);
  tables.port_edges = packer.add(plan.port_edges);
  tables.starboard_edges = packer.add(plan.starboard_edges);
  std::memcpy(bytes.data(), &tables, sizeof(tables));
}

}  // namespace

void GpuPlan::set(gpu::Device& device, const FlatPlan& plan) {
  pack(plan, bytes_);
  if (bytes_ == before_) {
    return;
  }
  before_ = bytes_;
  std::byte* const to = buffer_.refill(device, bytes_.size());
  std::memcpy(to, bytes_.data(), bytes_.size());
  shader::PlanTables tables;
  std::memcpy(&tables, to, sizeof(tables));
  for_each_table(tables, [&](shader::address& table) { table += buffer_.address(); });
  std::memcpy(to, &tables, sizeof(tables));
}

}  // namespace insonify
