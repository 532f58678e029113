#include "synthetic/smooth_error.h"

#include <cmath>

namespace dominant_plane_detection {
namespace {

/// Where a coordinate falls between the nodes of a lattice.
struct Between {
  explicit Between(double position)
      : node(static_cast<std::size_t>(position)),
        share(static_cast<float>(position - std::floor(position))) {}
  std::size_t node;
  float share;
};

float mix(float a, float b, float share) { return a + share * (b - a); }

}  // namespace

std::vector<ErrorOctave> kinectOctaves() {
  return {{8.0, 1.6e-3, 1.6e-4}, {32.0, 1.2e-3, 2.4e-4}, {400.0, 8.4e-3, 6.8e-4}};
}

std::vector<ErrorOctave> realsenseOctaves() {
  return {{8.0, 1.2e-3, 1.1e-4}, {24.0, 0.8e-3, 4.8e-4}, {192.0, 1.0e-3, 1.3e-4}};
}

SmoothError::SmoothError(const std::vector<ErrorOctave>& octaves, int width, int height,
                         PixelNoise& random)
    : columns_(static_cast<std::size_t>(width / kStep) + 2),
      rows_(static_cast<std::size_t>(height / kStep) + 2),
      constant_(columns_ * rows_, 0.0F),
      quadratic_(columns_ * rows_, 0.0F) {
  for (const ErrorOctave& octave : octaves) add(octave, octave.spacing * width / 640.0, random);
}

void SmoothError::add(const ErrorOctave& octave, double spacing, PixelNoise& random) {
  // Between four nodes the variance is less than at them, 4/9 on average.
  constexpr double kLevel = 1.5;
  const auto constant = static_cast<float>(kLevel * octave.constant);
  const auto quadratic = static_cast<float>(kLevel * octave.quadratic);
  const double step = kStep / spacing;
  const double left = static_cast<double>(random.uniform());
  const double top = static_cast<double>(random.uniform());
  const std::size_t nodes = Between(left + step * static_cast<double>(columns_)).node + 2;
  const std::size_t lines = Between(top + step * static_cast<double>(rows_)).node + 2;
  std::vector<float> lattice(nodes * lines);
  for (float& value : lattice) value = random.gauss();
  for (std::size_t j = 0; j < rows_; ++j) {
    const Between y(top + step * static_cast<double>(j));
    const float* above = lattice.data() + y.node * nodes;
    const float* below = above + nodes;
    for (std::size_t i = 0; i < columns_; ++i) {
      const Between x(left + step * static_cast<double>(i));
      const float value = mix(mix(above[x.node], above[x.node + 1], x.share),
                              mix(below[x.node], below[x.node + 1], x.share), y.share);
      constant_[j * columns_ + i] += constant * value;
      quadratic_[j * columns_ + i] += quadratic * value;
    }
  }
}

void SmoothError::row(int v, std::vector<float>& constant, std::vector<float>& quadratic) const {
  const Between y(static_cast<double>(v) / kStep);
  const auto fill = [&](const std::vector<float>& grid, std::vector<float>& pixels) {
    const float* above = grid.data() + y.node * columns_;
    const float* below = above + columns_;
    for (std::size_t u = 0; u < pixels.size(); ++u) {
      const std::size_t i = u / kStep;
      const float share = static_cast<float>(u % kStep) / kStep;
      pixels[u] =
          mix(mix(above[i], above[i + 1], share), mix(below[i], below[i + 1], share), y.share);
    }
  };
  fill(constant_, constant);
  fill(quadratic_, quadratic);
}

}  // namespace dominant_plane_detection
