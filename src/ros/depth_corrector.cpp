#include "ros/depth_corrector.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace dominant_plane_detection {
namespace {

template <typename ImageT>
auto rowOf(ImageT& image, std::uint32_t v) {
  using Pixel = std::conditional_t<std::is_const_v<ImageT>, const std::uint16_t, std::uint16_t>;
  return reinterpret_cast<Pixel*>(&image.data[std::size_t{v} * image.step]);
}

/// @return a pixel of so many millimetres; 0 where 16 bits do not hold them.
std::uint16_t asPixel(float millimetres) {
  constexpr float kMost = std::numeric_limits<std::uint16_t>::max();
  const float z = std::nearbyint(millimetres);
  return 0.0F < z && z <= kMost ? static_cast<std::uint16_t>(z) : 0;
}

void correctRow(const std::uint16_t* from, std::uint32_t width, float scale, float offset,
                std::uint16_t* to) {
  for (std::uint32_t u = 0; u < width; ++u) {
    to[u] = from[u] != 0 ? asPixel(scale * static_cast<float>(from[u]) + offset) : 0;
  }
}

}  // namespace

DepthCorrector::DepthCorrector(const DepthCalibration& calibration,
                               const std::optional<DepthCorrection>& pixels)
    : calibration_(calibration), pixels_(pixels) {
  set(0.0, 1.0);
}

void DepthCorrector::set(double z_offset, double z_scale) {
  const auto correction = std::make_shared<const Correction>(
      Correction{1000.0 * z_offset, z_scale, DisparityTable(calibration_, z_offset, z_scale)});
  const std::lock_guard<std::mutex> lock(mutex_);
  correction_ = correction;
}

sensor_msgs::ImagePtr DepthCorrector::correct(const sensor_msgs::ImagePtr& depth, bool raw) {
  std::shared_ptr<const Correction> correction;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    correction = correction_;
  }
  if (!raw && !pixels_ && correction->offset == 0.0 && correction->scale == 1.0) return depth;
  const sensor_msgs::Image& from = *depth;
  const sensor_msgs::ImagePtr to = likeness(from);
  for (std::uint32_t v = 0; v < from.height; ++v) {
    if (raw) {
      correction->table.apply(rowOf(from, v), from.width, rowOf(*to, v));
    } else {
      correctRow(rowOf(from, v), from.width, static_cast<float>(correction->scale),
                 static_cast<float>(correction->offset), rowOf(*to, v));
    }
  }
  if (pixels_) correctPixels(*to);
  return to;
}

void DepthCorrector::correctPixels(sensor_msgs::Image& image) {
  const std::lock_guard<std::mutex> lock(pixels_mutex_);
  const DepthView corrected =
      pixels_->correct({rowOf(std::as_const(image), 0), static_cast<int>(image.width),
                        static_cast<int>(image.height), 0.001F, image.step});
  for (std::uint32_t v = 0; v < image.height; ++v) {
    const float* from = corrected.row<float>(static_cast<int>(v));
    std::uint16_t* to = rowOf(image, v);
    for (std::uint32_t u = 0; u < image.width; ++u) to[u] = asPixel(1000.0F * from[u]);
  }
}

/// @return an image of the same size and kind, whose pixels have yet to be written.
sensor_msgs::ImagePtr DepthCorrector::likeness(const sensor_msgs::Image& image) {
  if (pool_.takenBytes() > ImagePool::kMostTaken) {
    throw std::runtime_error("subscribers in this process keep " +
                             std::to_string(pool_.takenBytes() / 1000000) +
                             " MB of corrected depth images; no more are made until they let go");
  }
  const sensor_msgs::ImagePtr other = pool_.make(image.data.size());
  other->width = image.width;
  other->height = image.height;
  other->step = image.step;
  other->encoding = image.encoding;
  other->is_bigendian = image.is_bigendian;
  return other;
}

}  // namespace dominant_plane_detection
