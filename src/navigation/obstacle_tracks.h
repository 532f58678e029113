#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "navigation/upright_box.h"

namespace dominant_plane_detection {

/// A thing that is known from image to image.
struct TrackedBox {
  std::uint32_t id;      ///< from 1 on; never given twice
  std::uint32_t images;  ///< [#] in which it was seen
  UprightBox box;        ///< of this image
};

/// Keeps the identities of things: a box is the thing that was last seen where it is, on a frame
/// that does not move with the camera. What is not seen for a second, and in three images, is
/// forgotten.
///
/// Things are told from the image on in which they were seen often enough, and as long as they are
/// seen in more than half of the images: wrong readings are elsewhere in each image.
class ObstacleTracks {
 public:
  /// @param least [#] images in which a thing has to be seen.
  explicit ObstacleTracks(std::uint32_t least) : least_(least) {}

  /// @param stamp [s] of the image; before the last, or 5 s after it, all things are forgotten.
  /// @param boxes in the frame on the ground.
  /// @param T_world_ground of that frame by odometry. Without odometry the identity: then things
  /// are followed that move less than 0.2 m against the camera from image to image.
  /// @return those of the boxes that are told, in their order; valid until the next call.
  const std::vector<TrackedBox>& follow(double stamp, const std::vector<UprightBox>& boxes,
                                        const Eigen::Isometry2d& T_world_ground);
  /// Identities go on.
  void forget() { things_.clear(); }

 private:
  /// A thing as it was last seen, in the world.
  struct Thing {
    std::uint32_t id, images;
    std::uint32_t missed;  ///< [#] images since it was first seen, in which it was not
    std::uint32_t lost;    ///< [#] of them, those since it was last seen
    double stamp;          ///< [s] when it was last seen
    UprightBox box;
  };
  /// How well a box fits a thing.
  struct Fit {
    double distance;  ///< [m] of the centres
    std::size_t box, thing;
  };

  void collectFits();

  std::uint32_t least_;
  double stamp_ = 0.0;
  std::uint32_t last_id_ = 0;
  std::vector<Thing> things_;
  std::vector<UprightBox> in_world_;  ///< the boxes of the image
  std::vector<Fit> fits_;
  std::vector<std::size_t> thing_of_;  ///< each box; past the last one while it has none
  std::vector<bool> taken_;            ///< each thing
  std::vector<TrackedBox> tracked_;
};

}  // namespace dominant_plane_detection
