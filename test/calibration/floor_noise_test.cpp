#include "calibration/floor_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "support/surface_figures.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

const CameraModel kCamera = testCamera();

/// A wall that is called floor: its heights are what its readings lack to z.
void addWall(FloorNoise& noise, double z, const std::function<double(int u, int v)>& error) {
  OwnedDepth<float> depth(kCamera.width, kCamera.height);
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) depth.at(u, v) = static_cast<float>(z + error(u, v));
  }
  Detection detection;
  detection.state = State::kFound;
  detection.normal = {0.0, 0.0, -1.0};
  detection.distance = z;
  detection.image_width = depth.width;
  detection.image_height = depth.height;
  detection.labels.assign(depth.pixels.size(), static_cast<std::uint8_t>(Label::kGround));
  noise.add(depth.view(), kCamera, detection);
}

std::function<double(int, int)> white(double sigma) {
  return [sigma, generator = std::mt19937(3), gauss = std::normal_distribution<double>()](
             int, int) mutable { return sigma * gauss(generator); };
}

TEST(FloorNoise, IndependentErrorsAverageOut) {
  FloorNoise noise;
  addWall(noise, 1.25, white(0.004));
  const FloorNoiseFigures figures = noise.figures()[1];
  EXPECT_EQ(figures.nearest, 1.0);
  EXPECT_EQ(figures.farthest, 1.5);
  EXPECT_GT(figures.readings, 250000U / 16U);  // the window at the border is not full
  EXPECT_NEAR(figures.height, 0.004, 0.0001);
  EXPECT_NEAR(figures.neighbour, 0.004, 0.0001);
  // Blocks of 16 pixels, less the mean of 49 of them.
  EXPECT_NEAR(figures.local, 0.001 * std::sqrt(48.0 / 49.0), 0.00004);
  EXPECT_LT(figures.smooth, 0.0001);
}

/// A half is 5 mm nearer, a half 5 mm farther.
TEST(FloorNoise, LargePartsAreSmooth) {
  FloorNoise noise;
  addWall(noise, 1.25, [](int u, int) { return u < 320 ? -0.005 : 0.005; });
  const FloorNoiseFigures figures = noise.figures()[1];
  EXPECT_NEAR(figures.height, 0.005, 0.0001);
  EXPECT_LT(figures.neighbour, 0.00001);
  EXPECT_LT(figures.local, 0.00001);
  // Most windows are in one of them, and the median is that of normally distributed numbers.
  EXPECT_NEAR(figures.smooth, 0.005 / 0.6745, 0.0001);
}

TEST(FloorNoise, TheModelsGoThroughTheFigures) {
  FloorNoise noise;
  addWall(noise, 1.25, white(0.004));
  EXPECT_THROW(FloorNoise::localError(noise.figures()), std::runtime_error);
  addWall(noise, 2.25, white(0.012));
  EXPECT_EQ(noise.images(), 2U);
  const NoiseModel local = FloorNoise::localError(noise.figures());
  EXPECT_NEAR(local.sigma(1.25), noise.figures()[1].local, 1e-6);
  EXPECT_NEAR(local.sigma(2.25), noise.figures()[3].local, 1e-6);
  EXPECT_NEAR(local.sigma(2.25), 0.003, 0.0001);
  // What falls with the depth is constant.
  FloorNoise falling;
  addWall(falling, 1.25, white(0.012));
  addWall(falling, 2.25, white(0.004));
  EXPECT_EQ(FloorNoise::localError(falling.figures()).quadratic, 0.0);
}

TEST(FloorNoise, WithoutAPlaneAnImageDoesNotCount) {
  FloorNoise noise;
  const OwnedDepth<float> depth(kCamera.width, kCamera.height);
  noise.add(depth.view(), kCamera, Detection());
  EXPECT_EQ(noise.images(), 0U);
  EXPECT_TRUE(std::isnan(noise.figures()[0].height));
}

class SceneNoise : public testing::TestWithParam<ErrorKind> {};

/// The profile that the scenes of test/support are judged with is what is measured on them.
TEST_P(SceneNoise, IsThatOfTheProfile) {
  FloorNoise noise;
  DominantPlaneDetector detector;
  for (std::uint32_t seed = 1; seed <= 16; ++seed) {
    const SurfaceImage image(surfaceScene(FloorKind::kClean, seed), GetParam(), seed);
    noise.add(image.view(), image.camera(), detector.detect(image.view(), image.camera()));
  }
  const NoiseModel measured = FloorNoise::smoothError(noise.figures());
  const NoiseModel used = parametersOf(GetParam()).smooth_error;
  for (const double z : {1.0, 2.0, 3.0}) {
    EXPECT_NEAR(measured.sigma(z) / used.sigma(z), 1.0, 0.3) << z << " m: " << measured.sigma(z);
  }
}

INSTANTIATE_TEST_SUITE_P(Errors, SceneNoise,
                         testing::Values(ErrorKind::kSmooth, ErrorKind::kKinect,
                                         ErrorKind::kRealsense));

}  // namespace
}  // namespace dominant_plane_detection
