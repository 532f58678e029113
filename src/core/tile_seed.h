#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/plane_moments.h"
#include "core/tile_judge.h"

namespace dominant_plane_detection {

/// What a region starts from: a tile and those about it that lie on one plane. A single tile is too
/// small for a plane that holds far beyond it; nine are ten times better.
struct TileSeed {
  std::array<std::size_t, 9> tiles{};  ///< the seed first
  std::size_t count = 0;               ///< of these
  PlaneMoments moments;
  PlaneFit fit{};
};

/// Fits a plane to the seed and its neighbours; those that lie on something else are left out once.
/// @param taken 1 for tiles that belong to another region.
/// @return nothing where fewer than six of them lie on a plane, the seed among them, or their mean
/// square error is not below epsilon squared.
std::optional<TileSeed> fitSeed(TileJudge& judge, const std::vector<std::uint8_t>& taken,
                                std::size_t seed);

}  // namespace dominant_plane_detection
