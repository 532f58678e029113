#include "openni2/clock_filter.h"

#include <algorithm>

namespace dominant_plane_detection {
namespace {

constexpr double kDriftAllowance = 3e-4;  // [-] by which the guess of the offset grows
constexpr double kLate = 0.1;             // [s] no frame is on its way that long, not all of them
constexpr double kLatePatience = 1.0;     // [s] for which all frames have to be late
constexpr double kStep = 1e-6;            // [s] least distance of two stamps
constexpr double kSetBack = 0.5;          // [s] by which a clock that was set back is known
constexpr double kStraggler = 0.5;        // [s] within which streams follow the others in a jump
constexpr double kFarOff = 1.0;           // [s] before a new beginning, as no frame of it can be
constexpr std::size_t kGiven = 32;        // [#] stamps in which equal ones are looked for

}  // namespace

/// While one stream of a looping recording has begun anew another may still bring its last frames.
bool ClockFilter::isOfEarlierEpoch(const Stream& stream, std::uint64_t device,
                                   double arrival) const {
  if (!stream.last || stream.epoch + 1 != epoch_ || device < stream.last->device) return false;
  const bool far_off = arrival - 1e-6 * static_cast<double>(device) < offset_ - kFarOff;
  return arrival - restarted_at_ < kStraggler || far_off;
}

void ClockFilter::beginEpoch(Stream& stream, double device, double offset) {
  earlier_offset_ = offset_;
  offset_ = offset;
  late_since_ = newest_device_ = device;
  given_.clear();
  stream.epoch = ++epoch_;
}

std::optional<double> ClockFilter::given(std::uint64_t device) const {
  const auto found = std::find_if(given_.begin(), given_.end(),
                                  [&](const Given& each) { return each.device == device; });
  return found == given_.end() ? std::nullopt : std::make_optional(found->stamp);
}

double ClockFilter::stamp(std::size_t number, std::uint64_t device_us, double arrival) {
  Stream& stream = streams_[number];
  const double device = 1e-6 * static_cast<double>(device_us);
  const double offset = arrival - device;
  const bool set_back = stream.last && arrival < stream.last->arrival - kSetBack;
  double stamp = 0.0;
  if (isOfEarlierEpoch(stream, device_us, arrival)) {
    stamp = device + earlier_offset_;
  } else {
    const bool restarted = stream.last && stream.epoch == epoch_ && device_us < stream.last->device;
    const bool set = device - late_since_ > kLatePatience;
    if (epoch_ == 0 || restarted || set_back || set) {
      beginEpoch(stream, device, offset);
      restarted_at_ = restarted ? arrival : arrival - kStraggler;
    } else {
      const double passed = std::max(device - newest_device_, 0.0);
      offset_ = std::min(offset, offset_ + kDriftAllowance * passed);
    }
    stream.epoch = epoch_;
    newest_device_ = std::max(newest_device_, device);
    if (offset - offset_ < kLate) late_since_ = std::max(late_since_, device);
    const std::optional<double> equal = given(device_us);
    const bool again = stream.last && stream.last->device == device_us;
    if (equal && (again || !stream.last || set_back || *equal > stream.last->stamp)) {
      stamp = *equal;
    } else {
      stamp = device + offset_;
      if (stream.last && !set_back) stamp = std::max(stamp, stream.last->stamp + kStep);
      given_.push_back({device_us, stamp});
      if (given_.size() > kGiven) given_.pop_front();
    }
  }
  stream.last = Last{device_us, arrival, stamp};
  return stamp;
}

}  // namespace dominant_plane_detection
