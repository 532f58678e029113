#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/label_kernel.h"
#include "core/obstacle_evidence.h"
#include "core/pixel_outline.h"

namespace dominant_plane_detection {

/// Labels what stands on the ground within the ground band, by its height over the ground nearby.
///
/// From the blocks that are evidence an obstacle grows over the pixels that hang together and reach
/// 0.4 of its height, and from those down its face: pixels that fall towards the ground at least
/// half as steeply as a vertical face would. Where it is narrower than `min_width` it is left
/// alone, as the bumps of the local error are. What is within 0.6 of the narrow band of the plane,
/// or of the ground nearby where that is lower, stays ground but for faces; other pixels at an
/// obstacle's edge that are neither on it nor on the ground are unknown.
class LowObstacles {
 public:
  /// @param input has to outlive `mark`.
  /// @param rule the plane with the ground band.
  /// @param blocks heights over it.
  /// @param kinds the `TileKind` of each tile; those kNearGround that are smeared become kSmeared.
  void look(const ImageInput& input, const LabelRule& rule, const BlockHeights& blocks,
            const LowObstacleLimits& limits, std::vector<std::uint8_t>& kinds);

  /// @param labels one `Label` a pixel by the ground band; ground and unknown ones may change.
  /// @return what is ground no more.
  LabelSums mark(std::vector<std::uint8_t>& labels);

 private:
  /// A pixel with a reading in the working range.
  struct Reading {
    Pixel pixel;
    float z;       ///< [m]
    float height;  ///< [m] over the plane
  };

  bool isInImage(Pixel pixel) const;
  std::size_t indexOf(Pixel pixel) const;
  std::uint8_t& labelOf(Pixel pixel) const;
  std::optional<Reading> read(Pixel pixel) const;
  bool isOnGround(const Reading& reading, float ground) const;
  void search(const GroundLevel& level);
  void spreadReach(const GroundLevel& level);
  float reachOf(const GroundLevel& level, Pixel pixel) const;
  void grow(const GroundLevel& level);
  bool join(const GroundLevel& level, Pixel pixel);
  bool joinFace(const GroundLevel& level, const Reading& above, Pixel pixel);
  bool isFace(const Reading& above, const Reading& below, float over) const;
  bool isWide() const;
  bool isInside(Pixel pixel) const;
  void write(const GroundLevel& level);
  void writeEdge(const GroundLevel& level, Pixel pixel);
  void change(Pixel pixel, float height, std::uint8_t label);

  ObstacleEvidence evidence_;
  const ImageInput* input_ = nullptr;
  LabelRule rule_{};
  double min_width_ = 0.0;  ///< [m]
  LabelSums lost_;
  std::vector<std::uint8_t>* labels_ = nullptr;
  std::vector<Evidence> blocks_;    ///< of a level
  std::vector<float> reach_;        ///< [m] of a level's blocks: height of the evidence about them
  std::vector<std::uint8_t> seen_;  ///< what became of each pixel in this level
  std::vector<Reading> pixels_;     ///< of one candidate
};

}  // namespace dominant_plane_detection
