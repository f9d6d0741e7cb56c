// ping_tables.h -- the tables of a ping, each named once.

#pragma once

#include "insonify/ping.h"

namespace insonify::python {

/// Type of the values of a table: ValueOf<decltype(&Ping::intensity)> is float.
template <typename Member>
struct ValueOfMember;
template <typename Value>
struct ValueOfMember<std::vector<Value> Ping::*> {
  using type = Value;
};
template <typename Member>
using ValueOf = typename ValueOfMember<Member>::type;

/// Calls visit(name, member of Ping, help) for every table.
template <typename Visit>
void visit_tables(Visit&& visit) {
  visit("intensity", &Ping::intensity,
        "Echo intensity, float32: relative to the source's at 1 m, raw and linear (from about 1e-20: see to_db()); 0 "
        "to 1 in the paper model.");
  visit("field", &Ping::field, "Complex field, complex64, whose squared magnitude is the intensity.");
  visit("counts", &Ping::counts, "Counts of the instrument, uint16.");
  visit("phase", &Ping::phase,
        "Phase between the halves of a multibeam's receive array [rad], float32: positive for echoes to port of the "
        "beam's axis. Not recorded.");
  visit("instance", &Ping::instance,
        "Index into Simulator.instance_names of the strongest echo, uint16; NO_LABEL: no echo.");
  visit("material", &Ping::material, "Index into Simulator.material_names of its material, uint16.");
  visit("elevation", &Ping::elevation,
        "Its mean elevation in the sonar's frame, positive up [rad], float32; NaN: no echo.");
  visit("strongest_instance", &Ping::strongest_instance,
        "The strongest instances of each bin, strongest first, uint16 [bins, beams, k] (ground_truth full).");
  visit("strongest_share", &Ping::strongest_share, "Their shares of the bin's energy, 0 to 1, float32.");
  visit("elevation_spread", &Ping::elevation_spread,
        "Standard deviation of the strongest's elevations [rad], float32 (ground_truth full).");
  visit("path_order", &Ping::path_order,
        "Number of surfaces on the strongest paths, uint8; 0: no echo (ground_truth full).");
  visit("shadow", &Ping::shadow,
        "Share of the beam that nearer surfaces hide, 0 to 1, of bins without a direct echo (ground_truth full).");
  visit("direct_intensity", &Ping::direct_intensity,
        "Intensity of paths with one surface, without noise and speckle (ground_truth full).");
}

}  // namespace insonify::python
