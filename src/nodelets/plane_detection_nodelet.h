#pragma once

#include <dominant_plane_detection/PlaneDetectionConfig.h>
#include <dynamic_reconfigure/server.h>

#include <memory>
#include <optional>
#include <string>

#include "doctor/no_plane_trials.h"
#include "dominant_plane_detection/depth_correction.h"
#include "dominant_plane_detection/dominant_plane_detector.h"
#include "nodelets/periodic_nodelet.h"
#include "ros/box_output.h"
#include "ros/cloud_outputs.h"
#include "ros/correction_learner.h"
#include "ros/detection_diagnostics.h"
#include "ros/detection_inputs.h"
#include "ros/detection_outputs.h"
#include "ros/ground_tf.h"
#include "ros/map_output.h"
#include "ros/mount_service.h"
#include "ros/overlay_output.h"
#include "ros/picture_input.h"
#include "ros/plane_prior.h"
#include "ros/robot_body.h"
#include "ros/robot_frames.h"
#include "ros/scan_output.h"

namespace dominant_plane_detection {

/// The detector as a nodelet: depth and what the robot knows in, plane, mask, overlay, clouds and
/// scan out; idle while nobody listens.
///
/// Everything here happens in the thread of the nodelet's own callback queue, one callback after
/// the other, so that there is no lock: images, pictures, transforms, inertial readings, listeners
/// that come and go, parameters, the timer. A call of `calibrate_mount` waits in a thread of its
/// own (see `MountService`).
class PlaneDetectionNodelet : public PeriodicNodelet {
 public:
  ~PlaneDetectionNodelet() override { stopTimer(); }

 private:
  void start() override;
  void onTimer() override;
  void followListeners();
  void trySubscriptions();
  void onFrame(const DetectionInputs::Frame& frame);
  DetectionInputs::Frame prepared(const DetectionInputs::Frame& frame);
  void detect(const DetectionInputs::Frame& frame);
  std::optional<std::string> groundFrame(const DetectionInputs::Frame& frame,
                                         const Detection& detection);
  void onReconfigure(PlaneDetectionConfig& config);

  std::optional<DepthCorrection> correction_;
  DominantPlaneDetector detector_;
  NoPlaneTrials trials_{Parameters()};
  RayTable rays_;  ///< of the images' camera
  std::unique_ptr<RobotFrames> frames_;
  std::unique_ptr<RobotBody> body_;
  std::unique_ptr<PlanePrior> prior_;
  std::unique_ptr<PictureInput> pictures_;
  DetectionOutputs outputs_{rays_};
  std::unique_ptr<OverlayOutput> overlay_;
  std::unique_ptr<CloudOutputs> clouds_;
  std::unique_ptr<GroundTf> ground_tf_;
  std::unique_ptr<ScanOutput> scan_;
  std::unique_ptr<MapOutput> map_;
  std::unique_ptr<BoxOutput> boxes_;
  std::unique_ptr<CorrectionLearner> learner_;
  std::unique_ptr<DetectionInputs> inputs_;
  std::unique_ptr<MountService> mount_service_;
  std::unique_ptr<dynamic_reconfigure::Server<PlaneDetectionConfig>> reconfigure_;
  std::unique_ptr<DetectionDiagnostics> diagnostics_;
  std::string subscription_error_;  ///< why inputs are not subscribed that are wanted
};

}  // namespace dominant_plane_detection
