#include "synthetic/camera_path.h"

#include <algorithm>

namespace dominant_plane_detection {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

Vector6d asVector(const KeyPose& key) {
  Vector6d vector;
  vector << key.position, key.roll, key.pitch, key.yaw;
  return vector;
}

/// Slope of the spline at a key: that from the key before to the key after it.
Vector6d slope(const std::vector<KeyPose>& keys, std::size_t i) {
  const KeyPose& before = keys[i == 0 ? 0 : i - 1];
  const KeyPose& after = keys[std::min(i + 1, keys.size() - 1)];
  if (i == 0 || i + 1 == keys.size()) return Vector6d::Zero();  // starts and ends at rest
  return (asVector(after) - asVector(before)) / (after.time - before.time);
}

}  // namespace

Eigen::Isometry3d KeyPose::pose() const {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  Eigen::Matrix3d optical_axes;   // of the optical frame, in a body that looks along x
  optical_axes << 0.0, 0.0, 1.0,  //
      -1.0, 0.0, 0.0,             //
      0.0, -1.0, 0.0;
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation() = position;
  result.linear() = (AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(pitch, Vector3d::UnitY()) *
                     AngleAxisd(roll, Vector3d::UnitX()))
                        .toRotationMatrix() *
                    optical_axes;
  return result;
}

KeyPose CameraPath::at(double time) const {
  const auto after =
      std::find_if(keys.begin(), keys.end(), [&](const KeyPose& key) { return key.time > time; });
  if (after == keys.begin()) return keys.front();
  if (after == keys.end()) return keys.back();
  const auto i = static_cast<std::size_t>(after - keys.begin()) - 1;
  const double span = keys[i + 1].time - keys[i].time;
  const double s = (time - keys[i].time) / span;
  // Cubic Hermite basis.
  const double h01 = s * s * (3.0 - 2.0 * s), h00 = 1.0 - h01;
  const double h10 = s * (1.0 - s) * (1.0 - s), h11 = s * s * (s - 1.0);
  const Vector6d value = h00 * asVector(keys[i]) + h01 * asVector(keys[i + 1]) +
                         span * (h10 * slope(keys, i) + h11 * slope(keys, i + 1));
  return {time, value.head<3>(), value[3], value[4], value[5]};
}

}  // namespace dominant_plane_detection
