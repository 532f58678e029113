#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace dominant_plane_detection {

/// Draws indices of a range at random, each at most once (Fisher-Yates, one step a draw).
class RandomDraw {
 public:
  /// Forgets what was drawn and restarts the generator.
  void restart(std::uint32_t random_seed) { generator_.seed(random_seed); }
  /// The next draws are from [begin, end) of the range 0, 1, ...
  void setRange(std::size_t begin, std::size_t end);
  bool empty() const { return next_ == indices_.size(); }
  /// @pre !empty()
  std::size_t draw();
  /// @return a number of [0, bound), evenly distributed.
  /// @pre bound > 0
  std::size_t below(std::size_t bound);

 private:
  std::mt19937 generator_;
  std::vector<std::size_t> indices_;
  std::size_t next_ = 0;
};

}  // namespace dominant_plane_detection
