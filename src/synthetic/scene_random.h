#pragma once

#include <cstdint>
#include <random>

namespace dominant_plane_detection {

/// Random numbers that scenes are drawn from: the same ones for the same seed.
class SceneRandom {
 public:
  explicit SceneRandom(std::uint32_t seed) : generator_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>()(generator_);
  }
  /// @return one of low, low + 1, ... high.
  int count(int low, int high) { return std::uniform_int_distribution<int>(low, high)(generator_); }
  bool chance(double probability) { return between(0.0, 1.0) < probability; }

 private:
  std::mt19937 generator_;
};

}  // namespace dominant_plane_detection
