#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include "core/hesse_plane.h"
#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/prior.h"

namespace dominant_plane_detection {

/// What a plane has to be like to be the ground.
struct PlaneLimits {
  Eigen::Vector3d expected_up;  ///< [-] unit, in the optical frame
  double max_tilt;              ///< [rad]
  double min_height;            ///< [m]
  double max_height;            ///< [m]
  std::size_t min_points;       ///< [px]
  /// Of planes that are within the limits, those at this height come first.
  std::optional<Prior::ExpectedHeight> expected_height = std::nullopt;
  /// [px] Of planes that have as many, the lowest comes first; the others come behind. 0: the
  /// largest comes first.
  std::size_t lowest_from = 0;
};

/// Keeps the plane that is most likely the ground of those that are within the limits, and
/// remembers why the largest one that is not was refused.
///
/// At the expected height, or of levels that hardly differ, the largest wins, of like ones the
/// nearest.
class PlaneSelection {
 public:
  explicit PlaneSelection(const PlaneLimits& limits) : limits_(limits) {}

  /// @param points [px] that lie on the plane.
  /// @param nearest [m] from the camera's foot on the plane to where it begins, if it is one of
  /// several levels: among those of like size, within a quarter, the nearest wins.
  /// @param centre [m] of these points: there it is held against other planes' heights, as a floor
  /// may be bent; else below the camera.
  /// @return kFound if it could be the ground, otherwise why not.
  State consider(const HessePlane& plane, std::size_t points,
                 double nearest = std::numeric_limits<double>::infinity(),
                 const std::optional<Eigen::Vector3d>& centre = std::nullopt);
  /// @return whether the plane that was considered last is the best one.
  bool tookLast() const { return took_last_; }

  /// @param plane of a few tiles, not yet grown.
  /// @return whether it is tilted by so much more than allowed that growing cannot make it right.
  bool clearlyTooTilted(const HessePlane& plane) const;

  const PlaneLimits& limits() const { return limits_; }
  bool found() const { return best_.points > 0; }
  const HessePlane& plane() const { return best_.plane; }
  std::size_t points() const { return best_.points; }  ///< [px] 0 when nothing was found
  std::size_t minPoints() const { return std::max<std::size_t>(limits_.min_points, 1); }  ///< [px]
  /// @return [px] what a plane needs at least to be selected.
  std::size_t toBeat() const;
  /// @param points [px] that are on no plane yet.
  /// @return whether a plane among them could be selected.
  bool isOpen(std::size_t points) const;

  /// @return why nothing was found; kNoRegion when no plane was ever considered.
  State refusal() const { return refusal_; }
  /// Writes the refusal as one sentence with its numbers.
  void explain(std::size_t seeds_tried, std::array<char, 256>& sentence) const;

 private:
  struct Candidate {
    HessePlane plane;
    std::size_t points = 0;
    double nearest = std::numeric_limits<double>::infinity();  ///< [m]
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();          ///< [m]
  };

  /// What a plane is likely to be, the best last.
  enum class Rank { kAny, kLowest, kExpected };

  Rank rank(const Candidate& candidate) const;
  bool beatsBest(const Candidate& candidate) const;
  bool isLarger(const Candidate& candidate) const;
  State checkPose(const HessePlane& plane) const;
  double tilt(const HessePlane& plane) const;

  PlaneLimits limits_;
  Candidate best_;
  std::size_t largest_ = 0;  ///< [px] of those that were the best, since one was so for its size
  Candidate refused_;
  bool took_last_ = false;
  State refusal_ = State::kNoRegion;
};

}  // namespace dominant_plane_detection
