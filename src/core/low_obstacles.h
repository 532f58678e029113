#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/block_heights.h"
#include "core/local_ground.h"
#include "dominant_plane_detection/noise_model.h"

namespace dominant_plane_detection {

/// What is an obstacle although it is no higher than the worst error of the sensor.
struct LowObstacleLimits {
  double min_height = 0.0;        ///< [m] over the ground about it
  double min_width = 0.0;         ///< [m] the larger side of its outline in the image
  double false_alarm_rate = 0.0;  ///< [1/image] of blocks that the local error lifts over the limit
  NoiseModel local_error;         ///< [m] rms of a block's height over the ground about it
};

/// What changed among the ground pixels.
struct GroundLoss {
  std::size_t pixels = 0;
  double square_height = 0.0;  ///< [m^2] summed over these
};

/// Finds what stands on the ground within the ground band, by its height over the ground nearby.
///
/// A block is evidence where its mean is higher than the ground about it by more than the local
/// error explains. How much that is follows from the number of blocks and the rate of false alarms:
/// were the errors of all blocks independent and normally distributed, that many blocks an image
/// would exceed it. From such blocks an obstacle grows over the pixels that hang together and reach
/// 0.4 of its height; where it is narrower than `min_width` it is left alone, as the bumps of the
/// local error are. What is within 0.6 of the narrow band is on the plane itself and stays ground;
/// other pixels at an obstacle's edge that are neither on it nor on the ground are unknown.
///
/// Next to what is tall, and to where nothing can be read, depth is smeared over some pixels:
/// there is no evidence in such tiles and those about them. Next to what is beyond the band may be
/// its foot, and in tiles off the plane that hang together with it: there, what is farther from the
/// plane than the narrow band is unknown.
class LowObstacles {
 public:
  /// Reads the heights of all blocks, and the ground about them.
  /// @param input has to outlive `mark`.
  /// @param rule the plane with the ground band.
  /// @param tiles kElsewhere or kNearGround; those of the latter that are smeared become kSmeared.
  void look(const ImageInput& input, const LabelRule& rule, const LowObstacleLimits& limits,
            std::vector<std::uint8_t>& tiles);

  /// @param labels one `Label` a pixel by the ground band; ground and unknown ones may change.
  GroundLoss mark(std::vector<std::uint8_t>& labels);

  /// @return [-] the height over the ground nearby, in local errors, that is evidence.
  static double evidence(std::size_t blocks, double false_alarm_rate);

 private:
  struct Pixel {
    int u, v;
  };
  /// The outline of a candidate, grown pixel by pixel.
  struct Outline {
    int left, right, top, bottom;  ///< [px]
  };

  void spreadFeet(std::vector<std::uint8_t>& tiles);
  void widen(const std::vector<std::uint8_t>& marked, std::vector<std::uint8_t>& wide);
  bool isUnsure(const GroundLevel& level, int x, int y) const;
  void search(const GroundLevel& level, std::vector<std::uint8_t>& labels);
  bool isEvidence(const GroundLevel& level, int x, int y) const;
  float reachOf(const GroundLevel& level, Pixel pixel) const;
  void grow(const GroundLevel& level, Pixel start, std::vector<std::uint8_t>& labels);
  bool joins(const GroundLevel& level, Pixel pixel);
  bool isInside(Pixel pixel) const;
  void write(const GroundLevel& level, std::vector<std::uint8_t>& labels);
  void change(Pixel pixel, float height, std::uint8_t label, std::vector<std::uint8_t>& labels);
  std::optional<float> heightOff(Pixel pixel) const;
  std::size_t indexOf(Pixel pixel) const;

  const ImageInput* input_ = nullptr;
  LabelRule rule_{};
  LowObstacleLimits limits_;
  float evidence_ = 0.0F;  ///< [-] in local errors
  GroundLoss loss_;
  BlockHeights blocks_;
  LocalGround local_ground_;
  std::vector<std::uint8_t> marked_tiles_, in_row_;  ///< of `widen`
  std::vector<std::uint8_t> near_beyond_;  ///< 1 for tiles beyond the band, and those about them
  std::vector<std::size_t> feet_;          ///< tiles, in the order they were found
  std::vector<std::uint8_t> unsure_;       ///< 1 for tiles that are off, and those about them
  std::vector<float> reach_;        ///< [m] of a level's blocks: height of the evidence about them
  std::vector<std::uint8_t> seen_;  ///< what became of each pixel in this level
  std::vector<Pixel> evidence_blocks_;  ///< of the level: column and row
  std::vector<Pixel> pixels_;           ///< of one candidate
};

}  // namespace dominant_plane_detection
