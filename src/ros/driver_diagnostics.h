#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <functional>
#include <mutex>

#include "openni2/device_session.h"

namespace dominant_plane_detection {

/// What /diagnostics says of a camera, once a second (REP 107): whether there is one, and for each
/// stream its rate against that of its mode and the frames that were lost. Idle is well.
class DriverDiagnostics {
 public:
  /// @param status asked in the thread of the node's callbacks.
  DriverDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                    const std::string& name, std::function<SessionStatus()> status);

  /// A stream begins to be wanted or ends.
  void setWanted(StreamKind kind, bool wanted);
  /// Another camera is open, which numbers its images anew.
  void beginNumbers();
  void count(StreamKind kind, const SensorFrame& frame);

 private:
  struct Stream {
    bool wanted = false;
    int rate = 0;                ///< [1/s] of the mode
    int last_number = -1;        ///< of a frame
    std::uint64_t frames = 0;    ///< [#] ever
    std::uint64_t dropped = 0;   ///< [#] ever
    std::uint64_t reported = 0;  ///< [#] of frames at the last report
    ros::SteadyTime since;       ///< of the last report, or of the wish
  };

  void reportCamera(diagnostic_updater::DiagnosticStatusWrapper& report);
  void reportStream(StreamKind kind, diagnostic_updater::DiagnosticStatusWrapper& report);

  std::function<SessionStatus()> status_;
  std::mutex mutex_;
  Stream streams_[kStreamKinds];
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace dominant_plane_detection
