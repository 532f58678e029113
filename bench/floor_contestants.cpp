#include "floor_contestants.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "other_detectors.h"

namespace dominant_plane_detection {
namespace {

constexpr int kMostOfOthers = 20;  // [#] a cell: they take 0.2 s an image

/// Labels by what somebody else's plane is, and by the side of the detector's plane elsewhere.
Labels labelsByMask(const ReferenceSet& set, const DepthView& view, const Detection& detection,
                    const std::function<bool(int u, int v)>& is_ground) {
  Labels labels(detection.labels.size(), static_cast<std::uint8_t>(Label::kUnknown));
  for (int v = 0; v < view.height; ++v) {
    for (int u = 0; u < view.width; ++u) {
      const Eigen::Vector3d point = set.point(view, u, v);
      if (point.z() < set.range_min || point.z() > set.range_max) continue;
      const Label label = is_ground(u, v)                 ? Label::kGround
                          : detection.height(point) > 0.0 ? Label::kObstacle
                                                          : Label::kDropOff;
      labels[static_cast<std::size_t>(v * view.width + u)] = static_cast<std::uint8_t>(label);
    }
  }
  return labels;
}

Labels labelsByHeight(const ReferenceSet& set, const DepthView& view, const Detection& detection,
                      double threshold) {
  return labelsByMask(set, view, detection, [&](int u, int v) {
    return std::abs(detection.height(set.point(view, u, v))) <= threshold;
  });
}

/// [m], as the packaged detectors want it.
cv::Mat metres(const DepthView& view) {
  cv::Mat depth(view.height, view.width, CV_32F);
  for (int v = 0; v < view.height; ++v) {
    for (int u = 0; u < view.width; ++u) {
      const float z = metresAt(view, u, v);
      depth.at<float>(v, u) = z > 0.0F ? z : std::nanf("");
    }
  }
  return depth;
}

Labels labelsByOpenCv(const ReferenceSet& set, const DepthView& view, const Detection& detection) {
  const cv::Mat planes = OpenCvPlane(set.camera).detect(metres(view));
  std::array<int, 256> pixels{};
  for (const std::uint8_t plane : cv::Mat_<std::uint8_t>(planes)) ++pixels[plane];
  const auto largest = std::max_element(pixels.begin(), pixels.end() - 1) - pixels.begin();
  return labelsByMask(set, view, detection,
                      [&](int u, int v) { return planes.at<std::uint8_t>(v, u) == largest; });
}

Labels labelsByOrganized(const ReferenceSet& set, const DepthView& view,
                         const Detection& detection) {
  const cv::Mat mask = largestWithPclOrganized(metres(view), set.camera);
  return labelsByMask(set, view, detection,
                      [&](int u, int v) { return mask.at<std::uint8_t>(v, u) != 0; });
}

Labels labelsByRansac(const ReferenceSet& set, const DepthView& view, const Detection& detection) {
  const Eigen::Vector4d plane = detectWithPclRansac(metres(view), set.camera).cast<double>();
  return labelsByMask(set, view, detection, [&](int u, int v) {
    return std::abs(plane.dot(set.point(view, u, v).homogeneous())) <= 0.02;
  });
}

}  // namespace

std::vector<Contestant> contestants(const ReferenceSet& set, bool others) {
  std::vector<Contestant> all;
  all.push_back({"the detector", [](const auto&, const Detection& d) { return d.labels; }});
  for (const int mm : {15, 30}) {
    all.push_back({std::to_string(mm) + " mm over its plane",
                   [&set, mm](const DepthView& view, const Detection& detection) {
                     return labelsByHeight(set, view, detection, 1e-3 * mm);
                   }});
  }
  if (!others) return all;
  const auto add = [&](const char* name, auto labelsBy) {
    all.push_back({name,
                   [&set, labelsBy](const DepthView& view, const Detection& detection) {
                     return labelsBy(set, view, detection);
                   },
                   kMostOfOthers});
  };
  add("OpenCV RgbdPlane", labelsByOpenCv);
  add("PCL OrganizedMultiPlane", labelsByOrganized);
  add("PCL RANSAC", labelsByRansac);
  return all;
}

}  // namespace dominant_plane_detection
