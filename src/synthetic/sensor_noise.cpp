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

double quantised(double z, double focal_length) {
  const double scale = focal_length * SensorNoise::kBaseline;
  const double steps = std::round(scale / z / SensorNoise::kDisparityStep);
  return steps > 0.0 ? scale / (steps * SensorNoise::kDisparityStep) : 0.0;
}

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
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform;
  std::vector<std::uint16_t> readings(rendering.depth.size(), 0);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    // Drawn for every pixel, so that switching one effect off does not change the others.
    const double axial = gauss(generator);
    const bool lost = uniform(generator) < noise.drop_out;
    const double truth = static_cast<double>(rendering.depth[i]);
    if (truth <= 0.0 || lost) continue;
    if (noise.shadows && rendering.shadow[i] != 0) continue;
    if (static_cast<double>(rendering.cosine[i]) < noise.min_cosine) continue;
    double z = truth;
    if (noise.axial) z += noise.model.sigma(truth) * axial;
    if (noise.correlated > 0.0) {
      const int u = static_cast<int>(i) % rendering.width;
      const int v = static_cast<int>(i) / rendering.width;
      z += noise.correlated * truth * truth * field.at(u, v);
    }
    if (z < noise.range_min || z > noise.range_max) continue;
    if (noise.quantise) z = quantised(z, rendering.focal_length);
    readings[i] = static_cast<std::uint16_t>(std::lround(1000.0 * z));
  }
  return readings;
}

}  // namespace dominant_plane_detection
