// What the detector calls ground, and what it does not.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "support/detector_fixture.h"

namespace dominant_plane_detection {
namespace {

INSTANTIATE_TEST_SUITE_P(Algorithms, DetectorAlgorithm,
                         testing::Values(Algorithm::kGrid, Algorithm::kKdtree));

TEST_P(DetectorAlgorithm, HolesDoNotMatter) {
  const CameraModel camera = testCamera();
  DominantPlaneDetector detector(parameters_);
  for (const double holes : {0.25, 0.5, 0.75}) {
    OwnedDepth<std::uint16_t> depth = inMillimetres(planeDepth(camera, kUp, kHeight), 1.425e-3);
    std::mt19937 generator(7);
    std::bernoulli_distribution lost(holes);
    for (auto& pixel : depth.pixels) pixel = lost(generator) ? std::uint16_t{0} : pixel;
    const Detection& detection = detector.detect(depth.view(), camera);
    ASSERT_TRUE(detection.found()) << holes << " " << detection.reason;
    EXPECT_LT(angle(detection.normal, kUp), 0.002);
    EXPECT_NEAR(detection.distance, kHeight, 0.002);
    EXPECT_GT(detection.inlierShare(), 0.98) << holes;
  }
}

TEST_P(DetectorAlgorithm, TheMeanSquareErrorIsThatOfTheInliers) {
  const CameraModel camera = testCamera();
  // Specks at the floor's height where a wall stands are no inliers.
  OwnedDepth<float> scene = planeDepth(camera, kUp, kHeight);
  for (int v = 0; v < 300; ++v) {
    for (int u = 0; u < 640; ++u) {
      if ((u / 8 + v / 8) % 5 != 0) scene.at(u, v) = 0.9F;
    }
  }
  const auto depth = inMillimetres(scene, 1.425e-3);
  DominantPlaneDetector detector(parameters_);
  const Detection& detection = detector.detect(depth.view(), camera);
  ASSERT_TRUE(detection.found()) << detection.reason;
  double sum = 0.0;
  std::size_t inliers = 0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      if (detection.label(u, v) != Label::kGround) continue;
      const double z = static_cast<double>(metresAt(depth.view(), u, v));
      const Eigen::Vector2d ray = camera.ray({u, v});
      const double h = detection.height({z * ray.x(), z * ray.y(), z});
      sum += h * h;
      ++inliers;
    }
  }
  EXPECT_EQ(detection.inliers, inliers);
  EXPECT_NEAR(detection.mean_square_error * static_cast<double>(inliers) / sum, 1.0, 1e-3);
}

TEST_P(DetectorAlgorithm, AnImageOnItsHeadWithItsUpIsTheSameImage) {
  const CameraModel camera = testCamera();
  const auto depth = inMillimetres(cutFloor(camera), 1.425e-3);
  OwnedDepth<std::uint16_t> turned = depth;
  std::reverse(turned.pixels.begin(), turned.pixels.end());
  Prior prior;
  prior.expected_up = Eigen::Vector3d::UnitY();
  DominantPlaneDetector detector(parameters_);
  const Detection upright = detector.detect(depth.view(), camera);
  const Detection& detection = detector.detect(turned.view(), camera, prior);
  ASSERT_TRUE(detection.found()) << detection.reason;
  EXPECT_NEAR(detection.distance, upright.distance, 1e-3);
  EXPECT_LT(angle(detection.normal, {-kUp.x(), -kUp.y(), kUp.z()}), 0.001);
  EXPECT_NEAR(static_cast<double>(detection.inliers) / static_cast<double>(upright.inliers), 1.0,
              0.01);
}

TEST_P(DetectorAlgorithm, PiecesBeyondAGapJoinIfTheyMay) {
  const CameraModel camera = testCamera();
  const auto depth = inMillimetres(cutFloor(camera));
  parameters_.join_pieces = false;
  DominantPlaneDetector detector(parameters_);
  const Detection& detection = detector.detect(depth.view(), camera);
  ASSERT_TRUE(detection.found()) << detection.reason;
  EXPECT_EQ(detection.label(320, 450), Label::kGround);
  EXPECT_EQ(detection.label(320, 150), Label::kUnknown);
}

/// A table top, and behind it a wall that rises from below its height to above.
TEST_P(DetectorAlgorithm, AWallIsNoGroundAtTheGroundsHeight) {
  const CameraModel camera = testCamera();
  OwnedDepth<float> scene = planeDepth(camera, kUp, kHeight);
  std::size_t at_height = 0, called_ground = 0;
  std::vector<bool> stripe(scene.pixels.size());
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      float& z = scene.at(u, v);
      if (z > 0.0F && z < 1.7F) continue;
      z = 3.0F;
      const Eigen::Vector2d ray = camera.ray({u, v});
      const double height = 3.0 * kUp.dot(Eigen::Vector3d(ray.x(), ray.y(), 1.0)) + kHeight;
      stripe[static_cast<std::size_t>(v * 640 + u)] = std::abs(height) < 0.03;
    }
  }
  const auto depth = inMillimetres(scene, 1e-3);
  DominantPlaneDetector detector(parameters_);
  const Detection& detection = detector.detect(depth.view(), camera);
  ASSERT_TRUE(detection.found()) << detection.reason;
  EXPECT_LT(angle(detection.normal, kUp), 0.003);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      if (!stripe[static_cast<std::size_t>(v * 640 + u)]) continue;
      ++at_height;
      called_ground += detection.label(u, v) == Label::kGround;
    }
  }
  EXPECT_GT(at_height, 4000U);
  EXPECT_EQ(called_ground, 0U);
}

