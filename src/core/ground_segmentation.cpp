#include "core/ground_segmentation.h"

#include <algorithm>
#include <cstring>

#include "core/label_kernel.h"
#include "core/tile_moments.h"
#include "core/tile_neighbours.h"
#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {
namespace {

constexpr auto kGround = static_cast<std::uint8_t>(Label::kGround);
constexpr std::uint64_t kOneInEachByte = 0x0101010101010101U;
constexpr auto kUnknown = static_cast<std::uint8_t>(Label::kUnknown);

/// @return one bit for each ground pixel among `width` <= 8 neighbouring labels, at the bottom of
/// its byte.
std::uint64_t groundBits(const std::uint8_t* labels, int width) {
  static_assert(kTileSize == sizeof(std::uint64_t) && kGround == 1, "one byte a pixel");
  std::uint64_t word = 0;
  std::memcpy(&word, labels, static_cast<std::size_t>(width));
  // Of the labels 0 to 3, ground alone has bit 0 set and bit 1 clear.
  return word & ~(word >> 1U) & kOneInEachByte;
}

LabelRule labelRule(const Eigen::Vector3d& normal, double distance,
                    const SegmentationLimits& limits) {
  const Eigen::Vector3f n = normal.cast<float>();
  return {{n.x(), n.y(), n.z()},
          static_cast<float>(distance),
          static_cast<float>(limits.band.offset + limits.band.sigmas * limits.noise.constant),
          static_cast<float>(limits.band.sigmas * limits.noise.quadratic)};
}

}  // namespace

SegmentationCounts GroundSegmentation::label(const DepthView& depth, const RayTable& rays,
                                             const Eigen::Vector3d& normal, double distance,
                                             const SegmentationLimits& limits,
                                             std::vector<std::uint8_t>& labels) {
  labels.resize(static_cast<std::size_t>(depth.width) * static_cast<std::size_t>(depth.height));
  const ImageInput input{depth, rays, {metresPerUnit(depth), limits.range_min, limits.range_max}};
  SegmentationCounts counts;
  const double sum_squares =
      runLabelKernel(input, labelRule(normal, distance, limits), labels.data());
  const std::size_t in_band = countTiles(depth.width, depth.height, labels);
  if (in_band > 0) counts.mean_square_error = sum_squares / static_cast<double>(in_band);
  counts.ground = removeSpecks(depth.width, depth.height, limits.min_patch, labels);
  return counts;
}

/// Counts the ground pixels of each tile.
/// @return [px] all of them.
std::size_t GroundSegmentation::countTiles(int width, int height,
                                           const std::vector<std::uint8_t>& labels) {
  columns_ = (width + kTileSize - 1) / kTileSize;
  rows_ = (height + kTileSize - 1) / kTileSize;
  in_tile_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  std::size_t total = 0;
  std::uint8_t* in_tile = in_tile_.data();
  for (int top = 0; top < height; top += kTileSize) {
    const int end = std::min(top + kTileSize, height);
    for (int left = 0; left < width; left += kTileSize) {
      const int columns = std::min(kTileSize, width - left);
      std::uint64_t column_counts = 0;  // eight numbers of one byte
      for (int v = top; v < end; ++v) {
        const std::uint8_t* row = labels.data() + static_cast<std::ptrdiff_t>(v) * width + left;
        column_counts +=
            columns == kTileSize ? groundBits(row, kTileSize) : groundBits(row, columns);
      }
      // The product's top byte is the sum of all bytes.
      *in_tile = static_cast<std::uint8_t>((column_counts * kOneInEachByte) >> 56U);
      total += *in_tile++;
    }
  }
  return total;
}

std::size_t GroundSegmentation::removeSpecks(int width, int height, std::size_t min_patch,
                                             std::vector<std::uint8_t>& labels) {
  std::size_t ground = 0;
  for (std::size_t tile = 0; tile < in_tile_.size(); ++tile) {
    if (in_tile_[tile] == 0) continue;
    const std::size_t pixels = collectPiece(tile);
    if (pixels >= min_patch) {
      ground += pixels;
      continue;
    }
    for (const std::size_t speck : piece_) {
      const int left = static_cast<int>(speck) % columns_ * kTileSize;
      const int top = static_cast<int>(speck) / columns_ * kTileSize;
      for (int v = top; v < std::min(top + kTileSize, height); ++v) {
        const auto row = labels.begin() + static_cast<std::ptrdiff_t>(v) * width;
        std::replace(row + left, row + std::min(left + kTileSize, width), kGround, kUnknown);
      }
    }
  }
  return ground;
}

/// Collects the tiles with ground that hang together with `tile`, at the cost of their counts.
/// @return [px] ground in them.
std::size_t GroundSegmentation::collectPiece(std::size_t tile) {
  piece_.clear();
  std::size_t pixels = 0;
  const auto visit = [&](std::size_t next) {
    if (in_tile_[next] == 0) return;
    pixels += in_tile_[next];
    in_tile_[next] = 0;
    piece_.push_back(next);
  };
  visit(tile);
  for (std::size_t i = 0; i < piece_.size(); ++i) {
    forEachNeighbour(piece_[i], columns_, rows_, visit);
  }
  return pixels;
}

}  // namespace dominant_plane_detection
