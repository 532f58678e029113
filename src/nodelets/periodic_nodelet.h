#pragma once

#include <nodelet/nodelet.h>
#include <ros/ros.h>

#include <atomic>
#include <memory>

#include "nodelets/name_claim.h"

namespace dominant_plane_detection {

/// A nodelet that starts in one go and does something once a second.
///
/// The manager's threads call `onInit`, one nodelet after the other, as loading transports wants
/// it, while callbacks already come and find that it has not started; and the destructor, after the
/// last callback of the nodelet's own queue.
class PeriodicNodelet : public nodelet::Nodelet {
 protected:
  /// Everything that is done once. What it throws goes to the log, and the nodelet does nothing.
  virtual void start() = 0;
  /// Soon after the start, and once a second from then on, in the nodelet's own queue.
  virtual void onTimer() = 0;

  /// For the destructors of derived classes, before anything that `onTimer` uses is gone.
  void stopTimer() { timer_.stop(); }
  /// @return whether `start` has come to its end; from any thread.
  bool started() const { return started_; }

 private:
  void onInit() final;

  std::unique_ptr<NameClaim> name_;  ///< let go of after all that a derived class has
  std::atomic<bool> started_{false};
  ros::WallTimer timer_;
};

}  // namespace dominant_plane_detection
