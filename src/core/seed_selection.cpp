#include "core/seed_selection.h"

#include <numeric>
#include <utility>

namespace dominant_plane_detection {

void RandomDraw::setRange(std::size_t begin, std::size_t end) {
  indices_.resize(end - begin);
  std::iota(indices_.begin(), indices_.end(), begin);
  next_ = 0;
}

std::size_t RandomDraw::draw() {
  std::swap(indices_[next_], indices_[next_ + below(indices_.size() - next_)]);
  return indices_[next_++];
}

std::size_t RandomDraw::below(std::size_t bound) {
  // The upper 32 bits of a 32 x 32 bit product; std::uniform_int_distribution differs from library
  // to library, and results have to be the same everywhere.
  return static_cast<std::size_t>((static_cast<std::uint64_t>(generator_()) * bound) >> 32U);
}

}  // namespace dominant_plane_detection
