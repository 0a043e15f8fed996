// SPDX-License-Identifier: Apache-2.0
//
// Three stages. (1) The triangle's bounding sphere against the line, in double. (2) The signed volumes of exact_hit.cpp
// in double, each with a bound on its rounding error. (3) Exact numbers for whatever is still open.
// Doubles neither overflow nor underflow here: non-zero terms of degree 4 in floats lie within 2^-596 .. 2^520.
#include "oracle/brute_force.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <limits>

namespace umbrix::oracle {
namespace {

// The bounds below need IEEE rounding and denormals, whatever mode a host or a test has set.
class DefaultFloatMode {
 public:
  DefaultFloatMode() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloatMode() { std::fesetenv(&saved_); }
  DefaultFloatMode(const DefaultFloatMode&) = delete;
  DefaultFloatMode& operator=(const DefaultFloatMode&) = delete;

 private:
  std::fenv_t saved_;
};

using Double3 = std::array<double, 3>;

// A value and a bound on its error.
struct Bounded {
  double value;
  double error;

  bool positive() const { return value > error; }
  bool negative() const { return value < -error; }
};

// At most 11 roundings lie on any path (Higham 2002, lemma 3.1: gamma_11 of the sum of absolute terms); 16 units cover
// them and the rounding of the bound itself.
constexpr double kUnits = 16 * 0x1p-53;

// x . (y x z), with the sum of the absolute values of its six terms.
Bounded volume(const Double3& x, const Double3& y, const Double3& z) {
  double value = 0;
  double terms = 0;
  for (int i = 0; i < 3; ++i) {
    const auto j = static_cast<std::size_t>((i + 1) % 3);
    const auto k = static_cast<std::size_t>((i + 2) % 3);
    const double left = y[j] * z[k];
    const double right = y[k] * z[j];
    value += x[static_cast<std::size_t>(i)] * (left - right);
    terms += std::abs(x[static_cast<std::size_t>(i)]) * (std::abs(left) + std::abs(right));
  }
  return {value, kUnits * terms};
}

Double3 seen_from(const float point[3], const float origin[3]) {
  return {double{point[0]} - origin[0], double{point[1]} - origin[1], double{point[2]} - origin[2]};
}

enum class Verdict { miss, hit, open };

struct Filtered {
  Verdict verdict;
  double t_lower = -std::numeric_limits<double>::infinity();
  double t_upper = std::numeric_limits<double>::infinity();
};

// The sign of t - limit, as far as it is certain.
Bounded distance_to_limit(const Bounded& t_numerator, const Bounded& denominator, float limit) {
  return {t_numerator.value - double{limit} * denominator.value,
          t_numerator.error + std::abs(double{limit}) * denominator.error};
}

Verdict inside_interval(const Bounded& t_numerator, const Bounded& denominator, const Ray& ray) {
  bool certain = true;
  if (ray.tmin != -std::numeric_limits<float>::infinity()) {
    const Bounded above = distance_to_limit(t_numerator, denominator, ray.tmin);
    if (above.negative()) return Verdict::miss;
    certain = certain && above.positive();
  }
  if (ray.tmax != std::numeric_limits<float>::infinity()) {
    const Bounded beyond = distance_to_limit(t_numerator, denominator, ray.tmax);
    if (beyond.positive()) return Verdict::miss;
    certain = certain && beyond.negative();
  }
  return certain ? Verdict::hit : Verdict::open;
}

Filtered filter(const Ray& ray, const Triangle& triangle) {
  const Double3 d = {ray.direction[0], ray.direction[1], ray.direction[2]};
  const Double3 a = seen_from(triangle.v[0], ray.origin);
  const Double3 b = seen_from(triangle.v[1], ray.origin);
  const Double3 c = seen_from(triangle.v[2], ray.origin);
  const Bounded w[3] = {volume(d, b, c), volume(d, c, a), volume(d, a, b)};

  // Two weights of certainly opposite sign: a miss, whatever the third.
  const bool any_positive = w[0].positive() || w[1].positive() || w[2].positive();
  const bool any_negative = w[0].negative() || w[1].negative() || w[2].negative();
  if (any_positive && any_negative) return {Verdict::miss};

  Bounded denominator = {w[0].value + w[1].value + w[2].value, w[0].error + w[1].error + w[2].error};
  Bounded t_numerator = volume(a, b, c);
  if (!denominator.positive() && !denominator.negative()) return {Verdict::open};
  if (denominator.negative()) {
    denominator.value = -denominator.value;
    t_numerator.value = -t_numerator.value;
  }
  const Verdict in_t = inside_interval(t_numerator, denominator, ray);
  if (in_t == Verdict::miss) return {Verdict::miss};
  const bool certain_inside = (w[0].positive() && w[1].positive() && w[2].positive()) ||
                              (w[0].negative() && w[1].negative() && w[2].negative());
  Filtered result = {certain_inside ? in_t : Verdict::open};
  const auto quotient = [&](double numerator) {
    const double x = numerator / (denominator.value + denominator.error);
    const double y = numerator / (denominator.value - denominator.error);
    return std::pair<double, double>(std::min(x, y), std::max(x, y));
  };
  // Outward by far more than the divisions' own rounding.
  const double low = quotient(t_numerator.value - t_numerator.error).first;
  const double high = quotient(t_numerator.value + t_numerator.error).second;
  result.t_lower = low - std::abs(low) * 1e-14;
  result.t_upper = high + std::abs(high) * 1e-14;
  return result;
}

}  // namespace

BruteForce::BruteForce(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  const DefaultFloatMode mode;
  for (std::vector<double>& axis : center_) axis.resize(triangles_.size());
  radius_squared_.resize(triangles_.size());
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const auto& v = triangles_[i].v;
    for (std::size_t k = 0; k < 3; ++k) center_[k][i] = (double{v[0][k]} + double{v[1][k]} + double{v[2][k]}) / 3;
    double largest = 0;
    for (const auto& corner : v) {
      double squared = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double offset = corner[k] - center_[k][i];
        squared += offset * offset;
      }
      largest = squared > largest || std::isnan(squared) ? squared : largest;
    }
    // Any centre will do as long as the sphere holds the corners; 1e-12 is thousands of roundings.
    radius_squared_[i] = largest * (1 + 1e-12);
  }
}

