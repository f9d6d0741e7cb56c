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
SineCosine fast_sine_cosine(float turns) {  // Vulkan's sin and cos may be 5e-4 wrong.
  const float quarters = roundEven(4.0 * turns);
  const int quadrant = int(quarters);
  const float x = (4.0 * turns - quarters) * 1.57079632679489662, square = x * x;
  const float s = x + x * square * (-1.6666654611e-1 + square * (8.3321608736e-3 - square * 1.9515295891e-4));
  const float c =
      1.0 - 0.5 * square + square * square * (4.166664568e-2 + square * (-1.388731625e-3 + square * 2.443315711e-5));
  const bool swapped = (quadrant & 1) != 0;
  const SineCosine at = {(quadrant & 2) != 0 ? -(swapped ? c : s) : (swapped ? c : s),
                         ((quadrant + 1) & 2) != 0 ? -(swapped ? s : c) : (swapped ? s : c)};
  return at;
}
float fast_exp(float x) {
  return exp(clamp(x, -87.0, 88.0));
}
float fast_log(float x) {
  return log(x);
}

// Of base/philox.h.
float uniform_open(uint word) {
  return (float(word >> 9) + 0.5) * (1.0 / 8388608.0);
}

#endif
