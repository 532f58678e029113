// A damaged .oni recording may end the process that plays it; that is not the detection's.

#include <dominant_plane_detection/DominantPlane.h>
#include <nodelet/NodeletList.h>

#include <filesystem>

#include "nodelet_fixture.h"
#include "support/oni_recording.h"

namespace dominant_plane_detection {
namespace {

namespace fs = std::filesystem;

/// @return the nodelets of a manager; none where it does not answer.
std::vector<std::string> nodeletsOf(const std::string& manager) {
  nodelet::NodeletList call;
  return ros::service::call(manager + "/list", call) ? call.response.nodelets
                                                     : std::vector<std::string>();
}

TEST(DamagedRecording, EndsItsOwnManagerAlone) {
  const std::string manager = "/camera/camera_nodelet_manager";
  const std::string player = manager + "_of_recording";
  const std::vector<std::string> detection = {"/camera/plane_detection"};
  ASSERT_TRUE(spinUntil([&] { return nodeletsOf(manager) == detection; }));
  ASSERT_TRUE(
      spinUntil([&] { return nodeletsOf(player) == std::vector<std::string>{"/camera/driver"}; }));

  ros::NodeHandle node("/camera");
  Listener<DominantPlane> planes(node, "plane_detection/plane");
  std::string file;
  ASSERT_TRUE(node.getParam("driver/device_id", file));
  const std::string whole = file + ".whole.oni";
  recordOni("virtual://rubbish_bin?serial=DAMAGED&noise=0", whole, 10);
  // In the name of a property, for whose letters OpenNI2's player has a table.
  flipBit(whole, "xnMapOutputMode", 7, 7);
  fs::rename(whole, file);  // at once, as the driver waits for it
  // Where OpenNI2's player learns to refuse such a file this test loses its subject.
  ASSERT_TRUE(spinUntil([&] { return nodeletsOf(player).empty(); }, 60.0))
      << "the recording's manager has not ended";
  fs::remove(file);

  EXPECT_EQ(nodeletsOf(manager), detection);
  ros::Publisher images = node.advertise<sensor_msgs::Image>("depth/image_raw", 10);
  ros::Publisher infos = node.advertise<sensor_msgs::CameraInfo>("depth/camera_info", 10);
  ASSERT_TRUE(
      spinUntil([&] { return images.getNumSubscribers() > 0 && infos.getNumSubscribers() > 0; }));
  sensor_msgs::Image image = message(inMillimetres(sceneMetres()));
  image.header.stamp = ros::Time::now();
  sensor_msgs::CameraInfo info = cameraInfo();
  info.header.stamp = image.header.stamp;
  infos.publish(info);
  images.publish(image);
  ASSERT_TRUE(spinUntil([&] { return planes.size() > 0; }));
  EXPECT_EQ(planes.last()->state, DominantPlane::FOUND) << planes.last()->reason;
  EXPECT_NEAR(planes.last()->distance, kHeight, 0.001);
}

}  // namespace
}  // namespace dominant_plane_detection
