#pragma once

#include <cstdint>
#include <optional>

namespace dominant_plane_detection {

/// Puts the stamps of a device's own clock onto the time of this computer.
///
/// A frame arrives some time after its stamp, never before it: the smallest delay seen is the best
/// guess of the offset between the clocks. The guess follows earlier arrivals at once and grows by
/// 0.3 ms a second otherwise, more than clocks drift apart (75 us/s have been seen), so that it
/// stays within microseconds of the smallest delay. A device clock that jumps, as that of a looping
/// recording does, begins anew.
class ClockFilter {
 public:
  /// @param device [us] stamp by the device's clock.
  /// @param arrival [s] when the frame came, by this computer's clock.
  /// @return [s] the stamp by this computer's clock: later than the one before, unless this
  /// computer's clock was set back, and not later than `arrival` but for that.
  double stamp(std::uint64_t device, double arrival);

 private:
  struct Last {
    double device = 0.0;   ///< [s]
    double arrival = 0.0;  ///< [s]
    double stamp = 0.0;    ///< [s]
  };

  bool jumped(double device, double arrival) const;

  std::optional<Last> last_;
  double offset_ = 0.0;      ///< [s] this computer's clock minus the device's, plus the least delay
  double late_since_ = 0.0;  ///< [s] by the device, since when all frames came later than they can
};

}  // namespace dominant_plane_detection
