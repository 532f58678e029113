#include "core/drop_off_specks.h"

#include <algorithm>
#include <cstring>

#include "core/label_rule.h"
#include "core/tile_moments.h"
#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {
namespace {

constexpr auto kDropOffLabel = static_cast<std::uint8_t>(Label::kDropOff);
constexpr auto kUnknownLabel = static_cast<std::uint8_t>(Label::kUnknown);
constexpr std::uint8_t kNotSeen = 0, kTaken = 1, kLarge = 2;

/// [px] of an error that hangs together.
constexpr int kBump = 2 * kTileSize;

}  // namespace

bool DropOffSpecks::isLarge(const ImageInput& input, double min_width) const {
  if (outline_.side() < kBump) return false;
  const Pixel last = pixels_.back();
  const auto z = static_cast<double>(metresAt(input.depth, last.u, last.v));
  const CameraModel& camera = input.rays.camera();
  return outline_.side() * z / std::max(camera.fx, camera.fy) >= min_width;
}

/// Stops where the piece is known to be large: what is left of it is found to hang together with
/// it.
/// @return whether the piece is too small.
bool DropOffSpecks::grow(const ImageInput& input, Pixel start, double min_width,
                         const std::vector<std::uint8_t>& labels) {
  const int width = input.depth.width, height = input.depth.height;
  const auto indexOf = [width](int u, int v) { return static_cast<std::size_t>(v * width + u); };
  pixels_.assign(1, start);
  outline_ = {start.u, start.u, start.v, start.v};
  seen_[indexOf(start.u, start.v)] = kTaken;
  for (std::size_t next = 0; next < pixels_.size(); ++next) {
    const Pixel pixel = pixels_[next];
    for (int v = std::max(pixel.v - 1, 0); v <= std::min(pixel.v + 1, height - 1); ++v) {
      for (int u = std::max(pixel.u - 1, 0); u <= std::min(pixel.u + 1, width - 1); ++u) {
        std::uint8_t& seen = seen_[indexOf(u, v)];
        if (seen == kLarge) return false;
        if (seen == kTaken || labels[indexOf(u, v)] != kDropOffLabel) continue;
        seen = kTaken;
        pixels_.push_back({u, v});
        outline_.add(u, v);
        if (isLarge(input, min_width)) return false;
      }
    }
  }
  return true;
}

void DropOffSpecks::settle(const ImageInput& input, Pixel start, double min_width,
                           std::vector<std::uint8_t>& labels) {
  const bool is_speck = grow(input, start, min_width, labels);
  for (const Pixel& pixel : pixels_) {
    const auto at = static_cast<std::size_t>(pixel.v * input.depth.width + pixel.u);
    seen_[at] = kLarge;
    if (is_speck) labels[at] = kUnknownLabel;
  }
}

void DropOffSpecks::remove(const ImageInput& input, const std::vector<std::uint8_t>& tiles,
                           double min_width, std::vector<std::uint8_t>& labels) {
  const int width = input.depth.width;
  const int columns = covering(width, kTileSize);
  seen_.assign(labels.size(), kNotSeen);
  pixels_.reserve(labels.size());
  for (int v = 0; v < input.depth.height; ++v) {
    const std::uint8_t* row = labels.data() + static_cast<std::ptrdiff_t>(v) * width;
    const std::uint8_t* kinds = tiles.data() + static_cast<std::ptrdiff_t>(v / kTileSize) * columns;
    for (int u = 0; u < width; ++u) {
      const void* found = std::memchr(row + u, kDropOffLabel, static_cast<std::size_t>(width - u));
      if (found == nullptr) break;
      u = static_cast<int>(static_cast<const std::uint8_t*>(found) - row);
      const std::uint8_t kind = kinds[u / kTileSize];
      if (kind != kNearGround && kind != kSmeared) {
        u = (u / kTileSize + 1) * kTileSize - 1;  // to the next tile
      } else if (seen_[static_cast<std::size_t>(v * width + u)] == kNotSeen) {
        settle(input, {u, v}, min_width, labels);
      }
    }
  }
}

}  // namespace dominant_plane_detection
