#pragma once

#include <dominant_plane_detection/PlaneDetectionConfig.h>
#include <dynamic_reconfigure/server.h>
#include <nodelet/nodelet.h>

#include <atomic>
#include <memory>
#include <string>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "nodelets/name_claim.h"
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
/// The manager's threads call `onInit`, one nodelet after the other, as loading transports wants
/// it, while callbacks already come and find that nothing has started; and the destructor, after
/// the last callback. A call of `calibrate_mount` waits in a thread of its own (see
/// `MountService`).
class PlaneDetectionNodelet : public nodelet::Nodelet {
 private:
  void onInit() override;
  void onTimer();
  void start();
  void followListeners();
  void trySubscriptions();
  void onFrame(const DetectionInputs::Frame& frame);
  void onReconfigure(PlaneDetectionConfig& config);

  std::unique_ptr<NameClaim> name_;   ///< first, so that it is let go of last
  std::atomic<bool> started_{false};  ///< what follows is complete
  DominantPlaneDetector detector_;
  DetectionOutputs outputs_;
  std::unique_ptr<OverlayOutput> overlay_;
  std::unique_ptr<DetectionInputs> inputs_;
  std::unique_ptr<MountService> mount_service_;
  std::unique_ptr<dynamic_reconfigure::Server<PlaneDetectionConfig>> reconfigure_;
  std::unique_ptr<DetectionDiagnostics> diagnostics_;
  std::string subscription_error_;  ///< why inputs are not subscribed that are wanted
  ros::WallTimer timer_;
};

}  // namespace dominant_plane_detection
