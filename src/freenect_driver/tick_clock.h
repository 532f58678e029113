#pragma once

#include <cstdint>
#include <optional>

namespace dominant_plane_detection::freenect_driver {

/// Makes one ascending time of a Kinect's time stamps, which begin again every 71.6 s.
class TickClock {
 public:
  /// @param ticks [1/60 us] 32 bits of a clock of 60 MHz.
  /// @return [us] since the first call. Goes back where the stamps do by less than half of their
  /// range: when images of both cameras come in the other order, or a recording begins again.
  std::uint64_t at(std::uint32_t ticks) {
    if (last_) time_ += static_cast<std::int32_t>(ticks - *last_);
    last_ = ticks;
    return time_ < 0 ? 0U : static_cast<std::uint64_t>(time_ / kTicksPerMicrosecond);
  }

 private:
  static constexpr std::int64_t kTicksPerMicrosecond = 60;

  std::optional<std::uint32_t> last_;
  std::int64_t time_ = 0;  ///< [1/60 us]
};

}  // namespace dominant_plane_detection::freenect_driver
