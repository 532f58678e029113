#include "core/missing_ground.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/block_heights.h"
#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {
namespace {

constexpr auto kGroundLabel = static_cast<std::uint8_t>(Label::kGround);
constexpr auto kUnknownLabel = static_cast<std::uint8_t>(Label::kUnknown);
constexpr auto kMissingLabel = static_cast<std::uint8_t>(Label::kMissingGround);

enum : std::uint8_t { kRead, kEmpty, kTaken };

/// [px] of a block's 16 without a reading, from which on it is empty.
constexpr int kMinMissing = kBlockSize * kBlockSize / 2;
/// [m] between the two eyes of a sensor at most: a Kinect's and an Xtion's are 75 mm apart, a
/// RealSense's 50 to 95 mm (manufacturers' data sheets).
constexpr double kBaseline = 0.1;
/// [m] What is nearer is no reading: no depth camera has such.
constexpr float kNearestReading = 0.05F;
/// [#] blocks beside an empty one in which a rim's ground, or the obstacle that hides it, may be:
/// next to edges depth is smeared or unknown.
constexpr int kRim = 3;
/// [-] of the rim that has to be ground: more than the one long side of a stripe along the image's
/// border, where some sensors never see anything, and less than three sides of a square.
constexpr double kGroundShare = 0.6;
/// [#] blocks of the smallest piece, whatever its size on the plane.
constexpr std::size_t kMinBlocks = 4;

/// @return whether a pixel says nothing, not even that something is far.
template <typename Pixel>
bool isMissing(Pixel pixel) {
  return !(pixel > Pixel(0));
}

bool isMissingAt(const DepthView& depth, int u, int v) { return isMissing(metresAt(depth, u, v)); }

/// @return [px] without a reading in a block that is inside the image.
template <typename Pixel>
int countMissing(const DepthView& depth, int column, int row) {
  int missing = 0;
  for (int v = 0; v < kBlockSize; ++v) {
    const Pixel* pixels = depth.row<Pixel>(row * kBlockSize + v) + column * kBlockSize;
    for (int u = 0; u < kBlockSize; ++u) missing += isMissing(pixels[u]) ? 1 : 0;
  }
  return missing;
}

/// Calls visit(u, v) for the pixels of a block that are inside the image.
template <typename Visit>
void visitBlock(const DepthView& depth, int column, int row, Visit&& visit) {
  const int right = std::min((column + 1) * kBlockSize, depth.width);
  const int bottom = std::min((row + 1) * kBlockSize, depth.height);
  for (int v = row * kBlockSize; v < bottom; ++v) {
    for (int u = column * kBlockSize; u < right; ++u) visit(u, v);
  }
}

}  // namespace

float MissingGround::Sight::planeDepth(int u, int v) const {
  const float depth = distance / normal.dot(input.rays.ray(u, v));
  return depth >= input.range.min && depth <= input.range.max ? depth : 0.0F;
}

void MissingGround::mark(const ImageInput& input, const HessePlane& plane, const TileMoments& tiles,
                         double min_width, std::vector<std::uint8_t>& labels) {
  const Sight sight{input, plane.normal.cast<float>(), static_cast<float>(plane.distance)};
  columns_ = covering(input.depth.width, kBlockSize);
  rows_ = covering(input.depth.height, kBlockSize);
  state_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), kRead);
  plane_depth_.resize(state_.size());
  found_.clear();
  found_.reserve(state_.size());
  blocks_.reserve(state_.size());
  if (input.depth.type == DepthView::Type::kUint16) {
    findEmpty<std::uint16_t>(sight, tiles);
  } else {
    findEmpty<float>(sight, tiles);
  }
  leaveOutShadows(input);
  for (const std::size_t start : found_) {
    if (state_[start] != kEmpty) continue;
    const Piece piece = grow(start, sight, labels);
    if (blocks_.size() >= kMinBlocks && piece.area >= min_width * min_width &&
        static_cast<double>(piece.ground) >= kGroundShare * static_cast<double>(piece.rim)) {
      label(sight, labels);
    }
  }
}

template <typename Pixel>
void MissingGround::findEmpty(const Sight& sight, const TileMoments& tiles) {
  constexpr int kSide = kTileSize / kBlockSize;  // [#] blocks
  constexpr float kReadings = kTileSize * kTileSize - kMinMissing;
  const DepthView& depth = sight.input.depth;
  // Blocks that are partly outside the image are left out.
  const int whole_columns = depth.width / kBlockSize, whole_rows = depth.height / kBlockSize;
  for (int row = 0; row < whole_rows; ++row) {
    const float* counts =
        tiles.count.data() + static_cast<std::ptrdiff_t>(row / kSide) * tiles.columns;
    for (int column = 0; column < whole_columns; ++column) {
      // What is beyond the range does not count as a reading there.
      if (counts[column / kSide] > kReadings) continue;
      const float plane_depth =
          sight.planeDepth(column * kBlockSize + kBlockSize / 2, row * kBlockSize + kBlockSize / 2);
      if (plane_depth == 0.0F) continue;
      if (countMissing<Pixel>(depth, column, row) < kMinMissing) continue;
      const std::size_t block = indexOf(column, row);
      state_[block] = kEmpty;
      plane_depth_[block] = plane_depth;
      found_.push_back(block);
    }
  }
}

