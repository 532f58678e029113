// What the nodelet says of itself in /diagnostics.

#include <diagnostic_msgs/DiagnosticStatus.h>

#include "nodelet_fixture.h"
#include "support/diagnostics.h"

namespace dominant_plane_detection {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr const char* kName = "plane_detection: detection";

class NodeletDiagnostics : public Nodelet {
 protected:
  Diagnostics diagnostics_{node_};
};

TEST_F(NodeletDiagnostics, IdleIsWellAndSoAreImagesWithAPlane) {
  ASSERT_TRUE(diagnostics_.waitFor(kName, DiagnosticStatus::OK, "idle"));
  const std::string unusable = diagnostics_.value(kName, "dropped images, unusable");
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  ASSERT_TRUE(waitForSubscription());
  // Ten images a second.
  EXPECT_TRUE(spinUntil([&] {
    detect(planes, image_);
    spinUntil([] { return false; }, 0.1);
    const auto status = diagnostics_.of(kName);
    return status && status->level == DiagnosticStatus::OK &&
           status->message.rfind("a plane in", 0) == 0;
  })) << diagnostics_.message(kName);
  EXPECT_EQ(diagnostics_.value(kName, "state of the last image"), "FOUND");
  EXPECT_GT(std::stod(diagnostics_.value(kName, "rate [1/s]")), 0.5);
  EXPECT_GT(std::stod(diagnostics_.value(kName, "time an image, mean [ms]")), 0.0);
  EXPECT_EQ(diagnostics_.value(kName, "dropped images, unusable"), unusable);
}

TEST_F(NodeletDiagnostics, NoPlaneIsSaidWithItsReason) {
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  ASSERT_TRUE(waitForSubscription());
  sensor_msgs::Image empty = image_;
  std::fill(empty.data.begin(), empty.data.end(), 0);
  EXPECT_TRUE(spinUntil([&] {
    detect(planes, empty);
    return diagnostics_.waitFor(kName, DiagnosticStatus::WARN, "no plane: None of 640 x 480", 0.1);
  })) << diagnostics_.message(kName);
  EXPECT_EQ(diagnostics_.value(kName, "state of the last image"), "NO_DEPTH");
}

TEST_F(NodeletDiagnostics, UnusableImagesAreCountedAndSaid) {
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  ASSERT_TRUE(waitForSubscription());
  sensor_msgs::Image bad = image_;
  bad.encoding = "bayer_rggb8";
  EXPECT_TRUE(spinUntil([&] {
    send(bad);
    return diagnostics_.waitFor(kName, DiagnosticStatus::WARN, "got 'bayer_rggb8'", 0.1);
  })) << diagnostics_.message(kName);
  EXPECT_NE(diagnostics_.value(kName, "dropped images, unusable"), "0");
}

TEST_F(NodeletDiagnostics, SilenceIsSaidEachTimeItBegins) {
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  ASSERT_TRUE(waitForSubscription());
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(
        diagnostics_.waitFor(kName, DiagnosticStatus::ERROR, "Nothing comes on /depth/image_raw"))
        << diagnostics_.message(kName);
    expectTruth(detect(planes, image_));
    EXPECT_TRUE(diagnostics_.waitFor(kName, DiagnosticStatus::OK, ""));
  }
}

TEST_F(NodeletDiagnostics, ImagesWithoutAnyCameraInfoAreSaid) {
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  ASSERT_TRUE(waitForSubscription());
  EXPECT_TRUE(spinUntil([&] {
    image_.header.stamp = nextStamp();
    image_.header.frame_id = "optical";
    images_.publish(image_);
    return diagnostics_.waitFor(kName, DiagnosticStatus::ERROR,
                                "Images come on /depth/image_raw, but no camera_info", 0.1);
  })) << diagnostics_.message(kName);
  EXPECT_EQ(planes.size(), 0U);
}

/// It used to end the manager, with everything in it.
TEST_F(NodeletDiagnostics, ATransportThatDoesNotExistIsSaidAndTriedAgain) {
  constexpr const char* kOther = "transport_detection: detection";
  Listener<DominantPlane> planes(node_, "/transport_detection/plane");
  ASSERT_TRUE(
      diagnostics_.waitFor(kOther, DiagnosticStatus::ERROR, "cannot subscribe: Unable to load"))
      << diagnostics_.message(kOther);
  EXPECT_EQ(images_.getNumSubscribers(), 0U);
  node_.setParam("/transport_detection/image_transport", "raw");
  ASSERT_TRUE(waitForSubscription());
  expectTruth(detect(planes, image_));
  node_.setParam("/transport_detection/image_transport", "no_such_transport");
}

}  // namespace
}  // namespace dominant_plane_detection
