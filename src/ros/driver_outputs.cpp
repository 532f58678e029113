#include "ros/driver_outputs.h"

#include <sensor_msgs/Imu.h>

#include <algorithm>
#include <boost/make_shared.hpp>

#include "ros/listeners.h"
#include "ros/topic_names.h"

namespace dominant_plane_detection {
namespace {

constexpr std::uint32_t kQueue = 1;
constexpr double kPrimeSenseBaseline = 0.075;  // [m] of a Kinect and its relatives
// [m/s^2] A Kinect's accelerometer tells the vertical to one degree (Kinect for Windows SDK).
constexpr double kAccelerationSigma = 0.17;

}  // namespace

void DriverOutputs::advertise(const ros::NodeHandle& node, const DriverNames& names,
                              const std::function<void()>& listeners_changed) {
  names_ = names;
  const std::string urls[] = {names.depth_camera_info_url, names.rgb_camera_info_url,
                              names.ir_camera_info_url};
  const auto changed = calledByPublishers(listeners_changed);
  image_transport::ImageTransport transport(node);
  ros::NodeHandle plain = node;
  disparity_ = plain.advertise<sensor_msgs::Image>(topics::kRawDisparity, kQueue, changed, changed);
  projector_ =
      plain.advertise<sensor_msgs::CameraInfo>(topics::kProjector, kQueue, changed, changed);
  imu_ = plain.advertise<sensor_msgs::Imu>(topics::kImu, kQueue, changed, changed);
  const auto advertise = [&](const char* topic) {
    return transport.advertiseCamera(topic, kQueue, changed, changed, changed, changed);
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

bool DriverOutputs::wants(StreamKind kind) const {
  const std::uint32_t listeners = streams_[static_cast<int>(kind)].getNumSubscribers();
  if (listeners > 0 || kind != StreamKind::kDepth) return listeners > 0;
  return registered_.getNumSubscribers() > 0 || projector_.getNumSubscribers() > 0 ||
         wantsRawDisparity();
}

void DriverOutputs::setCamera(const CameraDevice& camera) {
  const double told =
      camera.has(StreamKind::kDepth) ? camera.stream(StreamKind::kDepth).baseline() : 0.0;
  baseline_ = told > 0.0 ? told : kPrimeSenseBaseline;
  for (const StreamKind kind : kAllStreams) {
    if (!camera.has(kind)) continue;
    calibration(kind).setCamera(camera.description().serial,
                                camera.stream(kind).horizontalFieldOfView());
  }
}

void DriverOutputs::publish(StreamKind kind, bool registered, const sensor_msgs::ImagePtr& image,
                            const ros::Time& stamp) {
  const bool in_colour = kind == StreamKind::kColour || registered;
  image->header.stamp = stamp;
  image->header.frame_id = in_colour ? names_.rgb_frame_id : names_.depth_frame_id;
  const auto info = boost::make_shared<sensor_msgs::CameraInfo>(
      cameraInfo(in_colour ? StreamKind::kColour : kind, image->width, image->height));
  info->header = image->header;
  if (kind == StreamKind::kDepth) publishProjector(*image);
  const auto& publisher = registered ? registered_ : streams_[static_cast<int>(kind)];
  publisher.publish(image, info);
}

/// The depth camera's pinhole with the projector beside it, as openni_camera has it: what the right
/// camera of a stereo pair would be. The projector stands to the right of the depth camera,
/// whatever camera the image has been registered to.
void DriverOutputs::publishProjector(const sensor_msgs::Image& depth) {
  if (projector_.getNumSubscribers() == 0) return;
  const auto info = boost::make_shared<sensor_msgs::CameraInfo>(
      cameraInfo(StreamKind::kDepth, depth.width, depth.height));
  info->header.stamp = depth.header.stamp;
  info->header.frame_id = names_.depth_frame_id;
  std::fill(info->D.begin(), info->D.end(), 0.0);
  info->P[3] = -info->P[0] * baseline_;
  projector_.publish(info);
}

/// Depth is seen by the infrared camera, some pixels off: who has calibrated that one has
/// calibrated both.
sensor_msgs::CameraInfo DriverOutputs::cameraInfo(StreamKind kind, std::uint32_t width,
                                                  std::uint32_t height) {
  if (const auto own = calibration(kind).calibrated(width, height)) return *own;
  if (kind == StreamKind::kDepth) {
    const auto infrared = calibration(StreamKind::kInfrared).calibrated(width, height);
    const double scale = width / 640.0;
    if (infrared) {
      return shifted(*infrared, -scale * names_.depth_ir_offset_x,
                     -scale * names_.depth_ir_offset_y);
    }
  }
  return calibration(kind).uncalibrated(width, height);
}

void DriverOutputs::publishRawDisparity(const sensor_msgs::ImagePtr& raw, const ros::Time& stamp) {
  raw->header.stamp = stamp;
  raw->header.frame_id = names_.depth_frame_id;
  disparity_.publish(raw);
}

void DriverOutputs::publish(const openni2_plugin::Acceleration& acceleration,
                            const ros::Time& stamp) {
  const auto imu = boost::make_shared<sensor_msgs::Imu>();
  imu->header.stamp = stamp;
  imu->header.frame_id = names_.depth_frame_id;
  imu->orientation_covariance[0] = -1.0;
  imu->angular_velocity_covariance[0] = -1.0;
  imu->linear_acceleration.x = acceleration.x;
  imu->linear_acceleration.y = acceleration.y;
  imu->linear_acceleration.z = acceleration.z;
  for (const std::size_t i : {0, 4, 8}) {
    imu->linear_acceleration_covariance[i] = kAccelerationSigma * kAccelerationSigma;
  }
  imu_.publish(imu);
}

}  // namespace dominant_plane_detection
