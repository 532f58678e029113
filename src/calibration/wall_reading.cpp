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
// A reading is rounded to one; a wall's root mean square is 0.3 to 0.6, a corner's or a plant's
// far more.
constexpr double kMostBumps = 2.0;     // [-]
constexpr double kMostMovement = 1.0;  // [-] standard deviation over the images

double meanOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

void WallReading::add(const DepthView& raw) {
  const int width = raw.width / kWindow;
  const int height = raw.height / kWindow;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares = 0.0;
  double count = 0.0;
  for (int v = 0; v < height; ++v) {
    const auto* row = raw.row<std::uint16_t>((raw.height - height) / 2 + v);
    for (int u = 0; u < width; ++u) {
      const std::uint16_t value = row[(raw.width - width) / 2 + u];
      if (value >= kNoReading) continue;
      // From the window's middle, which is the image's.
      const Eigen::Vector3d line(1.0, u - 0.5 * (width - 1), v - 0.5 * (height - 1));
      normal += line * line.transpose();
      right += value * line;
      squares += static_cast<double>(value) * value;
      count += 1.0;
    }
  }
  if (count < kLeastShare * width * height) {
    ++empty_;
    return;
  }
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  values_.push_back(plane[0]);
  bumps_.push_back(std::sqrt(std::max(squares - plane.dot(right), 0.0) / count));
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
    text << "expected a flat wall in the middle of the images, got raw values that scatter by "
         << bumps << " about a plane (a wall has less than " << kMostBumps << ")";
  } else if (movement > kMostMovement) {
    text << "expected a camera at rest, got raw values that change by " << movement
         << " from image to image (at rest less than " << kMostMovement << ")";
  }
  if (!text.str().empty()) throw std::runtime_error(text.str());
  return mean;
}

}  // namespace dominant_plane_detection
