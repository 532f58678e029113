// The nodelet's parameters: from the parameter server and through dynamic_reconfigure.

#include <dynamic_reconfigure/Reconfigure.h>

#include <limits>

#include "dominant_plane_detection/parameters.h"
#include "nodelet_fixture.h"
#include "ros/parameter_file.h"
#include "ros/sensor_profiles.h"

namespace dominant_plane_detection {
namespace {

/// 1 / z' = 1 / z - 0.05 / m for all pixels makes another plane of the floor.
TEST_F(Nodelet, DepthIsCorrectedByAFile) {
  Listener<DominantPlane> planes(node_, "/corrected_detection/plane");
  ASSERT_TRUE(waitForSubscription());
  ASSERT_TRUE(spinUntil([&] { return planes.connected(); }));
  const auto plane = detect(planes, image_);
  ASSERT_EQ(plane->state, DominantPlane::FOUND) << plane->reason;
  const Eigen::Vector3d inverse = kUp / kHeight + 0.05 * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(plane->distance, 1.0 / inverse.norm(), 0.002);
  EXPECT_NEAR(plane->normal.z, inverse.normalized().z(), 0.002);
}

/// The profile's numbers, and not those that were there.
TEST_F(Nodelet, TakesTheProfileOfItsSensor) {
  ASSERT_TRUE(ros::service::waitForService("/corrected_detection/set_parameters", 20000));
  Parameters xtion;
  loadParameters(findSensorProfile("xtion"), xtion);
  const auto has = [&](const char* name, double value) {
    double found = 0.0;
    EXPECT_TRUE(node_.getParam(std::string("/corrected_detection/") + name, found));
    EXPECT_EQ(found, value) << name;
  };
  has("noise_constant", xtion.noise.constant);
  has("smooth_error_constant", xtion.smooth_error.constant);
  has("local_error_quadratic", xtion.local_error.quadratic);
  has("wide_error_constant", xtion.wide_error.constant);
  EXPECT_NE(xtion.smooth_error.constant, Parameters().smooth_error.constant);
  has("gamma_sigmas", Parameters().gamma.sigmas);
}

class Reconfigure : public Nodelet {
 protected:
  /// @return the configuration that the node has afterwards.
  dynamic_reconfigure::Config set(const std::string& name, double value) {
    dynamic_reconfigure::ReconfigureRequest request;
    dynamic_reconfigure::ReconfigureResponse response;
    dynamic_reconfigure::DoubleParameter parameter;
    parameter.name = name;
    parameter.value = value;
    request.config.doubles.push_back(parameter);
    EXPECT_TRUE(ros::service::call("/plane_detection/set_parameters", request, response));
    return response.config;
  }
  static double valueOf(const dynamic_reconfigure::Config& config, const std::string& name) {
    for (const auto& parameter : config.doubles) {
      if (parameter.name == name) return parameter.value;
    }
    return std::numeric_limits<double>::quiet_NaN();
  }
};

TEST_F(Reconfigure, StartsFromTheParameterServerWithoutWhatWasWrong) {
  ASSERT_TRUE(ros::service::waitForService("/plane_detection/set_parameters", 20000));
  double range_max = 0.0;
  int seeds = 0;
  std::string algorithm;
  ASSERT_TRUE(node_.getParam("/plane_detection/range_max", range_max));
  ASSERT_TRUE(node_.getParam("/plane_detection/seeds", seeds));
  ASSERT_TRUE(node_.getParam("/plane_detection/algorithm", algorithm));
  EXPECT_EQ(range_max, 3.9);
  EXPECT_EQ(seeds, Parameters().seeds);
  EXPECT_EQ(algorithm, "grid");
}

TEST_F(Reconfigure, TakesEffectAndRefusesCombinationsThatCannotBe) {
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  ASSERT_TRUE(waitForSubscription());
  const auto far = detect(planes, image_);
  expectTruth(far);
  EXPECT_EQ(valueOf(set("range_max", 1.4), "range_max"), 1.4);
  const auto near = detect(planes, image_);
  expectTruth(near);
  EXPECT_LT(near->inliers, far->inliers * 3 / 4);
  // Beyond range_max: refused, and the old values go back to whoever asked.
  EXPECT_EQ(valueOf(set("range_min", 2.0), "range_min"), 0.5);
  EXPECT_EQ(detect(planes, image_)->inliers, near->inliers);
  EXPECT_EQ(valueOf(set("range_max", 3.9), "range_max"), 3.9);
  EXPECT_EQ(detect(planes, image_)->inliers, far->inliers);
}

}  // namespace
}  // namespace dominant_plane_detection
