#pragma once

#include <string>

namespace dominant_plane_detection {

/// A nodelet's name, which only one nodelet of the process has at a time.
///
/// A manager unloads a nodelet while one of its callbacks still runs; it is destroyed when that has
/// ended. Whoever loads it again at once finds its services taken, and its topics being
/// unsubscribed. So a nodelet claims its name before anything else, and lets go of it last.
class NameClaim {
 public:
  /// Waits while another nodelet has the name.
  /// @throw std::runtime_error when it still has after ten seconds.
  explicit NameClaim(const std::string& name);
  ~NameClaim();
  NameClaim(const NameClaim&) = delete;
  NameClaim& operator=(const NameClaim&) = delete;

 private:
  std::string name_;
};

}  // namespace dominant_plane_detection
