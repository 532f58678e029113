#include <dominant_plane_detection/DominantPlane.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/distortion_models.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>

#include "dominant_plane_detection/detection.h"
#include "recording_writer.h"

namespace dominant_plane_detection {
namespace {

constexpr double kStart = 1.6e9;  // [s] stamp of the first image
constexpr const char* kFrameId = "camera_depth_optical_frame";

sensor_msgs::CameraInfo cameraInfo(const CameraModel& camera) {
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  info.D.assign(5, 0.0);
  info.K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

template <typename Pixels>
sensor_msgs::Image imageMessage(const std_msgs::Header& header, const Rendering& rendering,
                                const std::string& encoding, const Pixels& pixels) {
  sensor_msgs::Image image;
  image.header = header;
  image.encoding = encoding;
  image.width = static_cast<std::uint32_t>(rendering.width);
  image.height = static_cast<std::uint32_t>(rendering.height);
  const std::size_t bytes = pixels.size() * sizeof(pixels[0]);
  image.step = static_cast<std::uint32_t>(bytes / image.height);
  const auto* data = reinterpret_cast<const std::uint8_t*>(pixels.data());
  image.data.assign(data, data + bytes);
  return image;
}

DominantPlane truthMessage(const std_msgs::Header& header, const Rendering& rendering) {
  DominantPlane plane;
  plane.header = header;
  plane.state = DominantPlane::FOUND;
  plane.normal.x = rendering.normal.x();
  plane.normal.y = rendering.normal.y();
  plane.normal.z = rendering.normal.z();
  plane.distance = rendering.distance;
  plane.inliers = static_cast<std::uint32_t>(std::count(
      rendering.labels.begin(), rendering.labels.end(), static_cast<std::uint8_t>(Label::kGround)));
  return plane;
}

class BagWriter : public RecordingWriter {
 public:
  BagWriter(const std::string& file, const CameraModel& camera)
      : bag_(file, rosbag::bagmode::Write), info_(cameraInfo(camera)) {
    bag_.setCompression(rosbag::compression::LZ4);
  }

  void write(const RecordedFrame& frame) override {
    std_msgs::Header header;
    header.stamp = ros::Time(kStart) + ros::Duration(frame.time);
    header.frame_id = kFrameId;
    info_.header = header;
    const auto& rendering = frame.rendering;
    namespace encodings = sensor_msgs::image_encodings;
    bag_.write("/camera/depth/camera_info", header.stamp, info_);
    bag_.write("/camera/depth/image_raw", header.stamp,
               imageMessage(header, rendering, encodings::TYPE_16UC1, frame.depth));
    bag_.write("/camera/rgb/image_raw", header.stamp,
               imageMessage(header, rendering, encodings::RGB8, rendering.colour));
    bag_.write("/truth/plane", header.stamp, truthMessage(header, rendering));
  }

 private:
  rosbag::Bag bag_;
  sensor_msgs::CameraInfo info_;
};

}  // namespace

std::unique_ptr<RecordingWriter> openBagWriter(const std::string& file, const CameraModel& camera) {
  return std::make_unique<BagWriter>(file, camera);
}

}  // namespace dominant_plane_detection
