#include "core/ground_segmentation.h"

#include <algorithm>

#include "core/label_kernel.h"
#include "core/tile_moments.h"

namespace dominant_plane_detection {
namespace {

LabelRule labelRule(const Eigen::Vector3d& normal, double distance,
                    const SegmentationLimits& limits) {
  const Eigen::Vector3f n = normal.cast<float>();
  return {{n.x(), n.y(), n.z()},
          static_cast<float>(distance),
          static_cast<float>(limits.band.offset + limits.band.sigmas * limits.noise.constant),
          static_cast<float>(limits.band.sigmas * limits.noise.quadratic)};
}

}  // namespace

SegmentationCounts GroundSegmentation::label(const ImageInput& input, const Eigen::Vector3d& normal,
                                             double distance, const SegmentationLimits& limits,
                                             const std::vector<std::uint8_t>& region,
                                             std::vector<std::uint8_t>& labels) {
  labels.resize(static_cast<std::size_t>(input.depth.width) *
                static_cast<std::size_t>(input.depth.height));
  const auto tiles = [](int pixels) { return (pixels + kTileSize - 1) / kTileSize; };
  widen(tiles(input.depth.width), tiles(input.depth.height), region);
  const LabelSums sums = runLabelKernel(input, labelRule(normal, distance, limits),
                                        near_ground_.data(), labels.data());
  SegmentationCounts counts;
  counts.ground = sums.ground;
  if (sums.ground > 0) {
    counts.mean_square_error = sums.square_height / static_cast<double>(sums.ground);
  }
  return counts;
}

/// Adds the eight neighbours of each tile: first those in its row, then the rows next to it.
void GroundSegmentation::widen(int columns, int rows, const std::vector<std::uint8_t>& region) {
  const auto width = static_cast<std::size_t>(columns), height = static_cast<std::size_t>(rows);
  in_row_.assign(region.begin(), region.begin() + static_cast<std::ptrdiff_t>(width * height));
  for (std::size_t row = 0; row < height; ++row) {
    const std::uint8_t* from = region.data() + row * width;
    std::uint8_t* to = in_row_.data() + row * width;
    for (std::size_t i = 1; i < width; ++i) to[i] |= from[i - 1];
    for (std::size_t i = 1; i < width; ++i) to[i - 1] |= from[i];
  }
  near_ground_ = in_row_;
  for (std::size_t i = width; i < in_row_.size(); ++i) near_ground_[i] |= in_row_[i - width];
  for (std::size_t i = width; i < in_row_.size(); ++i) near_ground_[i - width] |= in_row_[i];
}

}  // namespace dominant_plane_detection
