#pragma once

#include <array>
#include <type_traits>

#include "dominant_plane_detection/parameters.h"

namespace dominant_plane_detection {

/// What users are told about a parameter.
struct ParameterInfo {
  const char* name;
  const char* unit;
  double min;
  double max;
  const char* text;  ///< without double quotes, which dynamic_reconfigure does not take
};

/// Whether members of a type have limits; `min` and `max` of others have no meaning.
template <typename T>
inline constexpr bool kHasLimits = std::is_same_v<T, int> || std::is_same_v<T, double>;

/// What users call the values of an enumeration, in their order.
template <typename Choice>
inline constexpr std::array<const char*, 0> kChoiceNames{};
template <>
inline constexpr std::array<const char*, 2> kChoiceNames<Algorithm>{"grid", "kdtree"};
template <>
inline constexpr std::array<const char*, 3> kChoiceNames<Preference>{"auto", "largest", "lowest"};

/// Lets a template take a set of parameters, const or not, and nothing else.
template <typename T, typename Set>
using IfParameters = std::enable_if_t<std::is_same_v<std::remove_const_t<T>, Set>, int>;

/// The one list of all parameters: name, unit, limits and text, with the member that holds it.
///
/// Readers of YAML, dynamic_reconfigure and the command line all walk this list. After a change
/// here or of a default, scripts/update_parameters writes the .cfg, the YAML file and the README's
/// table.
/// @param parameters a `Parameters`, const or not.
/// @param visit called as visit(ParameterInfo, member) with a member of type bool, int or double,
/// or an enumeration. The text of an enumeration tells each value: "value: meaning; ...".
template <typename ParametersT, typename Visitor, IfParameters<ParametersT, Parameters> = 0>
void visitParameters(ParametersT& parameters, Visitor&& visit) {
  using Info = ParameterInfo;
  auto& p = parameters;
  visit(Info{"algorithm", "-", 0, 1,
             "grid: region growing over image tiles; kdtree: Algorithm 1 point by point"},
        p.algorithm);
  visit(Info{"random_seed", "-", 0, 1000000,
             "of the generator that draws the seeds, restarted at each image"},
        p.random_seed);
  visit(Info{"range_min", "m", 0.05, 20, "nearest depth that is trusted"}, p.range_min);
  visit(Info{"range_max", "m", 0.1, 40, "farthest depth that is trusted"}, p.range_max);
  visit(
      Info{"noise_constant", "m", 0.0001, 0.1, "constant part of the standard deviation of depth"},
      p.noise.constant);
  visit(Info{"noise_quadratic", "1/m", 0, 0.1, "standard deviation of depth per squared depth"},
        p.noise.quadratic);
  visit(Info{"smooth_error_constant", "m", 0.00001, 0.1,
             "constant part of the rms of 112 x 112 pixels of a floor over its plane"},
        p.smooth_error.constant);
  visit(Info{"smooth_error_quadratic", "1/m", 0, 0.1,
             "rms of 112 x 112 pixels of a floor over its plane per squared depth"},
        p.smooth_error.quadratic);
  visit(Info{"wide_error_constant", "m", 0, 1,
             "constant part of the rms error that a large part of an image shares"},
        p.wide_error.constant);
  visit(Info{"wide_error_quadratic", "1/m", 0, 0.1,
             "rms error that a large part of an image shares per squared depth over the cosine of "
             "the angle of incidence"},
        p.wide_error.quadratic);
  visit(Info{"seeds", "#", 1, 10000, "most seeds that are tried"}, p.seeds);
  visit(Info{"subsampling", "px", 1, 16, "every n-th point of every n-th row (kdtree only)"},
        p.subsampling);
  visit(Info{"delta", "m", 0, 1, "farthest a candidate may be from the region, constant part"},
        p.delta.offset);
  visit(
      Info{"delta_sigmas", "-", 0, 100, "farthest a candidate may be from the region, in sigma(z)"},
      p.delta.sigmas);
  visit(Info{"epsilon", "m", 0, 1, "square root of the largest mean square error, constant part"},
        p.epsilon.offset);
  visit(Info{"epsilon_sigmas", "-", 0, 100,
             "square root of the largest mean square error, in sigma(z)"},
        p.epsilon.sigmas);
  visit(Info{"gamma", "m", 0, 1, "farthest a candidate may be from the plane, constant part"},
        p.gamma.offset);
  visit(
      Info{"gamma_sigmas", "-", 0, 100, "farthest a candidate may be from the plane, in sigma(z)"},
      p.gamma.sigmas);
  visit(Info{"join_pieces", "-", 0, 1,
             "pieces of the plane beyond a gap wider than delta join the region"},
        p.join_pieces);
  visit(Info{"ground_band", "m", 0, 1, "largest height of a ground pixel, constant part"},
        p.ground_band.offset);
  visit(Info{"ground_band_sigmas", "-", 0, 100, "largest height of a ground pixel, in sigma(z)"},
        p.ground_band.sigmas);
  visit(Info{"local_error_constant", "m", 0.00001, 0.1,
             "constant part of the rms of 4 x 4 pixels over the ground about them"},
        p.local_error.constant);
  visit(Info{"local_error_quadratic", "1/m", 0, 0.1,
             "rms of 4 x 4 pixels over the ground about them per squared depth"},
        p.local_error.quadratic);
  visit(Info{"false_alarm_rate", "1/image", 0, 1000,
             "of low obstacles, were errors normal; 0: the ground band alone decides"},
        p.false_alarm_rate);
  visit(Info{"min_obstacle_height", "m", 0, 1, "lowest obstacle within the ground band"},
        p.min_obstacle_height);
  visit(Info{"min_obstacle_width", "m", 0, 1,
             "narrowest obstacle within the ground band, and narrowest drop-off"},
        p.min_obstacle_width);
  visit(
      Info{
          "max_planes", "#", 1, 32,
          "planes that are told, the dominant one among them; further ones need half of min_share"},
      p.max_planes);
  visit(Info{"max_ramp", "rad", 0, 0.78,
             "steepest ramp that is labelled ground where it joins the ground; 0: none is"},
        p.max_ramp);
  visit(
      Info{
          "missing_ground", "-", 0, 1,
          "no reading where ground should be seen is labelled, from min_obstacle_width squared on"},
      p.missing_ground);
  visit(Info{"covariance", "-", 0, 1, "of normal and distance; false: unknown"}, p.covariance);
  visit(Info{"min_patch", "px", 0, 1000000,
             "smallest connected piece of ground, if the image had 640 x 480 pixels"},
        p.min_patch);
  visit(
      Info{"min_share", "-", 0, 1, "smallest plane, as a share of the pixels with a trusted depth"},
      p.min_share);
  visit(
      Info{"prefer", "-", 0, 2,
           "auto: lowest where up comes from tf or gravity, otherwise largest; largest: the plane "
           "with the most pixels; lowest: the lowest one within 10 degrees of up with 8 % of them"},
      p.prefer);
  visit(Info{"expected_up_x", "-", -1, 1, "expected up direction in the optical frame, x (right)"},
        p.expected_up.x());
  visit(Info{"expected_up_y", "-", -1, 1, "expected up direction in the optical frame, y (down)"},
        p.expected_up.y());
  visit(
      Info{"expected_up_z", "-", -1, 1, "expected up direction in the optical frame, z (forward)"},
      p.expected_up.z());
  visit(
      Info{"max_tilt", "rad", 0, 3.15, "largest angle between the plane's normal and expected up"},
      p.max_tilt);
  visit(Info{"min_height", "m", 0, 100, "lowest camera height over the plane"}, p.min_height);
  visit(Info{"max_height", "m", 0.01, 100, "highest camera height over the plane"}, p.max_height);
}

}  // namespace dominant_plane_detection
