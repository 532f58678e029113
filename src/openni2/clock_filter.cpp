#include "openni2/clock_filter.h"

#include <algorithm>

namespace dominant_plane_detection {
namespace {

constexpr double kDriftAllowance = 3e-4;  // [-] by which the guess of the offset grows
constexpr double kLate = 0.1;             // [s] no frame is on its way that long, not all of them
constexpr double kLatePatience = 1.0;     // [s] for which all frames have to be late
constexpr double kStep = 1e-6;            // [s] least distance of two stamps
constexpr double kSetBack = 0.5;          // [s] by which a clock that was set back is known

}  // namespace

bool ClockFilter::jumped(double device, double arrival) const {
  return device <= last_->device ||              // restarted
         arrival < last_->arrival - kSetBack ||  // this computer's clock was set back
         device - late_since_ > kLatePatience;   // one of the clocks was set
}

double ClockFilter::stamp(std::uint64_t device_us, double arrival) {
  const double device = 1e-6 * static_cast<double>(device_us);
  const double offset = arrival - device;
  if (!last_ || jumped(device, arrival)) {
    offset_ = offset;
    late_since_ = device;
  } else {
    offset_ = std::min(offset, offset_ + kDriftAllowance * (device - last_->device));
  }
  if (offset - offset_ < kLate) late_since_ = device;

  double stamp = device + offset_;
  const bool set_back = last_ && arrival < last_->arrival - kSetBack;
  if (last_ && !set_back) stamp = std::max(stamp, last_->stamp + kStep);
  last_ = Last{device, arrival, stamp};
  return stamp;
}

}  // namespace dominant_plane_detection
