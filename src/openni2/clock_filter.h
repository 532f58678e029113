#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>

namespace dominant_plane_detection {

/// Puts the stamps of a device's own clock onto the time of this computer. All streams of a device
/// share one clock, so that frames of one exposure, which have equal stamps, get equal ones.
///
/// A frame arrives some time after its stamp, never before it: the smallest delay seen is the best
/// guess of the offset between the clocks. The guess follows earlier arrivals at once and grows by
/// 0.3 ms a second otherwise, more than clocks drift apart (75 us/s have been seen), so that it
/// stays within microseconds of the smallest delay. A device clock that jumps, as that of a looping
/// recording does, begins anew, for each stream when its own stamps jump.
class ClockFilter {
 public:
  static constexpr std::size_t kStreams = 3;

  /// @param stream [#] of the device, below kStreams.
  /// @param device [us] stamp by the device's clock.
  /// @param arrival [s] when the frame came, by this computer's clock.
  /// @return [s] the stamp by this computer's clock: equal for equal stamps of any stream, and
  /// otherwise later than the stream's one before, unless this computer's clock was set back; and
  /// not later than `arrival` but for that.
  double stamp(std::size_t stream, std::uint64_t device, double arrival);

 private:
  struct Last {
    std::uint64_t device = 0;  ///< [us]
    double arrival = 0.0;      ///< [s]
    double stamp = 0.0;        ///< [s]
  };
  struct Stream {
    std::optional<Last> last;
    int epoch = 0;  ///< that it has seen
  };
  /// A stamp that was given.
  struct Given {
    std::uint64_t device;  ///< [us]
    double stamp;          ///< [s]
  };

  bool isOfEarlierEpoch(const Stream& stream, std::uint64_t device, double arrival) const;
  void beginEpoch(Stream& stream, double device, double offset);
  std::optional<double> given(std::uint64_t device) const;

  std::array<Stream, kStreams> streams_;
  int epoch_ = 0;        ///< counts the jumps of the device's clock
  double offset_ = 0.0;  ///< [s] this computer's clock minus the device's, plus the least delay
  double earlier_offset_ = 0.0;  ///< [s] before the last jump
  double restarted_at_ =
      0.0;  ///< [s] arrival with which the device's clock was found to begin anew
  double newest_device_ = 0.0;  ///< [s] of the epoch
  double late_since_ = 0.0;  ///< [s] by the device, since when all frames came later than they can
  std::deque<Given> given_;  ///< in the epoch, the latest
};

}  // namespace dominant_plane_detection
