#pragma once

#include <dominant_plane_detection/PlaneDetectionConfig.h>
#include <dynamic_reconfigure/server.h>

#include <memory>
#include <optional>
#include <string>

#include "dominant_plane_detection/depth_correction.h"
#include "dominant_plane_detection/dominant_plane_detector.h"
#include "nodelets/periodic_nodelet.h"
#include "ros/correction_learner.h"
#include "ros/detection_diagnostics.h"
#include "ros/detection_inputs.h"
#include "ros/detection_outputs.h"
#include "ros/detection_parameters.h"
#include "ros/mount_service.h"
#include "ros/overlay_output.h"

namespace dominant_plane_detection {

/// The detector as a nodelet: depth in, plane, mask, overlay and clouds out; idle while nobody
/// listens.
///
/// Everything here happens in the thread of the nodelet's own callback queue, one callback after
/// the other, so that there is no lock: images, listeners that come and go, parameters, the timer.
/// A call of `calibrate_mount` waits in a thread of its own (see `MountService`).
class PlaneDetectionNodelet : public PeriodicNodelet {
 public:
  ~PlaneDetectionNodelet() override { stopTimer(); }

 private:
  void start() override;
  void onTimer() override;
  void followListeners();
  void trySubscriptions();
  void onFrame(const DetectionInputs::Frame& frame);
  void detect(const DetectionInputs::Frame& frame);
  void onReconfigure(PlaneDetectionConfig& config);

  std::optional<DepthCorrection> correction_;
  DominantPlaneDetector detector_;
  DetectionOutputs outputs_;
  std::unique_ptr<OverlayOutput> overlay_;
  std::unique_ptr<CorrectionLearner> learner_;
  std::unique_ptr<DetectionInputs> inputs_;
  std::unique_ptr<MountService> mount_service_;
  std::unique_ptr<dynamic_reconfigure::Server<PlaneDetectionConfig>> reconfigure_;
  std::unique_ptr<DetectionDiagnostics> diagnostics_;
  std::string subscription_error_;  ///< why inputs are not subscribed that are wanted
};

}  // namespace dominant_plane_detection
