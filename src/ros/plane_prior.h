#pragma once

#include <optional>
#include <string>

#include "dominant_plane_detection/prior.h"
#include "prior/known_up.h"
#include "prior/mount_watch.h"
#include "prior/plane_track.h"
#include "ros/detection_inputs.h"
#include "ros/gravity_input.h"
#include "ros/node_parameters.h"
#include "ros/robot_frames.h"

namespace dominant_plane_detection {

/// What the robot knows about the plane before an image is looked at, and what the plane then says
/// of the robot's own geometry.
///
/// All of it happens in the thread of the node's callback queue.
class PlanePrior {
 public:
  PlanePrior(const ros::NodeHandle& node, const NodeParameters& parameters, RobotFrames& frames);

  /// While images are looked at.
  void subscribe();
  void unsubscribe();

  Prior of(const DetectionInputs::Frame& frame);
  /// @param frame, detection of the last call of `of`.
  void add(const DetectionInputs::Frame& frame, const Detection& detection);

  /// What diagnostics say.
  struct Status {
    std::string up_source;         ///< in words
    std::string remark;            ///< why something that is wanted is not taken
    std::string mount;             ///< how the mount differs from tf; empty where it does not
    bool mount_is_height = false;  ///< that is of a plane at quite another height
    MountWatch::Heights heights;
    std::string tf_problem;  ///< why tf has nothing of the last image, although it is wanted
    PoseCounts tf;           ///< of all images
    double height = 0.0;     ///< [m] of the camera by the last plane; 0: there was none
    double tf_height = 0.0;  ///< [m] of the camera by tf of the last image; 0: not known
  };
  const Status& status() const { return status_; }

 private:
  /// Something that is wanted and not taken.
  struct Remark {
    std::string text;
    double since = 0.0, last = 0.0;  ///< [s] the first and the last image that had it
  };

  void beginAnewAfterJumps(const std_msgs::Header& header);
  UpChoice::Candidates candidates(const std_msgs::Header& header);
  void forget();
  std::string lasting(double stamp, const std::string& text);
  static void report(std::string& said, const std::string& now);

  NodeParameters parameters_;
  RobotFrames& frames_;
  GravityInput gravity_;
  UpChoice choice_;
  PlaneTrack track_;
  MountWatch mount_;

  std_msgs::Header last_;
  std::optional<Eigen::Isometry3d> camera_;  ///< T_base_camera at the image, from tf of its time
  std::optional<Prior::ExpectedHeight> height_;
  Remark remark_;
  Status status_;
};

}  // namespace dominant_plane_detection
