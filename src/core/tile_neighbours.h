#pragma once

#include <algorithm>
#include <cstddef>

namespace dominant_plane_detection {

/// Calls visit(index) for the up to eight tiles about a tile of a row-major grid.
template <typename Visitor>
void forEachNeighbour(std::size_t tile, int columns, int rows, Visitor&& visit) {
  const int column = static_cast<int>(tile) % columns;
  const int row = static_cast<int>(tile) / columns;
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows - 1); ++r) {
    for (int c = std::max(column - 1, 0); c <= std::min(column + 1, columns - 1); ++c) {
      if (r == row && c == column) continue;
      visit(static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) +
            static_cast<std::size_t>(c));
    }
  }
}

}  // namespace dominant_plane_detection
