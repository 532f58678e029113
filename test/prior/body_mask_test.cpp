#include "prior/body_mask.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/synthetic_depth.h"
#include "synthetic/camera_path.h"

namespace dominant_plane_detection {
namespace {

/// A camera 0.5 m over the floor that looks down by 40 degrees.
const Eigen::Isometry3d kCamera = KeyPose{0.0, {0.1, 0.0, 0.5}, 0.0, 0.7, 0.0}.pose();

template <typename Pixel>
class BodyMaskOf : public testing::Test {};
using Pixels = testing::Types<std::uint16_t, float>;
TYPED_TEST_SUITE(BodyMaskOf, Pixels);

/// Everything in the boxes goes and nothing else, by the points' own places.
TYPED_TEST(BodyMaskOf, ReadingsInTheBoxesAreTaken) {
  const CameraModel camera = testCamera(160, 120);
  const Eigen::Vector3d up = kCamera.linear().transpose() * Eigen::Vector3d::UnitZ();
  const OwnedDepth<float> metres = planeDepth(camera, up, 0.5);
  OwnedDepth<TypeParam> depth(160, 120);
  const float scale = sizeof(TypeParam) == 2 ? 1000.0F : 1.0F;
  for (std::size_t i = 0; i < metres.pixels.size(); ++i) {
    depth.pixels[i] = static_cast<TypeParam>(scale * metres.pixels[i]);
  }
  RayTable rays;
  rays.build(camera);
  const std::vector<BodyMask::Box> boxes = {
      {Eigen::Vector3d(0.5, -0.1, -0.1), Eigen::Vector3d(0.8, 0.05, 0.2)},
      {Eigen::Vector3d(0.6, 0.2, -0.1), Eigen::Vector3d(0.7, 0.3, 0.2)}};
  BodyMask mask(boxes);
  const DepthView masked = mask.mask(depth.view(), rays, kCamera);
  int taken = 0;
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) {
      const double z = static_cast<double>(metresAt(depth.view(), u, v));
      const Eigen::Vector3d at = kCamera * Eigen::Vector3d(z * camera.ray({u, v}).homogeneous());
      const bool inside = z > 0.0 && (boxes[0].contains(at) || boxes[1].contains(at));
      const double border = std::min(boxes[0].exteriorDistance(at), boxes[1].exteriorDistance(at));
      if (!inside && border < 1e-4) continue;  // as near as floats tell
      taken += inside;
      ASSERT_EQ(metresAt(masked, u, v), inside ? 0.001F : metresAt(depth.view(), u, v))
          << u << " " << v;
    }
  }
  EXPECT_GT(taken, 200);
}

TEST(BodyMask, WithoutTheBodyInViewTheImageIsNotCopied) {
  const CameraModel camera = testCamera(160, 120);
  const OwnedDepth<float> depth = planeDepth(camera, upOf(0.7), 0.5);
  RayTable rays;
  rays.build(camera);
  BodyMask none;
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.mask(depth.view(), rays, kCamera).data, depth.view().data);
  BodyMask elsewhere({{Eigen::Vector3d(5, 5, 0), Eigen::Vector3d(6, 6, 1)}});
  EXPECT_FALSE(elsewhere.empty());
  EXPECT_EQ(elsewhere.mask(depth.view(), rays, kCamera).data, depth.view().data);
  BodyMask behind({{Eigen::Vector3d(-2, -1, 0), Eigen::Vector3d(-1, 1, 0.4)}});
  EXPECT_EQ(behind.mask(depth.view(), rays, kCamera).data, depth.view().data);
}

/// A box that reaches behind the camera may be anywhere in the image, and one that a bent lens sees
/// is where no corner tells.
TEST(BodyMask, BoxesAboutTheCameraAndBentLensesAreLookedForEverywhere) {
  CameraModel camera = testCamera(160, 120);
  for (const bool bent : {false, true}) {
    if (bent) {
      camera.distortion = DistortionModel::kPlumbBob;
      camera.coefficients[0] = 0.5;
    }
    const BodyMask::Box box =
        bent ? BodyMask::Box(Eigen::Vector3d(0.6, 0.15, -0.01), Eigen::Vector3d(0.8, 0.3, 0.01))
             : BodyMask::Box(Eigen::Vector3d(-0.5, -0.1, -0.1), Eigen::Vector3d(0.6, 0.1, 0.2));
    const Eigen::Vector3d up = kCamera.linear().transpose() * Eigen::Vector3d::UnitZ();
    RayTable rays;
    rays.build(camera);
    OwnedDepth<float> depth(160, 120);
    int inside = 0, taken = 0;
    for (int v = 0; v < 120; ++v) {
      for (int u = 0; u < 160; ++u) {
        const Eigen::Vector3d ray = rays.ray(u, v).cast<double>();
        const double z = -0.5 / up.dot(ray);
        depth.at(u, v) = z > 0.0 ? static_cast<float>(z) : 0.0F;
        inside += z > 0.0 && box.contains(Eigen::Vector3d(kCamera * Eigen::Vector3d(z * ray)));
      }
    }
    BodyMask mask({box});
    const DepthView masked = mask.mask(depth.view(), rays, kCamera);
    for (int v = 0; v < 120; ++v) {
      for (int u = 0; u < 160; ++u) {
        taken += metresAt(masked, u, v) != metresAt(depth.view(), u, v);
      }
    }
    EXPECT_GT(inside, 20);
    EXPECT_NEAR(taken, inside, 2);
  }
}

}  // namespace
}  // namespace dominant_plane_detection
