// returns.glsl -- echoes of paths that return another way than they came: from the second surface straight back, or over
// the water's surface, WaterReturns of the host.

// How a second surface scatters.
// @param mirror_steepness  Scatterer::steepness of the mirror; 0 where the second surface's mirrored share does not count.
SecondSurface second_surface(PlanTables plan, uint material, SecondAngles angles, float mirror_steepness) {
  const Scatterer towards = scatterer_of(plan, material);
  const float share = lobe_share(mirror_steepness, towards.steepness);
  SecondSurface second = SecondSurface(towards, 0.0, towards.lambert, share * towards.lobe);
  if (plan.by_angle != 0) {
    const float incoming = held_cosine(angles.arriving), outgoing = abs(angles.leaving);
    second.on_top = at_angle(plan, material, kBackscatter, incoming);
    second.mu += at_angle(plan, material, kDiffuse, incoming) * at_angle(plan, material, kDiffuse, outgoing);
    second.lobe = lobe_by_angle(Floats(plan.facets).at[material], at_angle(plan, material, kReflectance, angles.facet),
                                at_angle(plan, material, kMirrored, angles.facet), share);
  }
  return second;
}

// Adds both echoes of a path that is not the same both ways: reciprocal_echoes() of the host.
// @param echo          At the bearing that the ray was launched to.
// @param arrives_from  Direction of the end of the path, in the sonar frame.
void add_both_ways(PingAt ping, PlanTables plan, Reflecting from, SpreadEcho echo, float power, vec3 arrives_from) {
  const Arrival arrival = arrival_from(plan, arrives_from);
  const float beside = sent_beside(plan, from.column, arrival);
  echo.power = power * arrival.sent * beside * Floats(plan.reciprocal).at[in_set(plan, from.column, from.row)];
  add_echo(plan, ping.cells, echo);
  echo.azimuth = arrival.bearing;
  echo.elevation = arrival.elevation;
  echo.power = power * arrival.received * (plan.two_way != 0 ? 1.0 / beside : 1.0);
  add_echo(plan, ping.cells, echo);
}

// The hit of a reflected ray.
struct SecondHit {
  vec3 mirror, point;  // Where both surfaces were hit.
  vec3 normal;         // The second surface's, of any length and side.
  vec3 direction;      // In which the sound came, unit length.
  float texture;       // Factor on the amplitude of the second surface.
  float reflected;     // Share |R|^2 of the mirror.
  float there, across;
  MirrorChange along, aside;
};

// coherent_reflectance() of the host.
float coherent_reflectance(PlanTables plan, uint material, float cosine) {
  const float reflectance =
      plan.by_angle != 0 ? at_angle(plan, material, kReflectance, cosine) : Floats(plan.mirrored).at[material];
  return plan.rough_mirrors != 0 ? 0.0 : reflectance * coherent_share(Floats(plan.roughness).at[material], cosine);
}

// Whether nothing is in the way from a second surface over the water's surface to the sonar.
bool water_leg_is_clear(PlacedScene scene, vec3 point, vec3 sonar, WaterLeg leg) {
  const float near = water_clearance(leg);
  const vec3 bounce = point + leg.first * leg.rising, to_sonar = (sonar - bounce) / leg.second;
  return trace(scene, point, leg.rising, kRayClearance, leg.first - near, true).instance == kNoInstance &&
         trace(scene, bounce, to_sonar, near, leg.second - kRayClearance, true).instance == kNoInstance;
}

// Adds the echoes out by the mirror and back over the water's surface, and the other way round: WaterReturns::connect().
// @param echo  At the bearing that the ray was launched to, with the weight of the hit.
void return_by_water(PingAt ping, PlanTables plan, PlacedScene scene, Reflecting from, SpreadEcho echo, SecondHit hit) {
  const float level = scene.water_level;
  const float chosen = plan.selective != 0 ? one_in_four(from.column, from.row, plan.stagger) : 1.0;
  if (scene.water == kNoSurface || chosen == 0.0 || abs(hit.mirror.z - level) < kLeastDepth ||
      !(level - ping.sonar.z > kLeastDepth) || !(level - hit.point.z > kLeastDepth)) {
    return;
  }
  const WaterLeg leg = water_leg(level, ping.sonar, hit.point);
  const float share = coherent_reflectance(plan, material_of(plan, scene.water), leg.cosine),
              back = leg.first + leg.second;
  if (!(share > kLeastWaterShare) || !(0.5 * (hit.there + back) < plan.reach)) {
    return;
  }
  const vec3 bounce = hit.point + leg.first * leg.rising;
  const vec3 arrives_from = normalize(bounce - ping.sonar) * mat3(ping.forward, ping.port, ping.up);
  const SecondAngles angles = second_angles(hit.normal, -hit.direction, leg.rising);
  const MirrorPath path = MirrorPath(hit.reflected * share, 1.0, hit.there, back, 1.0, 1.0, angles, hit.texture,
                                     FacetReturn(angles.arriving, 0.0, 1.0));
  const SecondSurface second = second_surface(plan, material_of(plan, echo.surface), angles, 0.0);
  const float power = mirror_intensities(path, second, plan.neper_per_metre).once;
  if (!(power > 0.0) || !receives(plan, arrives_from)) {
    return;
  }
  atomicAdd(CountersAt(ping.cells.counter).counters.returns, 2u);
  if (!water_leg_is_clear(scene, hit.point, ping.sonar, leg)) {
    return;
  }
  echo.order = 3;
  echo.path_length = hit.there + back;
  echo.half_length = path_footprint(hit.along, from.selected, hit.aside,
                                    PathEnd(hit.across, hit.direction, unit(hit.normal), -leg.rising, hit.there, back))
                         .once;
  echo.weight *= chosen;
  add_both_ways(ping, plan, from, echo, power, arrives_from);
}
