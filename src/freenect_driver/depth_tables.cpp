#include "freenect_driver/depth_tables.h"

#include <algorithm>

#include "core/disparity_table.h"

namespace dominant_plane_detection::freenect_driver {
namespace {

constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;
constexpr int kColumnScale = 256;
constexpr std::size_t kRaw = DisparityTable::kSize;

}  // namespace

DepthTables::DepthTables() : millimetres_(kRaw) {
  const DisparityTable table(DepthCalibration::kinect());
  for (std::uint16_t raw = 0; raw < kRaw; ++raw) millimetres_[raw] = table[raw];
}

DepthTables::DepthTables(const freenect_registration& device)
    : millimetres_(device.raw_to_mm_shift, device.raw_to_mm_shift + kRaw), raw_(kPixels) {
  column_.resize(kPixels);
  row_.resize(kPixels);
  for (std::size_t i = 0; i < kPixels; ++i) {
    column_[i] = device.registration_table[i][0];
    row_[i] = device.registration_table[i][1];
  }
  shift_.assign(device.depth_to_rgb_shift, device.depth_to_rgb_shift + kFarthest);
  first_row_ = device.reg_pad_info.start_lines;
}

void DepthTables::toMillimetres(std::uint16_t* readings) const {
  for (std::size_t i = 0; i < kPixels; ++i) {
    readings[i] = millimetres_[std::min<std::size_t>(readings[i], kRaw - 1)];
  }
}

void DepthTables::toRegistered(std::uint16_t* readings) {
  std::copy_n(readings, kPixels, raw_.begin());
  std::fill_n(readings, kPixels, std::uint16_t{0});
  for (std::size_t i = 0; i < kPixels; ++i) {
    const std::uint16_t z = millimetres_[std::min<std::size_t>(raw_[i], kRaw - 1)];
    if (z == 0 || z >= kFarthest) continue;
    const std::int32_t scaled = column_[i] + shift_[z];
    const std::int32_t u = scaled / kColumnScale;
    const std::int32_t v = row_[i] - first_row_;
    if (scaled < 0 || u >= kWidth || v < 0 || v >= kHeight) continue;
    std::uint16_t& seen =
        readings[static_cast<std::size_t>(v) * kWidth + static_cast<std::size_t>(u)];
    if (seen == 0 || z < seen) seen = z;
  }
}

}  // namespace dominant_plane_detection::freenect_driver
