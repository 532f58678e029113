#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "dominant_plane_detection/noise_model.h"

namespace dominant_plane_detection {

enum class Algorithm : std::uint8_t {
  kGrid,    ///< region growing over image tiles
  kKdtree,  ///< Algorithm 1 point by point, as published
};

/// Which of several planes that could be the ground is it, where its height is not known.
enum class Preference : std::uint8_t {
  kAuto,     ///< the lowest where up is known by tf or gravity, otherwise the largest
  kLargest,  ///< the one with the most pixels
  kLowest,   ///< the lowest within 10 degrees of up that holds 8 % of the valid pixels
};

/// Everything that can be set about the detection. Names, order, ranges and texts for users stand
/// once, in parameter_table.h.
struct Parameters {
  Algorithm algorithm = Algorithm::kGrid;
  int random_seed = 1;     ///< [-] of the generator that draws the seeds, restarted at each image
  double range_min = 0.5;  ///< [m] nearest depth that is trusted
  double range_max = 4.0;  ///< [m] farthest depth that is trusted
  NoiseModel noise;        ///< sigma(z)
  NoiseModel smooth_error{0.0013, 0.001};  ///< [m] rms of large parts of a floor over its plane
  WideErrorModel wide_error;               ///< [m] rms of what large parts of an image share

  int seeds = 64;                  ///< [#] most seeds that are tried
  int subsampling = 2;             ///< [px] n of "every n-th point of every n-th row"; kdtree only
  DepthThreshold delta{0.0, 6.0};  ///< [m] farthest a candidate may be from the region
  DepthThreshold epsilon{0.0, 1.0};  ///< [m] square root of the largest mean square error
  DepthThreshold gamma{0.0, 3.0};    ///< [m] farthest a candidate may be from the plane

  bool join_pieces = true;  ///< pieces of the plane beyond a gap wider than delta join

  DepthThreshold ground_band{0.0, 5.0};    ///< [m] outer limit: what is higher is never ground
  NoiseModel local_error{0.0005, 0.0012};  ///< [m] rms of blocks over the ground about them
  double false_alarm_rate = 0.2;       ///< [1/image] of low obstacles; 0: ground_band alone decides
  double min_obstacle_height = 0.005;  ///< [m] lowest obstacle within the ground band
  double min_obstacle_width = 0.08;    ///< [m] narrowest one
  int max_planes = 1;                  ///< [#] planes that are told, the dominant one among them
  double max_ramp = 0.0;       ///< [rad] steepest ramp that is ground where it joins it; 0: none is
  bool missing_ground = true;  ///< is told from what is unknown
  bool covariance = true;      ///< of normal and distance
  int min_patch = 400;         ///< [px] smallest connected piece of ground, of 640 x 480 pixels
  double min_share = 0.05;     ///< [-] smallest plane, as a share of the valid pixels
  Preference prefer = Preference::kAuto;
  Eigen::Vector3d expected_up{0.0, -1.0, 0.0};  ///< [-] in the optical frame, of any length
  double max_tilt = 1.05;    ///< [rad] largest angle between normal and expected up
  double min_height = 0.0;   ///< [m] lowest camera height over the plane
  double max_height = 10.0;  ///< [m] highest camera height over the plane
};

/// Finds every value that cannot be used.
/// @return one sentence each, with name, range, unit and what came; empty when all is well.
std::vector<std::string> findErrors(const Parameters& parameters);

/// Sets a parameter from text, as a command line or a YAML file gives it.
/// @throw std::invalid_argument for a name that does not exist (lists those that do) and for a text
/// that is not a value of the parameter's type.
void setParameter(Parameters& parameters, const std::string& name, const std::string& value);

}  // namespace dominant_plane_detection
