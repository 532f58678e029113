#pragma once

#include <Eigen/Core>
#include <vector>

namespace dominant_plane_detection {

/// What motion capture says of an image of the hand-held camera over a desk; see the recordings'
/// own description.
struct DeskTruth {
  double stamp;               ///< [s]
  Eigen::Vector3d up;         ///< [-] in the optical frame
  double floor, table;        ///< [m] camera over it
  double on_floor, on_table;  ///< [-] share of the pixels
};

/// @return nothing where the recordings are missing.
std::vector<DeskTruth> readDeskTruth();
/// @param stamp [s], which the truth has rounded to microseconds.
/// @return null where there is none.
const DeskTruth* findTruth(const std::vector<DeskTruth>& truths, double stamp);

}  // namespace dominant_plane_detection
