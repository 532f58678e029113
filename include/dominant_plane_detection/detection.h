#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace dominant_plane_detection {

/// Why there is a plane, or none. The values are those of DominantPlane.msg.
enum class State : std::uint8_t {
  kFound = 0,
  kNoDepth,           ///< no pixel has a reading within the range limits
  kTooFewPoints,      ///< too few readings for a region to start from
  kNoRegion,          ///< no seed lies on a plane
  kTooSmall,          ///< the largest region covers too little of the image
  kTooTilted,         ///< the largest region is no ground: its normal is too far from "up"
  kOutOfHeightRange,  ///< the largest region is no ground: the camera's height over it
  kBadInput,          ///< image and camera do not fit together, or cannot be read
};

/// @return the name in DominantPlane.msg and planes.csv, for example "TOO_SMALL".
const char* stateName(State state);

/// What a pixel shows, one byte a pixel.
enum class Label : std::uint8_t {
  kUnknown = 0,  ///< no reading, out of range but for drop-offs, a speck at the ground's height, or
                 ///< an edge's smear
  kGround = 1,
  kObstacle = 2,       ///< above the ground
  kDropOff = 3,        ///< below the ground
  kMissingGround = 4,  ///< no reading where the ground should be seen
};

/// What a plane beside the dominant one is, were the dominant one the ground. The values are those
/// of DominantPlaneArray.msg.
enum class PlaneKind : std::uint8_t {
  kFloor = 0,  ///< as high as the ground
  kRamp,       ///< 5 to 45 degrees steep, or less and rising from the ground's height
  kStep,       ///< level, up to 0.35 m higher or lower
  kTable,      ///< level, more than that; a ceiling, too
  kWall,       ///< 45 degrees and steeper
};

/// @return the name in planes_more.csv, for example "ramp".
const char* kindName(PlaneKind kind);

/// Where the expected "up" direction came from. The values are those of DominantPlane.msg.
enum class UpSource : std::uint8_t { kNone = 0, kFixed, kImu, kTf };

/// [#] The work that a detection took. Counts, never times: the same image takes the same.
struct Effort {
  std::size_t seeds = 0;     ///< that were tried; a predicted plane is one
  std::size_t regions = 0;   ///< that were grown
  std::size_t tests = 0;     ///< of candidates: tiles (grid) or points (kdtree)
  std::size_t joined = 0;    ///< of these, those that joined a region
  std::size_t fits = 0;      ///< of a plane
  std::size_t searches = 0;  ///< in the k-d tree (kdtree)
};

/// @return what stands for a covariance that is not known: -1 in the first element.
inline Eigen::Matrix4d unknownCovariance() {
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  covariance(0, 0) = -1.0;
  return covariance;
}

/// A plane beside the dominant one; normal, distance and covariance as there.
struct FurtherPlane {
  PlaneKind kind = PlaneKind::kFloor;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double distance = 0.0;  ///< [m]
  Eigen::Matrix4d covariance = unknownCovariance();
  double mean_square_error = 0.0;  ///< [m^2] of the inliers
  std::size_t inliers = 0;         ///< [px]
};

/// The dominant plane of one depth image, in the depth optical frame.
///
/// Without a plane (state other than kFound) the numbers are NaN, the counts 0 and every label
/// kUnknown; where there was no image, or of an impossible size, it has no labels and the size 0.
struct Detection {
  State state = State::kNoDepth;
  std::string reason;  ///< empty when found, otherwise one sentence with the numbers
  /// [-] unit normal from the plane to the camera ("up" for a floor): normal . r + distance = 0.
  Eigen::Vector3d normal = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  double distance = std::numeric_limits<double>::quiet_NaN();  ///< [m] camera's height, >= 0
  /// Of [normal, distance], of rank 3: along the normal itself it is 0, and it has no inverse. The
  /// first element is -1 while it is not known.
  Eigen::Matrix4d covariance = unknownCovariance();
  double mean_square_error = std::numeric_limits<double>::quiet_NaN();  ///< [m^2] Eq. 8, inliers
  /// [px] labelled ground; those of ramps (`max_ramp`) are not among them.
  std::size_t inliers = 0;
  std::size_t valid_pixels = 0;  ///< [px] with a reading within the range limits
  UpSource up_source = UpSource::kNone;
  bool tracked = false;  ///< the predicted plane of the prior led to it
  Effort effort;
  int image_width = 0;               ///< [px]
  int image_height = 0;              ///< [px]
  std::vector<std::uint8_t> labels;  ///< `Label` of each pixel, row-major
  /// Most inliers first, at most `max_planes` less the dominant one.
  std::vector<FurtherPlane> further_planes;
  /// The number of each pixel's plane, row-major: 0 none, 1 the dominant one, 2 the first of the
  /// further ones; empty unless further planes or ramps are looked for.
  std::vector<std::uint8_t> plane_index;

  /// @param point [m] in the optical frame.
  /// @return [m] its height over the plane, NaN without one.
  double height(const Eigen::Vector3d& point) const { return normal.dot(point) + distance; }

  bool found() const { return state == State::kFound; }
  /// @return where a pixel is in `labels` and `plane_index`.
  std::size_t indexOf(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(image_width) +
           static_cast<std::size_t>(u);
  }
  Label label(int u, int v) const { return static_cast<Label>(labels[indexOf(u, v)]); }
  /// @return whether a pixel is ground on the dominant plane: no ramp's.
  bool onPlane(int u, int v) const {
    const bool ground = label(u, v) == Label::kGround;
    return ground && (plane_index.empty() || plane_index[indexOf(u, v)] == 1);
  }
  /// @return [-] inliers as a share of the valid pixels; NaN without a plane.
  double inlierShare() const {
    return found() ? static_cast<double>(inliers) / static_cast<double>(valid_pixels)
                   : std::numeric_limits<double>::quiet_NaN();
  }
};

}  // namespace dominant_plane_detection
