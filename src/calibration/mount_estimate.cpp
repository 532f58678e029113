#include "calibration/mount_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace dominant_plane_detection {
namespace {

constexpr std::size_t kFewest = 10;    // [#] of frames
constexpr double kLeastFound = 0.9;    // [-] of the frames
constexpr double kLeastShare = 0.5;    // [-] of the readings on the plane: the floor has to be free
constexpr double kDegree = 0.0174533;  // [rad]
// Standard deviations over the frames. A base that drives over an even floor sways by a degree, and
// a camera on it by a few millimetres; one in the hand by far more.
constexpr double kMostHeight = 0.005;         // [m]
constexpr double kMostAngle = 1.5 * kDegree;  // [rad]
// Of camera.launch, from camera_link to the right.
constexpr double kLinkToDepth = 0.02;    // [m]
constexpr double kLinkToColour = 0.045;  // [m]
constexpr std::size_t kBatches = 10;

struct Statistics {
  double mean = 0.0;
  double deviation = 0.0;  ///< standard deviation
  double error = 0.0;      ///< standard error of the mean
};

Statistics statisticsOf(const std::vector<double>& values) {
  Statistics result;
  const auto n = static_cast<double>(values.size());
  for (const double value : values) result.mean += value / n;
  for (const double value : values) {
    result.deviation += (value - result.mean) * (value - result.mean) / (n - 1.0);
  }
  result.deviation = std::sqrt(result.deviation);
  result.error = result.deviation / std::sqrt(n);
  return result;
}

/// The error is that of the means of ten batches: neighbours err alike, so that many frames a
/// second tell less than as many apart.
template <typename Frames, typename Value>
Statistics statistics(const Frames& frames, Value&& value) {
  std::vector<double> values, batches(kBatches, 0.0);
  for (const auto& frame : frames) values.push_back(value(frame));
  for (std::size_t k = 0; k < kBatches; ++k) {
    const std::size_t begin = k * values.size() / kBatches;
    const std::size_t end = (k + 1) * values.size() / kBatches;
    for (std::size_t i = begin; i < end; ++i) {
      batches[k] += values[i] / static_cast<double>(end - begin);
    }
  }
  Statistics result = statisticsOf(values);
  result.error = statisticsOf(batches).error;
  return result;
}

// In the axes of camera_link, x forward, y left, z up, where R_y(pitch) R_x(roll) turns the link
// over the floor, "up" is (-sin pitch, cos pitch sin roll, cos pitch cos roll).
double pitchOf(const Eigen::Vector3d& up) {
  return std::atan2(-up.z(), std::hypot(up.x(), up.y()));
}
double rollOf(const Eigen::Vector3d& up) { return std::atan2(-up.x(), -up.y()); }

}  // namespace

double linkOffsetOf(const std::string& frame_id) {
  const std::string colour = "rgb_optical_frame";
  const bool in_colour =
      frame_id.size() >= colour.size() &&
      frame_id.compare(frame_id.size() - colour.size(), colour.size(), colour) == 0;
  return in_colour ? kLinkToColour : kLinkToDepth;
}

double Mount::linkHeight() const { return height + link_offset * std::cos(pitch) * std::sin(roll); }

std::string Mount::launchText() const {
  // To a tenth of a millimetre and of a milliradian, without a minus before zero.
  const auto rounded = [](double value) { return std::round(1e4 * value) / 1e4 + 0.0; };
  const double z = rounded(linkHeight());
  const double p = rounded(pitch);
  const double r = rounded(roll);
  char text[400];
  std::snprintf(text, sizeof(text),
                "mount_height:=%.4f mount_pitch:=%.4f mount_roll:=%.4f\n"
                "<node pkg=\"tf2_ros\" type=\"static_transform_publisher\" name=\"camera_mount\"\n"
                "      args=\"0 0 %.4f 0 %.4f %.4f base_link camera_link\" />",
                z, p, r, z, p, r);
  return text;
}

void MountEstimate::add(const Detection& detection, const std::string& frame_id) {
  ++seen_;
  frame_id_ = frame_id;
  if (!detection.found()) {
    reason_ = detection.reason;
    return;
  }
  found_.push_back({detection.normal, detection.distance});
  share_ += detection.inlierShare();
}

Mount MountEstimate::mount() const {
  std::ostringstream problem;
  problem.precision(3);
  if (seen_ < kFewest) {
    problem << "expected at least " << kFewest << " images, got " << seen_;
    throw std::runtime_error(problem.str());
  }
  const auto n = static_cast<double>(found_.size());
  if (n < kLeastFound * static_cast<double>(seen_) || found_.size() < kBatches) {
    problem << "expected the floor in every image, found it in " << found_.size() << " of " << seen_
            << ": " << reason_;
    throw std::runtime_error(problem.str());
  }
  if (share_ < kLeastShare * n) {
    problem << "expected free floor, got a plane with " << 100.0 * share_ / n
            << " % of the readings (at least " << 100.0 * kLeastShare
            << " %): point the camera at more floor, with less on it";
    throw std::runtime_error(problem.str());
  }
  const auto height = statistics(found_, [](const Frame& f) { return f.height; });
  const auto pitch = statistics(found_, [](const Frame& f) { return pitchOf(f.up); });
  const auto roll = statistics(found_, [](const Frame& f) { return rollOf(f.up); });
  const double angle = std::max(pitch.deviation, roll.deviation);
  if (height.deviation > kMostHeight || angle > kMostAngle) {
    problem << "expected a camera at rest, got a plane that moves: standard deviations of "
            << 1000.0 * height.deviation << " mm (at most " << 1000.0 * kMostHeight << ") and "
            << angle / kDegree << " deg (at most " << kMostAngle / kDegree << ")";
    throw std::runtime_error(problem.str());
  }
  Mount mount;
  mount.link_offset = linkOffsetOf(frame_id_);
  mount.frames = found_.size();
  mount.height = height.mean;
  mount.pitch = pitch.mean;
  mount.roll = roll.mean;
  mount.height_error = height.error;
  mount.pitch_error = pitch.error;
  mount.roll_error = roll.error;
  return mount;
}

}  // namespace dominant_plane_detection
