// normal_turn.h -- change of the surface normal from one sample to its neighbours.

/// Columns whose normals are compared with each other: those from 4 k to 4 k + 3, so that results do not depend on
/// where tasks begin.
CONSTANT int kTurnColumns = 4;

/// Change between two neighbours.
struct NormalChange {
  Triple turn;   ///< Difference of their unit normals; 0 unless they are joined.
  Real joined;   ///< 1 where both lie on one smooth surface, else 0.
  Real squared;  ///< Square of the difference, also where they are not joined.
};

/// @param same           Whether both are on a surface of one label.
/// @param turn           Difference of the unit normals, of the neighbour less that of the sample.
/// @param normal         Of the sample.
/// @param step           From the sample to the neighbour [m].
/// @return  Not joined where the normals differ by more than 53 degrees, or the neighbour is more than 30 degrees off
///          the tangent plane of the sample.
LAW NormalChange normal_change(bool same, Triple turn, Triple normal, Triple step) {
  const Real kMostTurn = REAL(0.9), kMostOffPlane = REAL(0.5);
  const Real squared = dot(turn, turn);
  const Real off = dot(normal, step);
  const bool near_plane = off * off <= kMostOffPlane * kMostOffPlane * dot(step, step);
  const Real joined = both(both(same, near_plane), squared < kMostTurn * kMostTurn) ? REAL(1.0) : REAL(0.0);
  const NormalChange change = {joined * turn, joined, squared};
  return change;
}

/// Mean of the turns to the neighbours on either side, or that of the side which is joined. Where they differ much the
/// mean decreases to 0, which it is where the surface is flat on one side.
/// @param a, b  Turns, 0 unless joined.
LAW Triple mean_turn(Triple a, Real a_joined, Triple b, Real b_joined) {
  const Real kTiniest = REAL(1e-30);
  const Triple one = a + (1 - a_joined) * b, two = b + (1 - b_joined) * a;
  const Real product = dot(one, two);
  const Real squares = dot(one, one) + two.x * two.x + two.y * two.y + two.z * two.z;
  const Real alike = 4 * product / (squares + kTiniest);
  const Real weight = REAL(0.5) * (alike < 0 ? REAL(0.0) : (alike < 1 ? alike : REAL(1.0)));
  return weight * (one + two);
}

/// The turn across of a sample that has no neighbour on its surface on either side: that of a sphere, on which the
/// normal n turns as much across as along a column, n x u for equal spacing; lobes do not depend on its sign. 0 where
/// there is such a neighbour.
/// @param up      u
/// @param width   Of a column at elevation 0 [rad].
/// @param cosine  Of the elevation.
/// @param height  Of a row [rad].
LAW Triple turn_as_along(Triple normal, Triple up, Real a_joined, Real b_joined, Real width, Real cosine, Real height) {
  const Real kTiniest = REAL(1e-30);
  return (1 - a_joined) * (1 - b_joined) * width * cosine / (height + kTiniest) * cross(normal, up);
}
