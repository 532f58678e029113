#include "support/halves.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = 0.017453292519943295;

/// A set of one image whose left half shows one plane and whose right half another.
ReferenceSet halvesOf(const Eigen::Vector3d& left_up, double left_height,
                      const Eigen::Vector3d& right_up, double right_height) {
  ReferenceSet set;
  set.camera = testCamera();
  const auto left = inMillimetres(planeDepth(set.camera, left_up, left_height));
  auto both = inMillimetres(planeDepth(set.camera, right_up, right_height));
  for (int v = 0; v < both.height; ++v) {
    for (int u = 0; u < both.width / 2; ++u) {
      both.at(u, v) = left.pixels[static_cast<std::size_t>(v * both.width + u)];
    }
  }
  ReferenceImage image;
  image.depth = cv::Mat(both.height, both.width, CV_16UC1, both.pixels.data()).clone();
  set.images.push_back(image);
  return set;
}

TEST(Halves, OfOnePlaneAreEqual) {
  const ReferenceSet set = halvesOf(upOf(0.5), 0.8, upOf(0.5), 0.8);
  const HalvesSummary summary = compareHalves(set, Algorithm::kGrid);
  EXPECT_EQ(summary.found, 1U);
  EXPECT_LT(summary.angle, 0.02 * kDegree);
  EXPECT_LT(summary.height, 0.0003);
}

TEST(Halves, OfTwoPlanesDifferByWhatThePlanesDo) {
  const ReferenceSet set = halvesOf(upOf(0.5), 0.8, upOf(0.5 + 2.0 * kDegree), 0.82);
  const cv::Mat before = set.images.front().depth.clone();
  const HalvesSummary summary = compareHalves(set, Algorithm::kGrid);
  EXPECT_EQ(summary.found, 1U);
  EXPECT_NEAR(summary.angle, 2.0 * kDegree, 0.03 * kDegree);
  EXPECT_NEAR(summary.height, 0.02, 0.0005);
  EXPECT_EQ(cv::countNonZero(before != set.images.front().depth), 0) << "the image is not touched";
}

TEST(Halves, WithoutAPlaneInOneHalfAreNotCompared) {
  ReferenceSet set = halvesOf(upOf(0.5), 0.8, upOf(0.5), 0.8);
  set.images.front().depth.colRange(0, 320).setTo(0);
  const HalvesSummary summary = compareHalves(set, Algorithm::kGrid);
  EXPECT_EQ(summary.images, 1U);
  EXPECT_EQ(summary.found, 0U);
}

}  // namespace
}  // namespace dominant_plane_detection
