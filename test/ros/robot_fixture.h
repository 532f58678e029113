#pragma once

#include <sensor_msgs/Imu.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <string>

#include "navigation/ground_frame.h"
#include "nodelet_fixture.h"

namespace dominant_plane_detection {

/// Where the camera is on the robot: the base is 0.2 m behind the camera's foot, on the floor.
inline Eigen::Isometry3d cameraInBase(double pitch_error = 0.0, double height_error = 0.0) {
  Eigen::Isometry3d base_from_ground = Eigen::Isometry3d::Identity();
  base_from_ground.translation() = Eigen::Vector3d(0.2, 0.0, height_error);
  Eigen::Isometry3d camera = base_from_ground * groundFromOptical(kUp, kHeight);
  camera.linear() = Eigen::AngleAxisd(pitch_error, Eigen::Vector3d::UnitY()) * camera.linear();
  return camera;
}

/// A table over most of the image, and the floor right of it.
inline sensor_msgs::Image tableBeforeFloor() {
  OwnedDepth<float> depth = planeDepth(testCamera(), kUp, 0.5);
  OwnedDepth<float> floor = planeDepth(testCamera(), kUp, kHeight);
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 440; u < depth.width; ++u) depth.at(u, v) = floor.at(u, v);
  }
  return message(inMillimetres(depth));
}

class Robot : public Nodelet {
 protected:
  Robot() : listener_(buffer_), imus_(node_.advertise<sensor_msgs::Imu>("/imu/data_raw", 50)) {}

  /// A transform that holds until another one is sent.
  void sendFrame(const std::string& parent, const std::string& child,
                 const Eigen::Isometry3d& transform) {
    geometry_msgs::TransformStamped message = tf2::eigenToTransform(transform);
    message.header.frame_id = parent;
    message.header.stamp = ros::Time(1, 0);
    message.child_frame_id = child;
    mounts_.sendTransform(message);
  }
  void sendMount(const Eigen::Isometry3d& camera) { sendFrame("base_link", "optical", camera); }
  /// Images at 30 Hz from a time of their own on, each after its inertial readings.
  /// @param seconds [s] to wait for the answer to each.
  void sendImages(const sensor_msgs::Image& image, int count, bool with_imu = true,
                  double seconds = 20.0) {
    for (int i = 0; i < count; ++i) {
      stamp_ += ros::Duration(1.0 / 30.0);
      if (with_imu) sendImu();
      sensor_msgs::Image stamped = image;
      stamped.header.stamp = stamp_;
      stamped.header.frame_id = frame_;
      sensor_msgs::CameraInfo info = cameraInfo();
      info.header = stamped.header;
      infos_.publish(info);
      images_.publish(stamped);
      // One after the other, so that none is overtaken.
      spinUntil([&] { return answered_ == nullptr || answered_() == stamp_; }, seconds);
    }
  }
  void sendImu() {
    sensor_msgs::Imu imu;
    imu.header.stamp = stamp_;
    imu.header.frame_id = "optical";
    imu.orientation_covariance[0] = -1.0;
    imu.angular_velocity_covariance[0] = -1.0;
    imu.linear_acceleration.x = 9.81 * kUp.x();
    imu.linear_acceleration.y = 9.81 * kUp.y();
    imu.linear_acceleration.z = 9.81 * kUp.z();
    imus_.publish(imu);
  }
  /// Sends an image until a detection's last answer is what is waited for.
  template <typename Condition>
  bool sendUntil(const Listener<DominantPlane>& planes, const sensor_msgs::Image& image,
                 Condition&& condition) {
    answered_ = [&] { return planes.size() > 0 ? planes.last()->header.stamp : ros::Time(); };
    const ros::SteadyTime end = ros::SteadyTime::now() + ros::WallDuration(20.0 * patience());
    while (ros::SteadyTime::now() < end) {
      sendImages(image, 1, true, 0.2);  // the first may come before the detection listens
      if (planes.size() > 0 && condition(*planes.last())) return true;
    }
    return false;
  }
  template <typename... Listeners>
  bool ready(const Listeners&... listeners) {
    return spinUntil([&] { return (listeners.connected() && ...); }) && waitForSubscription();
  }
  static bool isFrom(const DominantPlane& plane, std::uint8_t source, double distance) {
    return plane.state == DominantPlane::FOUND && plane.up_source == source &&
           std::abs(plane.distance - distance) < 0.005;
  }

  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
  tf2_ros::StaticTransformBroadcaster mounts_;
  ros::Publisher imus_;
  ros::Time stamp_ = nextStamp();
  std::string frame_ = "optical";  ///< of the images
  std::function<ros::Time()> answered_;
};

}  // namespace dominant_plane_detection
