// prelude.h -- the common subset of C++ and GLSL that the laws are written in: docs/design/laws.md.
//
// C++ reads it through laws.h, with Real as float and as double. A shader includes it first.

#ifdef __cplusplus

using std::abs;
using std::floor;
using std::max;
using std::min;
using std::sqrt;
using uint = std::uint32_t;

/// A vector of plain numbers instead of an Eigen vector, so that the compiler vectorises loops over lanes.
struct Triple {
  Real x, y, z;
};
LAW Triple triple(Real x, Real y, Real z) {
  return {x, y, z};
}
LAW Triple operator+(Triple a, Triple b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
LAW Triple operator-(Triple a, Triple b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
LAW Triple operator*(Real scale, Triple a) {
  return {scale * a.x, scale * a.y, scale * a.z};
}
LAW bool operator==(Triple a, Triple b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}
LAW Real dot(Triple a, Triple b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

LAW Triple cross(Triple a, Triple b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The mirrored direction at a surface with the unit normal n, of either sign.
LAW Triple reflect(Triple d, Triple n) {
  return d - 2 * dot(d, n) * n;
}

/// a && b, and a || b, without a branch.
LAW bool both(bool a, bool b) {
  return a & b;
}
LAW bool either(bool a, bool b) {
  return a | b;
}

#else

#define LAW
#define CONSTANT const
#define Real float
#define REAL(literal) literal
#define Triple vec3
#define triple vec3

bool both(bool a, bool b) {
  return a && b;
}
bool either(bool a, bool b) {
  return a || b;
}

// Functions of base/vector_math.h.
struct SineCosine {
  float sine, cosine;
};
SineCosine fast_sine_cosine(float turns) {
  const SineCosine at = {sin(6.2831853 * turns), cos(6.2831853 * turns)};
  return at;
}
float fast_exp(float x) {
  return exp(x);
}
float fast_log(float x) {
  return log(x);
}

#endif
