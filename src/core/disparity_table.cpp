#include "core/disparity_table.h"

#include <cmath>
#include <limits>

namespace dominant_plane_detection {

DisparityTable::DisparityTable(const DepthCalibration& calibration, double offset, double scale) {
  constexpr double kMost = std::numeric_limits<std::uint16_t>::max();
  for (std::size_t raw = 0; raw < kSize; ++raw) {
    const double z = calibration.distance(static_cast<int>(raw));
    const double millimetres = std::nearbyint(1000.0 * (scale * z + offset));
    const bool reading = z > 0.0 && 0.0 < millimetres && millimetres <= kMost;
    millimetres_[raw] = reading ? static_cast<std::uint16_t>(millimetres) : std::uint16_t{0};
  }
}

void DisparityTable::apply(const std::uint16_t* raw, std::size_t n,
                           std::uint16_t* millimetres) const {
  for (std::size_t i = 0; i < n; ++i) millimetres[i] = (*this)[raw[i]];
}

}  // namespace dominant_plane_detection
