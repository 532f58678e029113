#include "calibration/wall_reading.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace dominant_plane_detection {
namespace {

constexpr std::uint16_t kNoReading = 2047;
constexpr int kWindow = 5;           // a fifth of the image's width and height
constexpr double kLeastShare = 0.5;  // [-] of the window's pixels with a reading
constexpr int kBlocks = 4;           // along each side of the window
// Of the blocks' means about the plane: noise is averaged away in them, so that a wall has a few
// hundredths; a corner or a plant has several raw values.
constexpr double kMostBumps = 1.0;     // [-]
constexpr double kMostMovement = 1.0;  // [-] standard deviation over the images

double meanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The readings in the middle of an image, about its middle.
struct Window {
  explicit Window(const DepthView& raw)
      : image(raw), width(raw.width / kWindow), height(raw.height / kWindow) {}

  /// @param function gets (1, u, v), from the window's middle, and the reading.
  template <typename Function>
  void forEachReading(int u0, int u1, int v0, int v1, Function&& function) const {
    for (int v = v0; v < v1; ++v) {
      const auto* row = image.row<std::uint16_t>((image.height - height) / 2 + v);
      for (int u = u0; u < u1; ++u) {
        const std::uint16_t value = row[(image.width - width) / 2 + u];
        if (value >= kNoReading) continue;
        const Eigen::Vector3d line(1.0, u - 0.5 * (width - 1), v - 0.5 * (height - 1));
        function(line, static_cast<double>(value));
      }
    }
  }

  const DepthView& image;
  int width, height;  ///< [px]
};

/// @return [-] root mean square of the blocks' means about a plane.
double bumpsOf(const Window& window, const Eigen::Vector3d& plane) {
  double squares = 0.0, blocks = 0.0;
  for (int i = 0; i < kBlocks; ++i) {
    for (int j = 0; j < kBlocks; ++j) {
      double sum = 0.0, count = 0.0;
      window.forEachReading(i * window.width / kBlocks, (i + 1) * window.width / kBlocks,
                            j * window.height / kBlocks, (j + 1) * window.height / kBlocks,
                            [&](const Eigen::Vector3d& line, double value) {
                              sum += value - plane.dot(line);
                              count += 1.0;
                            });
      if (count == 0.0) continue;
      squares += (sum / count) * (sum / count);
      blocks += 1.0;
    }
  }
  return std::sqrt(squares / blocks);
}

}  // namespace

void WallReading::add(const DepthView& raw) {
  const Window window(raw);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  window.forEachReading(0, window.width, 0, window.height,
                        [&](const Eigen::Vector3d& line, double value) {
                          normal += line * line.transpose();
                          right += value * line;
                        });
  if (normal(0, 0) < kLeastShare * window.width * window.height) {
    ++empty_;
    return;
  }
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  values_.push_back(plane[0]);
  bumps_.push_back(bumpsOf(window, plane));
}

double WallReading::mean() const {
  if (values_.empty() && empty_ == 0) throw std::runtime_error("there are no images");
  if (values_.size() < empty_) {
    throw std::runtime_error(
        "expected a wall in the middle of the images, got too few readings there: is it nearer "
        "than "
        "0.5 m, shiny, black or in the sun?");
  }
  const double mean = meanOf(values_);
  double variance = 0.0;
  for (const double value : values_) variance += (value - mean) * (value - mean);
  const double movement = std::sqrt(variance / static_cast<double>(values_.size()));
  const double bumps = meanOf(bumps_);
  std::ostringstream text;
  if (bumps > kMostBumps) {
    text << "expected a flat wall in the middle of the images, got raw values that bend by "
         << bumps << " about a plane (a wall has less than " << kMostBumps << ")";
  } else if (movement > kMostMovement) {
    text << "expected a camera at rest, got raw values that change by " << movement
         << " from image to image (at rest less than " << kMostMovement << ")";
  }
  if (!text.str().empty()) throw std::runtime_error(text.str());
  return mean;
}

}  // namespace dominant_plane_detection
