#pragma once

#include <dominant_plane_detection/PlaneDetectionConfig.h>
#include <dynamic_reconfigure/server.h>
#include <nodelet/nodelet.h>

#include <boost/thread/lock_guard.hpp>
#include <boost/thread/recursive_mutex.hpp>
#include <memory>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "ros/detection_inputs.h"
#include "ros/detection_outputs.h"
#include "ros/detection_parameters.h"
#include "ros/mount_service.h"

namespace dominant_plane_detection {

/// The detector as a nodelet: depth in, plane, mask, overlay and clouds out; idle while nobody
/// listens.
class PlaneDetectionNodelet : public nodelet::Nodelet {
 public:
  ~PlaneDetectionNodelet() override;

 private:
  void onInit() override;
  void start();
  void onListenersChanged();
  void onFrame(const DetectionInputs::Frame& frame);
  void onPicture();
  void onReconfigure(PlaneDetectionConfig& config);

  /// Held by every callback: connections come from other threads than messages do.
  boost::recursive_mutex mutex_;
  DominantPlaneDetector detector_;
  DetectionOutputs outputs_;
  std::unique_ptr<DetectionInputs> inputs_;
  std::unique_ptr<MountService> mount_service_;
  std::unique_ptr<dynamic_reconfigure::Server<PlaneDetectionConfig>> reconfigure_;
};

}  // namespace dominant_plane_detection
