#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace dominant_plane_detection {

/// Random numbers fast enough for a camera's pixels in real time: the standard library's normal
/// distribution alone would take a third of an image's time.
class PixelNoise {
 public:
  explicit PixelNoise(std::uint32_t seed) : state_(seed) {}

  /// @return a normally distributed number, from a table of 65,536.
  float gauss() { return table()[next() >> 16U]; }
  /// @return a number in [0, 1).
  float uniform() { return static_cast<float>(next() >> 8U) * 0x1p-24F; }

 private:
  /// PCG-RXS-M-XS, 32 bit (O'Neill 2014).
  std::uint32_t next() {
    state_ = state_ * 747796405U + 2891336453U;
    const std::uint32_t word = ((state_ >> ((state_ >> 28U) + 4U)) ^ state_) * 277803737U;
    return (word >> 22U) ^ word;
  }
  static const std::vector<float>& table() {
    static const std::vector<float> values = [] {
      std::mt19937 generator;
      std::normal_distribution<float> gauss;
      std::vector<float> numbers(1U << 16U);
      for (float& number : numbers) number = gauss(generator);
      return numbers;
    }();
    return values;
  }

  std::uint32_t state_;
};

}  // namespace dominant_plane_detection
