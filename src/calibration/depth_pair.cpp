#include "calibration/depth_pair.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <stdexcept>

namespace dominant_plane_detection {
namespace {

constexpr double kFarthest = 20.0;     // [m] that a tape measure is used for
constexpr double kConcordance = 0.85;  // [-] least share of pairs of pairs that ascend

void requireValues(const std::vector<DepthPair>& pairs) {
  for (const DepthPair& p : pairs) {
    if (!(0.0 <= p.raw && p.raw < 2047.0)) {
      throw std::invalid_argument("expected raw values from 0 to 2046 (2047 is no reading), got " +
                                  describe(p));
    }
    if (!(0.0 < p.distance && p.distance <= kFarthest)) {
      throw std::invalid_argument("expected distances in metres, up to " +
                                  std::to_string(static_cast<int>(kFarthest)) + " m, got " +
                                  describe(p));
    }
    if (!(0.0 <= p.sigma && std::isfinite(p.sigma))) {
      throw std::invalid_argument("expected standard deviations in metres, got one of " +
                                  std::to_string(p.sigma));
    }
  }
}

void requireEnough(const std::vector<DepthPair>& pairs, int constants) {
  std::set<double> raws;
  for (const DepthPair& p : pairs) raws.insert(p.raw);
  const int needed = constants + 1;
  if (static_cast<int>(raws.size()) >= needed) return;
  throw std::invalid_argument("too few pairs: expected at least " + std::to_string(needed) +
                              " different raw values for " + std::to_string(constants) +
                              " constants and their errors, got " + std::to_string(raws.size()));
}

void requireMonotonic(std::vector<DepthPair> pairs) {
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const auto& p, const auto& q) { return p.raw < q.raw; });
  std::size_t compared = 0, ascending = 0;
  const DepthPair* first = nullptr;
  const DepthPair* second = nullptr;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t j = i + 1; j < pairs.size(); ++j) {
      if (pairs[i].raw == pairs[j].raw) continue;
      ++compared;
      if (pairs[i].distance < pairs[j].distance) {
        ++ascending;
      } else if (first == nullptr) {
        first = &pairs[i];
        second = &pairs[j];
      }
    }
  }
  if (static_cast<double>(ascending) >= kConcordance * static_cast<double>(compared)) return;
  throw std::invalid_argument(
      "the pairs are not monotonic: expected a distance that grows with the raw value, got " +
      describe(*first) + " and " + describe(*second) +
      "; are the columns in the order raw,distance?");
}

}  // namespace

std::string describe(const DepthPair& p) {
  std::ostringstream text;
  text << "(raw " << p.raw << ", " << p.distance << " m)";
  return text.str();
}

void requireUsable(const std::vector<DepthPair>& pairs, int constants) {
  requireValues(pairs);
  requireEnough(pairs, constants);
  requireMonotonic(pairs);
}

}  // namespace dominant_plane_detection
