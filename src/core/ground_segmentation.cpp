#include "core/ground_segmentation.h"

#include <algorithm>

#include "core/label_kernel.h"
#include "core/tile_moments.h"
#include "core/widen_tiles.h"

namespace dominant_plane_detection {
namespace {

/// [-] in sigma(z): what is as near to the plane is ground whatever is about it.
constexpr double kNarrow = 1.25;

LabelRule labelRule(const Eigen::Vector3d& normal, double distance,
                    const SegmentationLimits& limits) {
  const Eigen::Vector3f n = normal.cast<float>();
  return {{n.x(), n.y(), n.z()},
          static_cast<float>(distance),
          static_cast<float>(limits.band.offset + limits.band.sigmas * limits.noise.constant),
          static_cast<float>(limits.band.sigmas * limits.noise.quadratic),
          static_cast<float>(kNarrow * limits.noise.constant),
          static_cast<float>(kNarrow * limits.noise.quadratic)};
}

void subtract(const LabelSums& lost, LabelSums& sums) {
  sums.ground -= lost.ground;
  sums.square_height = std::max(sums.square_height - lost.square_height, 0.0);
}

}  // namespace

SegmentationCounts GroundSegmentation::label(const ImageInput& input, const Eigen::Vector3d& normal,
                                             double distance, const SegmentationLimits& limits,
                                             const SurfaceTiles& tiles,
                                             std::vector<std::uint8_t>& labels) {
  labels.resize(static_cast<std::size_t>(input.depth.width) *
                static_cast<std::size_t>(input.depth.height));
  const int columns = covering(input.depth.width, kTileSize);
  const int rows = covering(input.depth.height, kTileSize);
  widenTiles(columns, rows, tiles.ground, in_row_, tile_kinds_);
  const LabelRule rule = labelRule(normal, distance, limits);
  for (std::size_t i = 0; i < tile_kinds_.size(); ++i) {
    if (tiles.other[i]) tile_kinds_[i] = tiles.other[i];
  }
  const bool low = limits.low.false_alarm_rate > 0.0;
  LabelSums sums =
      runLabelKernel(input, rule, tile_kinds_.data(), labels.data(), low ? &blocks_ : nullptr);
  if (low) {
    low_obstacles_.look(input, rule, blocks_, limits.low, tile_kinds_);
    subtract(labelSmeared(input, rule, tile_kinds_.data(), labels.data()), sums);
    subtract(low_obstacles_.mark(labels), sums);
    specks_.remove(input, tile_kinds_, limits.low.min_width, labels);
  }
  SegmentationCounts counts;
  counts.ground = sums.ground;
  if (sums.ground > 0) {
    counts.mean_square_error = sums.square_height / static_cast<double>(sums.ground);
  }
  return counts;
}

}  // namespace dominant_plane_detection
