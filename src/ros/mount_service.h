#pragma once

#include <dominant_plane_detection/CalibrateMount.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>

#include "calibration/mount_estimate.h"

namespace dominant_plane_detection {

CalibrateMount::Response toResponse(const Mount& mount);

/// The service `calibrate_mount`. A call waits for detections in a thread of its own, so that those
/// that bring them go on; all else is called in the thread of the node's callback queue.
class MountService {
 public:
  /// @param wish_changed called, in the thread of the node's queue, when detections begin or end to
  /// be wanted.
  MountService(const ros::NodeHandle& node, std::function<void()> wish_changed);
  /// Ends a running call, without a result. Not while a callback of the node's queue runs
  /// elsewhere.
  ~MountService();
  MountService(const MountService&) = delete;
  MountService& operator=(const MountService&) = delete;

  /// @return whether a call waits for detections.
  bool wants() const;
  /// @param frame_id of the image.
  void add(const Detection& detection, const std::string& frame_id);

 private:
  bool onCall(CalibrateMount::Request& request, CalibrateMount::Response& response);
  MountEstimate collect(std::size_t frames);
  void tellWishChanged();

  ros::CallbackQueueInterface& node_queue_;
  std::function<void()> wish_changed_;
  mutable std::mutex mutex_;  ///< of what follows
  std::condition_variable changed_;
  std::optional<MountEstimate> estimate_;  ///< while a call waits
  bool ending_ = false;

  ros::CallbackQueue queue_;
  ros::ServiceServer server_;
  ros::AsyncSpinner spinner_;
};

}  // namespace dominant_plane_detection
