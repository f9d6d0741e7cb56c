// arrival.glsl -- where an echo arrives from and with which gains: FlatPlan::Arrival of the host.

struct Arrival {
  float bearing, elevation, sent, received, transmitted;
};

float look_up(address table, uint count, float low, float steps, float elevation) {
  if (count == 0) {
    return 1.0;
  }
  const float place = clamp((elevation - low) * steps, 0.0, float(count - 1));
  const uint node = min(uint(place), count - 2);
  const float here = Floats(table).at[node];
  return here + (place - float(node)) * (Floats(table).at[node + 1] - here);
}

// Angle of (x, y) within 2e-7: Moshier, Methods and Programs for Mathematical Functions (1989), atanf. Vulkan allows atan
// and asin errors of 1e-4, which put echoes into other beams.
float angle_of(float y, float x) {
  const float kPi = 3.14159265359;
  const float a = abs(y), b = abs(x), low = min(a, b), high = max(a, b);
  const bool far = low > 0.414213562 * high;  // tan(pi / 8)
  const float t = far ? (low - high) / (low + high) : low / max(high, 1e-30), z = t * t;
  const float eighth = (((8.05374449538e-2 * z - 1.38776856032e-1) * z + 1.99777106478e-1) * z - 3.33329491539e-1) * z * t + t;
  const float within = far ? 0.25 * kPi + eighth : eighth;
  const float quarter = a > b ? 0.5 * kPi - within : within;
  const float half_turn = x < 0.0 ? kPi - quarter : quarter;
  return y < 0.0 ? -half_turn : half_turn;
}

float bearing_of(PlanTables plan, vec3 direction) {
  return plan.cone != 0 ? angle_of(direction.y, length(direction.xz)) : angle_of(direction.y, direction.x);
}

// FanPattern::intensity()
float fan_intensity(float length, float sine) {
  const float x = 3.14159265 * length * sine;
  const float gain = abs(x) < 1e-6 ? 1.0 : sin(x) / x;
  return max(gain * gain, 1e-6);
}

// @param direction  In the sonar frame, unit length.
Arrival arrival_from(PlanTables plan, vec3 direction) {
  const float elevation = angle_of(direction.z, length(direction.xy)), bearing = bearing_of(plan, direction);
  const float received =
      look_up(plan.received_across, plan.received_count, plan.received_low, plan.received_steps, elevation);
  const float sent = plan.sends_apart != 0
                         ? look_up(plan.sent_across, plan.sent_count, plan.sent_low, plan.sent_steps, elevation)
                         : received;
  const float transmitted =
      plan.transmitter_length == 0.0 ? 1.0 : fan_intensity(plan.transmitter_length, sin(bearing));
  return Arrival(bearing, elevation, sent, received, transmitted);
}

bool receives(PlanTables plan, vec3 direction) {
  const float level = length(direction.xy);
  const bool behind = plan.cone != 0 && direction.x < 0.0;
  return direction.z >= plan.tan_low * level && direction.z <= plan.tan_high * level && !behind &&
         beam_of(plan, bearing_of(plan, direction)) >= 0;
}

// Gain of what is sent across bearings where an arrival comes from, re that of what is sent to a column.
float sent_beside(PlanTables plan, uint column, Arrival arrival) {
  Floats transmitted = Floats(plan.transmitted);
  const uint at = uint(max(beam_of(plan, arrival.bearing), 0)) * plan.columns_per_beam;
  return (plan.two_way != 0 ? transmitted.at[at] : arrival.transmitted) / transmitted.at[column];
}
