#include "navigation/obstacle_tracks.h"

#include <algorithm>

namespace dominant_plane_detection {
namespace {

// For which a thing that is not seen is known.
constexpr double kSilence = 5.0;      // [s] without an image, after which nothing is known
constexpr double kMemory = 1.0;       // [s]
constexpr std::uint32_t kImages = 3;  // [#] images, which may be more
/// [m] How far the centre of one box may be from the other: what odometry and the box's own error
/// make of it between two images, or a person who walks.
constexpr double kGate = 0.2;

/// @return [m] of a place on the ground from a box; 0 within it.
double distanceTo(const UprightBox& box, const Eigen::Vector2d& place) {
  const Eigen::Vector2d at = Eigen::Rotation2Dd(-box.yaw) * (place - box.centre);
  return (at.cwiseAbs() - 0.5 * Eigen::Vector2d(box.length, box.width)).cwiseMax(0.0).norm();
}

}  // namespace

const std::vector<TrackedBox>& ObstacleTracks::follow(double stamp,
                                                      const std::vector<UprightBox>& boxes,
                                                      const Eigen::Isometry2d& T_world_ground) {
  if (stamp < stamp_ || stamp > stamp_ + kSilence) forget();
  stamp_ = stamp;
  in_world_ = boxes;
  const double turn = Eigen::Rotation2Dd(T_world_ground.linear()).smallestAngle();
  for (UprightBox& box : in_world_) {
    box.centre = T_world_ground * box.centre;
    box.yaw += turn;
  }
  collectFits();
  const std::size_t known = things_.size();
  thing_of_.assign(boxes.size(), known);
  taken_.assign(known, false);
  for (const Fit& fit : fits_) {
    if (thing_of_[fit.box] < known || taken_[fit.thing]) continue;
    taken_[fit.thing] = true;
    thing_of_[fit.box] = fit.thing;
  }
  for (std::size_t k = 0; k < known; ++k) {
    things_[k].missed += taken_[k] ? 0 : 1;
    things_[k].lost += taken_[k] ? 0 : 1;
  }
  tracked_.clear();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (thing_of_[i] == known) {
      thing_of_[i] = things_.size();
      things_.push_back({++last_id_, 0, 0, 0, stamp, {}});
    }
    Thing& thing = things_[thing_of_[i]];
    thing = {thing.id, thing.images + 1, thing.missed, 0, stamp, in_world_[i]};
    const bool told = thing.images >= least_ && thing.images > thing.missed;
    if (told) tracked_.push_back({thing.id, thing.images, boxes[i]});
  }
  things_.erase(std::remove_if(things_.begin(), things_.end(),
                               [&](const Thing& thing) {
                                 return thing.lost >= kImages && thing.stamp < stamp - kMemory;
                               }),
                things_.end());
  return tracked_;
}

/// The best first. Of a wall, of which each image shows another part, the centre moves along it.
void ObstacleTracks::collectFits() {
  fits_.clear();
  for (std::size_t i = 0; i < in_world_.size(); ++i) {
    for (std::size_t k = 0; k < things_.size(); ++k) {
      const UprightBox &box = in_world_[i], &thing = things_[k].box;
      const double apart = std::min(distanceTo(box, thing.centre), distanceTo(thing, box.centre));
      if (apart <= kGate) fits_.push_back({(box.centre - thing.centre).norm(), i, k});
    }
  }
  std::sort(fits_.begin(), fits_.end(),
            [](const Fit& a, const Fit& b) { return a.distance < b.distance; });
}

}  // namespace dominant_plane_detection
