#include "synthetic/sensor_noise.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "synthetic/pixel_noise.h"
#include "synthetic/renderer.h"

namespace dominant_plane_detection {
namespace {

/// [-] Flatter incidence does not add to the smooth error.
constexpr float kFlattest = 0.05F;

float quantised(float z, float focal_length) {
  const float scale =
      focal_length * static_cast<float>(SensorNoise::kBaseline / SensorNoise::kDisparityStep);
  const float steps = std::nearbyint(scale / z);
  return steps > 0.0F ? scale / steps : 0.0F;
}

/// The smooth error at a pixel, along the surface's normal.
struct Smooth {
  float constant;   ///< [m]
  float quadratic;  ///< [1/m]
};

/// @return [mm] the reading of pixel i, 0 for none.
std::uint16_t sensed(const Rendering& rendering, std::size_t i, const SensorNoise& noise,
                     const Smooth& smooth, PixelNoise& random) {
  // Drawn for every pixel, so that switching one effect off does not change the others.
  const float axial = random.gauss();
  const bool lost = random.uniform() < static_cast<float>(noise.drop_out);
  const float truth = rendering.depth[i], cosine = rendering.cosine[i];
  if (truth <= 0.0F || lost) return 0;
  if (noise.shadows && rendering.shadow[i] != 0) return 0;
  if (cosine < static_cast<float>(noise.min_cosine)) return 0;
  const float square = truth * truth, flat = std::max(cosine, kFlattest);
  float z = truth + (smooth.constant + smooth.quadratic * square / flat) / flat;
  if (noise.axial) {
    z += (static_cast<float>(noise.model.constant) +
          static_cast<float>(noise.model.quadratic) * square) *
         axial;
  }
  if (!(static_cast<float>(noise.range_min) <= z && z <= static_cast<float>(noise.range_max))) {
    return 0;
  }
  if (noise.quantise) z = quantised(z, static_cast<float>(rendering.focal_length));
  return static_cast<std::uint16_t>(std::lrint(1000.0F * z));
}

}  // namespace

SensorNoise SensorNoise::realsense() {
  SensorNoise noise;
  noise.model = {0.0002, 5e-4};
  noise.octaves = realsenseOctaves();
  noise.quantise = false;
  return noise;
}

SensorNoise SensorNoise::independent() {
  SensorNoise noise;
  noise.model = NoiseModel{};
  noise.smooth = false;
  return noise;
}

SensorNoise SensorNoise::none() {
  SensorNoise noise;
  noise.axial = noise.smooth = noise.quantise = noise.shadows = false;
  noise.min_cosine = 0.0;
  return noise;
}

SensorNoise SensorNoise::named(const std::string& sensor) {
  if (sensor == "kinect") return {};
  if (sensor == "realsense") return realsense();
  if (sensor == "independent") return independent();
  throw std::invalid_argument("there is no sensor '" + sensor +
                              "', but kinect, realsense and independent");
}

std::vector<std::uint16_t> senseDepth(const Rendering& rendering, const SensorNoise& noise,
                                      std::uint32_t frame) {
  PixelNoise random(static_cast<std::uint32_t>(std::mt19937(frame)()));
  const SmoothError smooth(noise.smooth ? noise.octaves : std::vector<ErrorOctave>{},
                           rendering.width, rendering.height, random);
  const auto width = static_cast<std::size_t>(rendering.width);
  std::vector<float> constant(width), quadratic(width);
  std::vector<std::uint16_t> readings(rendering.depth.size(), 0);
  for (int v = 0; v < rendering.height; ++v) {
    smooth.row(v, constant, quadratic);
    const std::size_t begin = static_cast<std::size_t>(v) * width;
    for (std::size_t u = 0; u < width; ++u) {
      readings[begin + u] =
          sensed(rendering, begin + u, noise, {constant[u], quadratic[u]}, random);
    }
  }
  return readings;
}

}  // namespace dominant_plane_detection
