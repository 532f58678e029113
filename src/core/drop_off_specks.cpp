#include "core/drop_off_specks.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "core/label_rule.h"
#include "core/tile_moments.h"
#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {
namespace {

constexpr auto kDropOffLabel = static_cast<std::uint8_t>(Label::kDropOff);
constexpr auto kUnknownLabel = static_cast<std::uint8_t>(Label::kUnknown);
constexpr std::uint8_t kNotSeen = 0, kTaken = 1, kSettled = 2;

/// [-] Of the image's larger side, over which an error hangs together.
constexpr double kBump = 1.0 / 40.0;

}  // namespace

void DropOffSpecks::take(const ImageInput& input, Pixel pixel) {
  const auto at = static_cast<std::size_t>(pixel.v * input.depth.width + pixel.u);
  seen_[at] = kTaken;
  pixels_.push_back(pixel);
  nearest_ = std::min(nearest_, metresAt(input.depth, pixel.u, pixel.v));
}

bool DropOffSpecks::isLarge(const ImageInput& input, const PixelOutline& outline,
                            double min_width) const {
  const int width = input.depth.width, height = input.depth.height;
  if (outline.left == 0 || outline.top == 0 || outline.right + 1 == width ||
      outline.bottom + 1 == height) {
    return true;
  }
  return outline.width(static_cast<double>(nearest_), input.rays.camera()) >= min_width &&
         outline.side() >= kBump * std::max(width, height);
}

/// Stops where the piece is known to be large: what is left of it is found to hang together with
/// it.
/// @return whether the piece is too small.
bool DropOffSpecks::grow(const ImageInput& input, Pixel start, double min_width,
                         const std::vector<std::uint8_t>& labels) {
  const int width = input.depth.width, height = input.depth.height;
  const auto indexOf = [width](int u, int v) { return static_cast<std::size_t>(v * width + u); };
  pixels_.clear();
  PixelOutline outline(start);
  nearest_ = std::numeric_limits<float>::infinity();
  take(input, start);
  for (std::size_t next = 0; next < pixels_.size(); ++next) {
    const Pixel pixel = pixels_[next];
    for (int v = std::max(pixel.v - 1, 0); v <= std::min(pixel.v + 1, height - 1); ++v) {
      for (int u = std::max(pixel.u - 1, 0); u <= std::min(pixel.u + 1, width - 1); ++u) {
        const std::uint8_t seen = seen_[indexOf(u, v)];
        if (seen == kSettled) return false;
        if (seen == kTaken || labels[indexOf(u, v)] != kDropOffLabel) continue;
        take(input, {u, v});
        outline.add({u, v});
        if (isLarge(input, outline, min_width)) return false;
      }
    }
  }
  return !isLarge(input, outline, min_width);
}

void DropOffSpecks::settle(const ImageInput& input, Pixel start, double min_width,
                           std::vector<std::uint8_t>& labels) {
  const bool is_speck = grow(input, start, min_width, labels);
  for (const Pixel& pixel : pixels_) {
    const auto at = static_cast<std::size_t>(pixel.v * input.depth.width + pixel.u);
    seen_[at] = kSettled;
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
