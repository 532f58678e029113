#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <array>
#include <functional>
#include <mutex>

#include "openni2/device_session.h"

namespace dominant_plane_detection {

/// What /diagnostics says of a camera, once a second (REP 107): whether there is one, and of each
/// stream, on its own, whether it runs as it is wanted, its rate against that of its mode, and the
/// frames that were lost. Idle is well; what is wanted and does not come is an error.
class DriverDiagnostics {
 public:
  DriverDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                    const std::string& name);

  /// A stream begins to be wanted or ends.
  void setWanted(StreamKind kind, bool wanted);
  /// Another camera is open, which numbers its images anew.
  void beginNumbers();
  /// From any thread.
  void count(StreamKind kind, const SensorFrame& frame);

  void report(const SessionStatus& status);

 private:
  struct Stream {
    bool wanted = false;
    int rate = 0;                  ///< [1/s] of the mode
    int last_number = -1;          ///< of a frame
    std::uint64_t frames = 0;      ///< [#] ever
    std::uint64_t dropped = 0;     ///< [#] ever
    std::uint64_t incomplete = 0;  ///< [#] ever
    std::uint64_t reported = 0;    ///< [#] of frames at the last report
    ros::SteadyTime since;         ///< of the last report, or of the wish

    void beginPeriod() {
      since = ros::SteadyTime::now();
      reported = frames;
    }
  };

  void reportCamera(diagnostic_updater::DiagnosticStatusWrapper& report) const;
  void reportStream(StreamKind kind, diagnostic_updater::DiagnosticStatusWrapper& report);
  void summarise(const StreamStatus& status, Stream& stream,
                 diagnostic_updater::DiagnosticStatusWrapper& report) const;

  SessionStatus status_;
  ros::SteadyTime begin_;
  std::mutex mutex_;  ///< of what follows
  std::array<Stream, kStreamKinds> streams_;
  diagnostic_updater::Updater updater_;
};

}  // namespace dominant_plane_detection
