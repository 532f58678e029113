#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dominant_plane_detection {

/// Adds their eight neighbours to the tiles that are 1: first those in the row, then the rows next
/// to it.
/// @param tiles row-major, as many as `columns` x `rows` or more.
/// @param in_row is overwritten.
inline void widenTiles(int columns, int rows, const std::vector<std::uint8_t>& tiles,
                       std::vector<std::uint8_t>& in_row, std::vector<std::uint8_t>& wide) {
  const auto width = static_cast<std::size_t>(columns), height = static_cast<std::size_t>(rows);
  in_row.assign(tiles.begin(), tiles.begin() + static_cast<std::ptrdiff_t>(width * height));
  for (std::size_t row = 0; row < height; ++row) {
    const std::uint8_t* from = tiles.data() + row * width;
    std::uint8_t* to = in_row.data() + row * width;
    for (std::size_t i = 1; i < width; ++i) to[i] |= from[i - 1];
    for (std::size_t i = 1; i < width; ++i) to[i - 1] |= from[i];
  }
  wide = in_row;
  for (std::size_t i = width; i < in_row.size(); ++i) wide[i] |= in_row[i - width];
  for (std::size_t i = width; i < in_row.size(); ++i) wide[i - width] |= in_row[i];
}

}  // namespace dominant_plane_detection