void MissingGround::leaveOutShadows(const ImageInput& input) {
  for (std::size_t i = 0; i < found_.size();) {
    const int row = static_cast<int>(found_[i]) / columns_;
    const int begin = static_cast<int>(found_[i]) % columns_;
    int end = begin;
    // The next row follows without a gap.
    while (i < found_.size() && end < columns_ && found_[i] == indexOf(end, row)) ++i, ++end;
    leaveOutShadow(input, row, begin, end, 1);
    leaveOutShadow(input, row, end - 1, begin - 1, -1);
  }
}

/// @param begin, end columns of a run of empty blocks, in the direction of `step` from one side.
void MissingGround::leaveOutShadow(const ImageInput& input, int row, int begin, int end, int step) {
  float nearest = std::numeric_limits<float>::infinity();  // [m]
  for (int i = 1, beside = begin - step; i <= kRim && inside(beside, row); ++i, beside -= step) {
    visitBlock(input.depth, beside, row, [&](int u, int v) {
      const float z = metresAt(input.depth, u, v);
      if (z > kNearestReading) nearest = std::min(nearest, z);
    });
  }
  const double parallax = input.rays.camera().fx * kBaseline *
                          (1.0 / static_cast<double>(nearest) -
                           1.0 / static_cast<double>(plane_depth_[indexOf(begin, row)]));
  // Less is no obstacle's edge, but the error of the ground.
  if (!(parallax > kBlockSize)) return;
  auto width =
      static_cast<int>(std::min(std::ceil(parallax / kBlockSize), static_cast<double>(columns_)));
  for (int column = begin; column != end && width > 0; column += step, --width) {
    state_[indexOf(column, row)] = kRead;
  }
}

/// @return whether the first thing that is known in a direction is ground.
bool MissingGround::leadsToGround(int column, int row, Step step, const ImageInput& input,
                                  const std::vector<std::uint8_t>& labels) const {
  for (int i = 0; i < kRim; ++i, column += step.column, row += step.row) {
    if (!inside(column, row)) return false;
    int ground = 0, other = 0;
    visitBlock(input.depth, column, row, [&](int u, int v) {
      const std::uint8_t label = labels[static_cast<std::size_t>(v * input.depth.width + u)];
      ground += label == kGroundLabel ? 1 : 0;
      other += label != kGroundLabel && label != kUnknownLabel ? 1 : 0;
    });
    if (std::max(ground, other) >= kMinMissing / 2) return ground > other;
  }
  return false;
}

/// Collects what hangs together with an empty block.
MissingGround::Piece MissingGround::grow(std::size_t start, const Sight& sight,
                                         const std::vector<std::uint8_t>& labels) {
  constexpr Step kSteps[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  const CameraModel& camera = sight.input.rays.camera();
  const double block = kBlockSize * kBlockSize / (camera.fx * camera.fy);
  Piece piece;
  blocks_.assign(1, start);
  state_[start] = kTaken;
  for (std::size_t next = 0; next < blocks_.size(); ++next) {
    const int column = static_cast<int>(blocks_[next]) % columns_;
    const int row = static_cast<int>(blocks_[next]) / columns_;
    // Behind a pixel there are z^2 / (fx fy normal . ray) of the plane, and z is distance / (normal
    // . ray).
    const auto z = static_cast<double>(plane_depth_[blocks_[next]]);
    piece.area += block * z * z * z / static_cast<double>(sight.distance);
    for (const Step& step : kSteps) {
      const int beside = column + step.column, below = row + step.row;
      const bool is_inside = inside(beside, below);
      if (is_inside && state_[indexOf(beside, below)] != kRead) {
        if (state_[indexOf(beside, below)] == kTaken) continue;
        state_[indexOf(beside, below)] = kTaken;
        blocks_.push_back(indexOf(beside, below));
        continue;
      }
      ++piece.rim;
      piece.ground += leadsToGround(beside, below, step, sight.input, labels) ? 1 : 0;
    }
  }
  return piece;
}

/// Labels the missing readings of the piece, and those in the blocks about it that it only touches.
void MissingGround::label(const Sight& sight, std::vector<std::uint8_t>& labels) const {
  const DepthView& depth = sight.input.depth;
  for (const std::size_t block : blocks_) {
    const int middle_column = static_cast<int>(block) % columns_;
    const int middle_row = static_cast<int>(block) / columns_;
    for (int row = std::max(middle_row - 1, 0); row <= std::min(middle_row + 1, rows_ - 1); ++row) {
      for (int column = std::max(middle_column - 1, 0);
           column <= std::min(middle_column + 1, columns_ - 1); ++column) {
        visitBlock(depth, column, row, [&](int u, int v) {
          std::uint8_t& label = labels[static_cast<std::size_t>(v * depth.width + u)];
          if (label == kUnknownLabel && isMissingAt(depth, u, v) && sight.planeDepth(u, v) > 0.0F) {
            label = kMissingLabel;
          }
        });
      }
    }
  }
}

}  // namespace dominant_plane_detection