// Calls body(triangle) for each whose sphere the line may meet, until it returns false.
template <typename Body>
void BruteForce::for_each_near(const Ray& ray, const Body& body) const {
  const double ox = ray.origin[0], oy = ray.origin[1], oz = ray.origin[2];
  const double dx = ray.direction[0], dy = ray.direction[1], dz = ray.direction[2];
  const double d_squared = dx * dx + dy * dy + dz * dz;
  constexpr std::size_t kBlock = 64;
  std::array<std::uint8_t, kBlock> near;
  for (std::size_t begin = 0; begin < triangles_.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, triangles_.size() - begin);
    const double* cx = center_[0].data() + begin;
    const double* cy = center_[1].data() + begin;
    const double* cz = center_[2].data() + begin;
    const double* r_squared = radius_squared_.data() + begin;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = cx[i] - ox, y = cy[i] - oy, z = cz[i] - oz;
      const double nx = y * dz - z * dy, ny = z * dx - x * dz, nz = x * dy - y * dx;
      // |x cross d| > r |d| is a miss. The cross product's error is below 8 units of |x||d|; 1e-13 is 900 units.
      const double limit = (r_squared[i] * (1 + 1e-12) + 1e-13 * (x * x + y * y + z * z)) * d_squared;
      near[i] = !(nx * nx + ny * ny + nz * nz > limit);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (near[i] != 0 && !body(static_cast<std::uint32_t>(begin + i))) return;
    }
  }
}

bool BruteForce::occluded(const Ray& ray, const Visible& visible) const {
  const DefaultFloatMode mode;
  if (!is_valid(ray)) return false;
  bool hit = false;
  std::vector<std::uint32_t> open;
  for_each_near(ray, [&](std::uint32_t i) {
    const Verdict verdict = filter(ray, triangles_[i]).verdict;
    if (verdict == Verdict::miss || (visible && !visible(i))) return true;
    if (verdict == Verdict::open) open.push_back(i);
    hit = verdict == Verdict::hit;
    return !hit;
  });
  return hit || std::any_of(open.begin(), open.end(), [&](std::uint32_t i) { return exact_hit(ray, triangles_[i].v); });
}

std::optional<BruteForce::Closest> BruteForce::closest(const Ray& ray, const Visible& visible) const {
  const DefaultFloatMode mode;
  if (!is_valid(ray)) return std::nullopt;
  struct Candidate {
    std::uint32_t triangle;
    double t_lower, t_upper;
  };
  std::vector<Candidate> candidates;
  for_each_near(ray, [&](std::uint32_t i) {
    const Filtered f = filter(ray, triangles_[i]);
    if (f.verdict != Verdict::miss && (!visible || visible(i))) candidates.push_back({i, f.t_lower, f.t_upper});
    return true;
  });
  // Nearest first, so that most others are certainly farther than the best so far.
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& x, const Candidate& y) { return x.t_lower < y.t_lower; });
  std::optional<ExactHit> best;
  Candidate nearest{};
  for (const Candidate& candidate : candidates) {
    if (best && candidate.t_lower > nearest.t_upper) break;
    std::optional<ExactHit> hit = exact_intersection(ray, triangles_[candidate.triangle].v);
    if (!hit) continue;
    const int order = best ? compare_t(*hit, *best) : -1;
    if (order < 0 || (order == 0 && candidate.triangle < nearest.triangle)) {
      best = std::move(hit);
      nearest = candidate;
    }
  }
  if (!best) return std::nullopt;
  return Closest{nearest.triangle, best->t(), best->u(), best->v()};
}

std::vector<std::uint8_t> BruteForce::occluded(const std::vector<Ray>& rays) const {
  std::vector<std::uint8_t> out(rays.size());
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) { out[i] = occluded(rays[i]) ? 1 : 0; });
  return out;
}

}  // namespace umbrix::oracle