TEST_P(DetectorAlgorithm, SmallImages) {
  parameters_.subsampling = 1;
  DominantPlaneDetector detector(parameters_);
  for (const int width : {64, 80, 160}) {
    const CameraModel camera = testCamera(width, width * 3 / 4);
    const auto depth = inMillimetres(planeDepth(camera, kUp, kHeight), 1.425e-3);
    const Detection& detection = detector.detect(depth.view(), camera);
    ASSERT_TRUE(detection.found()) << width << " " << detection.reason;
    EXPECT_LT(angle(detection.normal, kUp), 0.01) << width;
    EXPECT_NEAR(detection.distance, kHeight, 0.01) << width;
    EXPECT_GT(detection.inlierShare(), 0.98) << width;
  }
}

/// Whatever the image and the parameters, a plane that is found has the ground that it needs.
TEST_P(DetectorAlgorithm, FoundMeansGround) {
  const CameraModel camera = testCamera();
  const auto floor = inMillimetres(planeDepth(camera, kUp, kHeight), 1.425e-3);
  const auto expectGroundOrReason = [](const OwnedDepth<std::uint16_t>& depth,
                                       const Parameters& parameters) {
    DominantPlaneDetector detector(parameters);
    const Detection& detection =
        detector.detect(depth.view(), testCamera(depth.width, depth.height));
    if (detection.found()) {
      EXPECT_GE(static_cast<double>(detection.inliers),
                parameters.min_share * static_cast<double>(detection.valid_pixels));
      EXPECT_GT(detection.inliers, 0U);
    } else {
      EXPECT_FALSE(detection.reason.empty());
    }
    return detection.state;
  };
  parameters_.subsampling = 1;
  for (const int width : {8, 16, 24, 32, 40}) {
    const CameraModel small = testCamera(width, width * 2 / 3);
    expectGroundOrReason(inMillimetres(planeDepth(small, kUp, kHeight)), parameters_);
  }
  parameters_.subsampling = 2;
  OwnedDepth<std::uint16_t> islands = floor;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      if (u % 24 >= 6 || v % 24 >= 4) islands.at(u, v) = 0;
    }
  }
  expectGroundOrReason(islands, parameters_);
  Parameters large = parameters_, no_band = parameters_;
  large.min_patch = 1000000;
  EXPECT_EQ(expectGroundOrReason(floor, large), State::kTooSmall);
  no_band.ground_band.sigmas = 0.0;
  EXPECT_EQ(expectGroundOrReason(floor, no_band), State::kTooSmall);
}

/// Smallest patch and smallest plane scale with the image.
TEST(Detector, MinPatchScalesWithTheImage) {
  Parameters parameters;
  parameters.min_share = 0.0;
  parameters.min_patch = 100000;  // of 307,200 pixels; the floor has 60 % of the image
  for (const int width : {320, 640}) {
    const CameraModel camera = testCamera(width, width * 3 / 4);
    OwnedDepth<float> scene = planeDepth(camera, kUp, kHeight);
    for (int v = 0; v < camera.height * 2 / 5; ++v) {
      for (int u = 0; u < width; ++u) scene.at(u, v) = 0.0F;
    }
    const auto depth = inMillimetres(scene);
    parameters.min_patch = 170000;
    EXPECT_TRUE(DominantPlaneDetector(parameters).detect(depth.view(), camera).found());
    parameters.min_patch = 190000;
    EXPECT_EQ(DominantPlaneDetector(parameters).detect(depth.view(), camera).state,
              State::kTooSmall);
  }
}

TEST(Detector, TheWorkIsCounted) {
  const CameraModel camera = testCamera();
  const auto floor = inMillimetres(planeDepth(camera, kUp, kHeight), 1.425e-3);
  const auto wall = inMillimetres(planeDepth(camera, {0.0, 0.0, -1.0}, 2.0));
  DominantPlaneDetector detector;
  const Effort one = detector.detect(floor.view(), camera).effort;
  EXPECT_EQ(one.seeds, 1U);
  EXPECT_EQ(one.regions, 1U);
  EXPECT_GT(one.joined, 2U * 4000U);  // grown, and decided again
  EXPECT_GT(one.tests, 4000U);
  EXPECT_GT(one.fits, 5U);
  EXPECT_LT(one.fits, 40U);
  const Effort none = detector.detect(OwnedDepth<std::uint16_t>(640, 480).view(), camera).effort;
  EXPECT_EQ(none.seeds + none.regions + none.tests + none.joined + none.fits, 0U);
  // A floor that leaves more than it has, in noise that no region grows from: all seeds are tried,
  // but as ground was found not once more.
  OwnedDepth<std::uint16_t> half = floor;
  std::mt19937 generator(3);
  for (int v = 0; v < 300; ++v) {
    for (int u = 0; u < 640; ++u) {
      half.at(u, v) = static_cast<std::uint16_t>(600 + generator() % 3000);
    }
  }
  ASSERT_TRUE(detector.detect(half.view(), camera).found());
  EXPECT_EQ(detector.detect(half.view(), camera).effort.seeds, 64U);
  // Tilted seeds are not grown while ground is looked for; then the wall is grown once, to say why.
  EXPECT_EQ(detector.detect(wall.view(), camera).effort.regions, 1U);
}

}  // namespace
}  // namespace dominant_plane_detection
