// A camera's fixed error, learned by the running nodelet.

#include <nodelet/NodeletLoad.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "calibration/depth_correction_file.h"
#include "nodelet_fixture.h"

namespace dominant_plane_detection {
namespace {

namespace fs = std::filesystem;

class LearnCorrection : public Nodelet {
 protected:
  LearnCorrection()
      : file_((fs::temp_directory_path() / ("learn_correction_" + std::to_string(getpid())))
                  .string()) {}
  ~LearnCorrection() override { fs::remove(file_); }

  /// Loads a detection nodelet that learns.
  bool load(const std::string& name) {
    node_.setParam("/" + name + "/learn_correction", file_);
    nodelet::NodeletLoad load;
    load.request.name = "/" + name;
    load.request.type = "dominant_plane_detection/PlaneDetection";
    return ros::service::waitForService("/manager/load_nodelet", 20000) &&
           ros::service::call("/manager/load_nodelet", load) && load.response.success;
  }
  /// @return a floor as seen by a camera with an error of so much [1/m] that is fixed to its
  /// pixels.
  static sensor_msgs::Image floor(int number, double size) {
    OwnedDepth<float> depth =
        planeDepth(testCamera(), upOf(0.5 + 0.005 * number, 0.1), 0.7 + 0.005 * number);
    shiftInverseDepth(depth, [&](int u, int v) { return size * fixedError(u, v); });
    return message(inMillimetres(depth));
  }

  std::string file_;
};

/// Nobody listens to its outputs: it wants the images itself, one a second, and writes after sixty.
TEST_F(LearnCorrection, WritesAFileAfterAMinuteOfImages) {
  ASSERT_TRUE(load("learning_detection"));
  ASSERT_TRUE(waitForSubscription());
  // One at a time: what the node has not looked at yet a newer image takes the place of.
  int sent = 0;
  ASSERT_TRUE(spinUntil([&] {
    send(floor(sent % 80, 0.005));
    ++sent;
    return fs::exists(file_);
  }));
  EXPECT_GE(sent, 60);
  ASSERT_TRUE(spinUntil([&] {
    try {
      loadDepthCorrection(file_);
      return true;
    } catch (const std::runtime_error&) {
      return false;  // it is being written
    }
  }));
  const DepthCorrection correction = loadDepthCorrection(file_);
  double most = 0.0;
  for (const double c : correction.grid().inverse_depth) most = std::max(most, std::abs(c));
  EXPECT_GT(most, 0.003);
  EXPECT_LT(most, 0.007);
}

}  // namespace
}  // namespace dominant_plane_detection
