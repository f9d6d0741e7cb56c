// gpu_plan.cpp -- packs a plan's numbers and tables into one buffer.

#include "echo/gpu/gpu_plan.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "echo/gpu/packer.h"
#include "echo/laws/laws.h"
#include "echo/model/left_out.h"

namespace insonify {
namespace {

static_assert(shader::kAngleSteps == AngleTable::kSteps && shader::kReflectance == ScatterTable::kReflectance &&
              shader::kBackscatter == ScatterTable::kBackscatter && shader::kDiffuse == ScatterTable::kDiffuse &&
              shader::kMirrored == ScatterTable::kMirrored && shader::kAngleStride == ScatterTable::kAngleStride);

// Least loss that the scale of a bin makes up for: of an intensity that is less nothing is left in single precision.
constexpr double kLeastLoss = 1e-36;

shader::PlanTables numbers_of(const FlatPlan& plan) {
  const Logistic sigmoid = plan.shape.terms();
  return {.columns = static_cast<std::uint32_t>(plan.lattice.columns),
          .rows = static_cast<std::uint32_t>(plan.lattice.rows),
          .columns_per_beam = static_cast<std::uint32_t>(plan.lattice.columns_per_beam),
          .beams = static_cast<std::uint32_t>(plan.beam_count),
          .bins = static_cast<std::uint32_t>(plan.bin_count),
          .cone = plan.lattice.shape == BeamShape::kCone ? 1U : 0U,
          .calibrated = plan.model == EchoModel::kCalibrated ? 1U : 0U,
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
          .stagger = plan.stagger,
          .max_surfaces = static_cast<std::uint32_t>(plan.max_surfaces)};
}

// What only the calibrated model has.
void set_calibrated(const FlatPlan& plan, shader::PlanTables& tables) {
  tables.materials = plan.scatter.laws().nothing;
  tables.on_top = plan.scatter.laws().on_top ? 1 : 0;
  tables.rough_mirrors = plan.rough_mirrors ? 1 : 0;
  tables.has_facets = plan.has_facets() ? 1 : 0;
  tables.two_way = plan.two_way ? 1 : 0;
  tables.sends_apart = plan.sends_apart ? 1 : 0;
  tables.selective = plan.secondary == SecondaryEchoes::kSelective ? 1 : 0;
  tables.thin_per_metre = thin_per_metre(plan);
  tables.wavelength = plan.wavelength();
  tables.tan_low = plan.tan_low;
  tables.tan_high = plan.tan_high;
  tables.transmitter_length = static_cast<float>(plan.transmitter.length());
  tables.sent_low = static_cast<float>(plan.sent_axis.low);
  tables.sent_steps = static_cast<float>(plan.sent_axis.steps_per_radian);
  tables.received_low = static_cast<float>(plan.received_axis.low);
  tables.received_steps = static_cast<float>(plan.received_axis.steps_per_radian);
  tables.sent_count = static_cast<std::uint32_t>(plan.sent_across.size());
  tables.received_count = static_cast<std::uint32_t>(plan.received_across.size());
}

void add_materials(const ScatterTable& scatter, Packer& packer, shader::PlanTables& tables) {
  const ScatterTable::Laws laws = scatter.laws();
  const std::size_t count = laws.nothing + std::size_t{1};
  std::vector<float> roughness(count, 0.0F);
  for (std::uint32_t material = 0; material < laws.nothing; ++material) {
    roughness[material] =
        static_cast<float>(scatter.scattering(surface_label(0, static_cast<std::uint16_t>(material))).roughness);
  }
  tables.lambert = packer.add(std::span(laws.lambert, count));
  tables.lobe = packer.add(std::span(laws.lobe, count));
  tables.steepness = packer.add(std::span(laws.steepness, count));
  tables.roughness = packer.add(roughness);
  tables.mirrored = packer.add(std::span(laws.mirrored, count));
  tables.facets = packer.add(std::span(laws.facets, count));
  tables.facet_roughness = packer.add(std::span(laws.roughness, laws.nothing));
  if (laws.by_angle != nullptr) {  // Else the address is 0.
    tables.by_angle = packer.add(std::span(laws.by_angle, count * ScatterTable::kAngleStride));
  }
  if (laws.passed != nullptr) {
    tables.passed = packer.add(std::span(laws.passed, count * ScatterTable::kAngleNodes));
  }
}

// full_energy_scale() of each set of rows.
std::vector<float> full_shares(const Lattice& lattice) {
  std::vector<float> scales;
  for (std::size_t first = 0; first < lattice.share.size(); first += static_cast<std::size_t>(lattice.rows)) {
    scales.push_back(full_energy_scale(*std::max_element(&lattice.share[first], &lattice.share[first] + lattice.rows)));
  }
  return scales;
}

// Writes PlanTables and the tables as they will be on the device from the address `start` on.
void pack(const FlatPlan& plan, shader::address start, std::vector<std::byte>& bytes) {
  bytes.resize(sizeof(shader::PlanTables));
  Packer packer(start, bytes);
  const Lattice& lattice = plan.lattice;
  shader::PlanTables tables = numbers_of(plan);
  if (plan.model == EchoModel::kCalibrated) {
    set_calibrated(plan, tables);
    add_materials(plan.scatter, packer, tables);
    tables.sent_across = packer.add(plan.sent_across);
    tables.received_across = packer.add(plan.received_across);
    tables.transmitted = packer.add(lattice.transmitted);
    tables.row_pattern = packer.add(lattice.row_pattern);
    tables.reciprocal = packer.add(lattice.reciprocal);
    tables.full_share = packer.add(full_shares(lattice));
  }
  tables.bin_scale = packer.add(bin_scales(plan));
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

std::vector<float> bin_scales(const FlatPlan& plan) {
  std::vector<float> scales(static_cast<std::size_t>(plan.bin_count), 1.0F);
  if (plan.model == EchoModel::kCalibrated) {
    for (std::size_t bin = 0; bin < scales.size(); ++bin) {
      const double range = double{plan.first_bin_at} + (static_cast<double>(bin) + 0.5) / double{plan.bins_per_metre};
      const double loss = precise::two_way_loss(double{plan.neper_per_metre}, range);
      scales[bin] = static_cast<float>(1 / std::max(loss, kLeastLoss));
    }
  }
  return scales;
}

void GpuPlan::set(gpu::Device& device, const FlatPlan& plan) {
  pack(plan, 0, bytes_);
  if (bytes_ == before_) {
    return;
  }
  before_ = bytes_;
  std::byte* const to = buffer_.refill(device, bytes_.size());
  pack(plan, buffer_.address(), bytes_);
  std::memcpy(to, bytes_.data(), bytes_.size());
}

}  // namespace insonify
