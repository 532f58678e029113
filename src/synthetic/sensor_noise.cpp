#include "synthetic/sensor_noise.h"

#include <array>
#include <cmath>
#include <random>

#include "synthetic/renderer.h"

namespace dominant_plane_detection {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A smooth random field with mean 0 and variance 1: waves of random direction, length and phase.
class SmoothField {
 public:
  SmoothField(double shortest_wave, std::mt19937& generator) {
    std::uniform_real_distribution<double> uniform;
    for (Wave& wave : waves_) {
      const double direction = 2.0 * kPi * uniform(generator);
      const double number = 2.0 * kPi / (shortest_wave * (1.0 + 3.0 * uniform(generator)));
      wave = {number * std::cos(direction), number * std::sin(direction),
              2.0 * kPi * uniform(generator)};
    }
  }
  double at(int u, int v) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) sum += std::cos(wave.x * u + wave.y * v + wave.phase);
    return sum * std::sqrt(2.0 / static_cast<double>(waves_.size()));
  }

 private:
  struct Wave {
    double x, y, phase;
  };
  std::array<Wave, 16> waves_;
};

float quantised(float z, float focal_length) {
  const float scale =
      focal_length * static_cast<float>(SensorNoise::kBaseline / SensorNoise::kDisparityStep);
  const float steps = std::nearbyint(scale / z);
  return steps > 0.0F ? scale / steps : 0.0F;
}

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

}  // namespace

SensorNoise SensorNoise::none() {
  SensorNoise noise;
  noise.axial = noise.quantise = noise.shadows = false;
  noise.min_cosine = 0.0;
  return noise;
}

std::vector<std::uint16_t> senseDepth(const Rendering& rendering, const SensorNoise& noise,
                                      std::uint32_t frame) {
  std::mt19937 generator(frame);
  const SmoothField field(noise.correlation_length, generator);
  PixelNoise random(static_cast<std::uint32_t>(generator()));
  const auto sigma_constant = static_cast<float>(noise.model.constant);
  const auto sigma_quadratic = static_cast<float>(noise.model.quadratic);
  const auto focal_length = static_cast<float>(rendering.focal_length);
  const auto range_min = static_cast<float>(noise.range_min);
  const auto range_max = static_cast<float>(noise.range_max);
  const auto min_cosine = static_cast<float>(noise.min_cosine);
  const auto drop_out = static_cast<float>(noise.drop_out);
  const auto correlated = static_cast<float>(noise.correlated);
  std::vector<std::uint16_t> readings(rendering.depth.size(), 0);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    // Drawn for every pixel, so that switching one effect off does not change the others.
    const float axial = random.gauss();
    const bool lost = random.uniform() < drop_out;
    const float truth = rendering.depth[i];
    if (truth <= 0.0F || lost) continue;
    if (noise.shadows && rendering.shadow[i] != 0) continue;
    if (rendering.cosine[i] < min_cosine) continue;
    float z = truth;
    if (noise.axial) z += (sigma_constant + sigma_quadratic * truth * truth) * axial;
    if (correlated > 0.0F) {
      const int u = static_cast<int>(i) % rendering.width;
      const int v = static_cast<int>(i) / rendering.width;
      z += correlated * truth * truth * static_cast<float>(field.at(u, v));
    }
    if (!(range_min <= z && z <= range_max)) continue;
    if (noise.quantise) z = quantised(z, focal_length);
    readings[i] = static_cast<std::uint16_t>(std::lrint(1000.0F * z));
  }
  return readings;
}

}  // namespace dominant_plane_detection
