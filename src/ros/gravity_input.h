#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/Imu.h>

#include <optional>
#include <string>

#include "prior/gravity_filter.h"
#include "prior/turn_history.h"
#include "ros/robot_frames.h"

namespace dominant_plane_detection {

/// Up and turns of the camera, by an inertial sensor that is fixed to it (REP 145). Where it has an
/// orientation of its own that agrees with what it feels, that tells up.
///
/// All of it happens in the thread of the node's callback queue.
class GravityInput {
 public:
  /// @param node `imu/data` and `imu/data_raw` are relative to it; of both the first is taken.
  GravityInput(const ros::NodeHandle& node, RobotFrames& frames) : node_(node), frames_(frames) {}

  void subscribe();
  void unsubscribe();
  /// Begins anew.
  void reset();

  /// @param optical_frame in which up is wanted.
  /// @return nothing where nothing comes, or is not of the time.
  std::optional<Up> up(const std::string& optical_frame, const ros::Time& stamp);
  /// @return why `up` had none although messages should come; empty where nobody sends any.
  const std::string& problem() const { return problem_; }
  /// @return R_from_to of the optical frame; nothing without a gyroscope.
  std::optional<Eigen::Quaterniond> turn(const std::string& optical_frame, double from, double to);

 private:
  void onImu(const sensor_msgs::Imu& imu);
  std::optional<Eigen::Quaterniond> toOptical(const std::string& optical_frame);

  ros::NodeHandle node_;
  RobotFrames& frames_;
  ros::Subscriber data_, raw_;
  std::optional<std::string> frame_;  ///< of the messages; nothing: none has come
  std::optional<double> data_stamp_;  ///< [s] of the last message of imu/data
  GravityFilter filter_;
  TurnHistory turns_;
  /// Up in the sensor's frame, of the last message that has an orientation.
  std::optional<Eigen::Vector3d> by_orientation_;
  std::string problem_;
};

}  // namespace dominant_plane_detection
