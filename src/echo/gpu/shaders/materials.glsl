// materials.glsl -- what the surfaces of the calibrated model scatter and reflect: ScatterTable of the host.

uint material_of(PlanTables plan, uint surface) {
  return min(surface & 0xffffu, plan.materials);
}

Scatterer scatterer_of(PlanTables plan, uint material) {
  return Scatterer(Floats(plan.lambert).at[material], Floats(plan.lobe).at[material],
                   Floats(plan.steepness).at[material]);
}

// AngleTable::at(), from the place `first` of a table on.
float at_angle(address table, uint first, float cosine) {
  const float place = float(kAngleSteps) * sqrt(clamp(1.0 - cosine, 0.0, 1.0));
  const uint node = uint(place), at = first + node;
  const float here = Floats(table).at[at];
  return here + (place - float(node)) * (Floats(table).at[at + 1] - here);
}

float at_angle(PlanTables plan, uint material, uint table, float cosine) {
  return at_angle(plan.by_angle, kAngleStride * material + table, cosine);
}

// Share of the intensity that a surface lets through.
float transmittance(PlanTables plan, uint material, float cosine) {
  return at_angle(plan.passed, kAngleNodes * material, abs(cosine));
}

// Share of the intensity that a surface reflects as a mirror.
float mirrored(PlanTables plan, uint material, float cosine) {
  return plan.by_angle == 0 ? Floats(plan.mirrored).at[material] : at_angle(plan, material, kMirrored, abs(cosine));
}
