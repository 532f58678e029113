#include "ros/driver_outputs.h"

#include <boost/make_shared.hpp>

#include "ros/topic_names.h"

namespace dominant_plane_detection {
namespace {

constexpr std::uint32_t kQueue = 1;

}  // namespace

void DriverOutputs::advertise(const ros::NodeHandle& node, const DriverNames& names,
                              const std::function<void()>& listeners_changed) {
  names_ = names;
  const std::string urls[] = {names.depth_camera_info_url, names.rgb_camera_info_url,
                              names.ir_camera_info_url};
  const auto image_changed =
      [listeners_changed](const image_transport::SingleSubscriberPublisher&) {
        listeners_changed();
      };
  const auto info_changed = [listeners_changed](const ros::SingleSubscriberPublisher&) {
    listeners_changed();
  };
  image_transport::ImageTransport transport(node);
  const auto advertise = [&](const char* topic) {
    return transport.advertiseCamera(topic, kQueue, image_changed, image_changed, info_changed,
                                     info_changed);
  };
  const char* const stream_topics[] = {topics::kDepth, topics::kColour, topics::kInfrared};
  for (const StreamKind kind : kAllStreams) {
    const int i = static_cast<int>(kind);
    calibrations_[i] = std::make_unique<CameraCalibration>(ros::NodeHandle(node, toString(kind)),
                                                           toString(kind), urls[i]);
    streams_[i] = advertise(stream_topics[i]);
  }
  registered_ = advertise(topics::kRegisteredDepth);
}

void DriverOutputs::shutdown() {
  for (auto& publisher : streams_) publisher.shutdown();
  registered_.shutdown();
}

bool DriverOutputs::wants(StreamKind kind) const {
  const std::uint32_t listeners = streams_[static_cast<int>(kind)].getNumSubscribers();
  return listeners > 0 || (kind == StreamKind::kDepth && registered_.getNumSubscribers() > 0);
}

void DriverOutputs::setCamera(const CameraDevice& camera) {
  for (const StreamKind kind : kAllStreams) {
    if (!camera.has(kind)) continue;
    calibration(kind).setCamera(camera.description().serial,
                                camera.stream(kind).horizontalFieldOfView());
  }
}

void DriverOutputs::publish(StreamKind kind, const SensorFrame& frame, const ros::Time& stamp) {
  sensor_msgs::Image& image = *frame.image;
  const bool in_colour = kind == StreamKind::kColour || frame.registered;
  image.header.stamp = stamp;
  image.header.frame_id = in_colour ? names_.rgb_frame_id : names_.depth_frame_id;
  const auto info = boost::make_shared<sensor_msgs::CameraInfo>(
      calibration(in_colour ? StreamKind::kColour : kind).info(image.width, image.height));
  info->header = image.header;
  const auto& publisher = frame.registered ? registered_ : streams_[static_cast<int>(kind)];
  publisher.publish(frame.image, info);
}

}  // namespace dominant_plane_detection
