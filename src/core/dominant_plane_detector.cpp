#include "dominant_plane_detection/dominant_plane_detector.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>
#include <string>

#include "core/grid_search.h"
#include "core/ground_segmentation.h"
#include "core/kdtree_search.h"
#include "core/missing_ground.h"
#include "core/plane_covariance.h"
#include "core/plane_fusion.h"
#include "core/plane_inventory.h"
#include "core/plane_selection.h"
#include "core/ray_table.h"
#include "core/tile_moments.h"

namespace dominant_plane_detection {
namespace {

/// [px] Larger images come from no depth camera, but from broken headers.
constexpr int kMaxSide = 8192;
/// What the lowest plane is looked for among: level ones, large enough to be one.
constexpr double kLevelTilt = 0.1745;  // [rad] 10 degrees
constexpr double kLowestShare = 0.08;  // [-] of the valid pixels

using Sentence = std::array<char, 256>;

void requireValid(const Parameters& parameters) {
  std::string all;
  for (const std::string& error : findErrors(parameters)) all += (all.empty() ? "" : "; ") + error;
  if (!all.empty()) throw std::invalid_argument(all);
}

/// @return whether there is an image, of a size that can be.
bool isPossible(const DepthView& depth) {
  return depth.data != nullptr && depth.width > 0 && depth.height > 0 && depth.width <= kMaxSide &&
         depth.height <= kMaxSide;
}

/// Writes why something cannot be used.
/// @return false
template <typename... Values>
bool refuseWith(Sentence& sentence, const char* format, Values... values) {
  std::snprintf(sentence.data(), sentence.size(), format, values...);
  return false;
}

/// @return whether image and camera can be used; otherwise `sentence` says why not.
bool check(const DepthView& depth, const CameraModel& camera, Sentence& sentence) {
  const auto refuse = [&](auto... values) { return refuseWith(sentence, values...); };
  if (depth.data == nullptr || depth.width <= 0 || depth.height <= 0) {
    return refuse("Expected a depth image, got an empty one of %d x %d pixels.", depth.width,
                  depth.height);
  }
  if (depth.width > kMaxSide || depth.height > kMaxSide) {
    return refuse("Expected a depth image of at most %d pixels a side, got %d x %d.", kMaxSide,
                  depth.width, depth.height);
  }
  const std::size_t row = static_cast<std::size_t>(depth.width) * pixelSize(depth.type);
  if (depth.step < row) {
    return refuse("Expected rows of at least %zu bytes, got a step of %zu.", row, depth.step);
  }
  if (!(metresPerUnit(depth) > 0.0F && std::isfinite(metresPerUnit(depth)))) {
    return refuse("Expected metres_per_unit to be positive and finite, got %g.",
                  static_cast<double>(depth.metres_per_unit));
  }
  if (!camera.valid()) {
    return refuse("Expected finite, positive focal lengths, got fx = %g, fy = %g.", camera.fx,
                  camera.fy);
  }
  if (camera.width != depth.width || camera.height != depth.height) {
    return refuse("Expected a camera of the image's size %d x %d, got %d x %d.", depth.width,
                  depth.height, camera.width, camera.height);
  }
  return true;
}

/// @return the same of what is known before.
bool check(const Prior& prior, Sentence& sentence) {
  const auto refuse = [&](auto... values) { return refuseWith(sentence, values...); };
  const double up_length = prior.expected_up ? prior.expected_up->norm() : 1.0;
  if (!(up_length > 1e-3 && std::isfinite(up_length))) {
    return refuse("Expected an up direction, got a vector of length %g.", up_length);
  }
  if (!(prior.up_error >= 0.0)) {
    return refuse("Expected an error of up of 0 rad or more, got %g.", prior.up_error);
  }
  if (prior.expected_height &&
      !(prior.expected_height->height > 0.0 && prior.expected_height->tolerance >= 0.0)) {
    return refuse("Expected a positive height and its tolerance, got %g and %g m.",
                  prior.expected_height->height, prior.expected_height->tolerance);
  }
  if (prior.predicted_plane) {
    const Prior::PredictedPlane& plane = *prior.predicted_plane;
    if (!(std::abs(plane.normal.norm() - 1.0) < 1e-3 && plane.distance >= 0.0 &&
          std::isfinite(plane.distance) && plane.weight >= 0.0 && plane.weight < 1.0)) {
      return refuse(
          "Expected a predicted plane with a unit normal, a distance >= 0 and a weight below 1, "
          "got a normal of length %g, %g m and %g.",
          plane.normal.norm(), plane.distance, plane.weight);
    }
  }
  if (prior.height_range && !(prior.height_range->min < prior.height_range->max)) {
    return refuse("Expected a height range that ascends, got %g to %g m.", prior.height_range->min,
                  prior.height_range->max);
  }
  return true;
}

}  // namespace

class DominantPlaneDetector::Implementation {
 public:
  explicit Implementation(const Parameters& parameters) : parameters_(parameters) {
    requireValid(parameters);
    detection_.reason.reserve(Sentence().size());
  }

  const Parameters& parameters() const { return parameters_; }

  const Detection& detect(const DepthView& depth, const CameraModel& camera, const Prior& prior) {
    clear(depth, prior);
    Sentence sentence{};
    if (!check(depth, camera, sentence) || !check(prior, sentence)) {
      return refuse(State::kBadInput, sentence);
    }
    rays_.build(camera);
    const ImageInput input{depth, rays_, {metresPerUnit(depth), rangeMin(), rangeMax()}};
    computeTileMoments(depth, rays_, rangeMin(), rangeMax(), tiles_);
    detection_.valid_pixels =
        static_cast<std::size_t>(std::accumulate(tiles_.count.begin(), tiles_.count.end(), 0.0));
    if (detection_.valid_pixels == 0) {
      std::snprintf(sentence.data(), sentence.size(),
                    "None of %d x %d pixels has a reading between %.2f and %.2f m.", depth.width,
                    depth.height, parameters_.range_min, parameters_.range_max);
      return refuse(State::kNoDepth, sentence);
    }

    PlaneSelection selection(limits(prior));
    search(input, prior, selection);
    if (detection_.effort.seeds == 0) {
      std::snprintf(sentence.data(), sentence.size(),
                    "%zu pixels have a reading, too few or too scattered for a region to start.",
                    detection_.valid_pixels);
      return refuse(State::kTooFewPoints, sentence);
    }
    if (!selection.found()) {
      selection.explain(detection_.effort.seeds, sentence);
      return refuse(selection.refusal(), sentence);
    }
    return accept(input, prior, selection);
  }

 private:
  void search(const ImageInput& input, const Prior& prior, PlaneSelection& selection) {
    std::optional<HessePlane> predicted;
    if (prior.predicted_plane) {
      predicted = HessePlane{-prior.predicted_plane->normal, prior.predicted_plane->distance};
    }
    const GridSearch::Image image{tiles_, rays_.camera(), minPatch()};
    if (parameters_.algorithm == Algorithm::kGrid) {
      grid_.run(image, parameters_, predicted, selection, detection_.effort);
      detection_.tracked = selection.found() && grid_.tracked();
      return;
    }
    kdtree_.run(input, parameters_, selection, detection_.effort);
    if (!selection.found()) return;
    grid_.collectGround(image, parameters_, selection.plane(), kdtree_.regionTiles());
  }

  /// @return [px] smallest piece of ground in an image of this size.
  std::size_t minPatch() const {
    const double share =
        static_cast<double>(detection_.image_width) * detection_.image_height / (640.0 * 480.0);
    return static_cast<std::size_t>(std::ceil(parameters_.min_patch * share));
  }

  /// @return [px] a share of the pixels with a reading, rounded up.
  std::size_t shareOfValid(double share) const {
    return static_cast<std::size_t>(
        std::ceil(share * static_cast<double>(detection_.valid_pixels)));
  }

  /// @return [px] smallest further plane: they need half of what the dominant one needs.
  std::size_t minFurther() const {
    return std::max(shareOfValid(0.5 * parameters_.min_share), minPatch());
  }

  float rangeMin() const { return static_cast<float>(parameters_.range_min); }
  float rangeMax() const { return static_cast<float>(parameters_.range_max); }

  /// Everything as it is without a plane; memory is kept.
  void clear(const DepthView& depth, const Prior& prior) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    detection_.state = State::kNoDepth;
    detection_.reason.clear();
    detection_.normal.setConstant(kNaN);
    detection_.distance = kNaN;
    detection_.covariance = unknownCovariance();
    detection_.mean_square_error = kNaN;
    detection_.inliers = 0;
    detection_.valid_pixels = 0;
    detection_.tracked = false;
    detection_.effort = Effort();
    detection_.further_planes.clear();
    detection_.plane_index.clear();
    detection_.up_source = prior.expected_up ? prior.up_source : UpSource::kFixed;
    const bool possible = isPossible(depth);
    detection_.image_width = possible ? depth.width : 0;
    detection_.image_height = possible ? depth.height : 0;
  }

  PlaneLimits limits(const Prior& prior) const {
    PlaneLimits limits{prior.expected_up.value_or(parameters_.expected_up).normalized(),
                       parameters_.max_tilt,
                       prior.height_range ? prior.height_range->min : parameters_.min_height,
                       prior.height_range ? prior.height_range->max : parameters_.max_height,
                       std::max(shareOfValid(parameters_.min_share), minPatch())};
    limits.expected_height = prior.expected_height;
    if (prefersLowest(prior)) {
      limits.max_tilt =
          std::min(limits.max_tilt, kLevelTilt + (prior.expected_up ? prior.up_error : 0.0));
      limits.lowest_from = std::max(shareOfValid(kLowestShare), limits.min_points);
    }
    return limits;
  }

  bool prefersLowest(const Prior& prior) const {
    const bool known = prior.expected_up &&
                       (prior.up_source == UpSource::kImu || prior.up_source == UpSource::kTf);
    return parameters_.prefer == Preference::kLowest ||
           (parameters_.prefer == Preference::kAuto && known);
  }

  SegmentationLimits segmentationLimits() const {
    const Parameters& p = parameters_;
    return {p.noise,
            p.ground_band,
            {p.min_obstacle_height, p.min_obstacle_width, p.false_alarm_rate, p.local_error}};
  }

  const Detection& refuse(State state, const Sentence& sentence) {
    detection_.state = state;
    detection_.tracked = false;
    detection_.reason.assign(sentence.data());
    detection_.valid_pixels = 0;
    detection_.labels.assign(static_cast<std::size_t>(detection_.image_width) *
                                 static_cast<std::size_t>(detection_.image_height),
                             static_cast<std::uint8_t>(Label::kUnknown));
    return detection_;
  }

  const Detection& accept(const ImageInput& input, const Prior& prior,
                          const PlaneSelection& selection) {
    const HessePlane& plane = selection.plane();
    const Eigen::Vector3d normal = -plane.normal;
    const SegmentationCounts counts =
        segmentation_.label(input, normal, plane.distance, segmentationLimits(),
                            {grid_.ground(), grid_.otherSurfaces()}, detection_.labels);
    if (counts.ground < selection.minPoints()) {
      Sentence sentence{};
      std::snprintf(
          sentence.data(), sentence.size(),
          "Only %zu pixels are ground, fewer than the required %zu (min_share, min_patch, "
          "ground_band).",
          counts.ground, selection.minPoints());
      return refuse(State::kTooSmall, sentence);
    }
    detection_.state = State::kFound;
    detection_.normal = normal;
    detection_.distance = plane.distance;
    detection_.inliers = counts.ground;
    detection_.mean_square_error = counts.mean_square_error;
    inventory_.tell(
        {input, tiles_, plane, grid_.ground(), minFurther(), {parameters_.join_pieces, minPatch()}},
        parameters_, detection_);
    if (parameters_.missing_ground) {
      missing_ground_.mark(input, plane, tiles_, parameters_.min_obstacle_width, detection_.labels);
    }
    if (parameters_.covariance) {
      detection_.covariance = covariance_.estimate(tiles_, grid_.ground(), plane,
                                                   errorSizes(parameters_), input.depth.width);
    }
    if (detection_.tracked) smooth(*prior.predicted_plane);
    return detection_;
  }

  /// Labels and error stay those of what is seen.
  void smooth(const Prior::PredictedPlane& predicted) {
    const UncertainPlane fused =
        fuse({detection_.normal, detection_.distance, detection_.covariance}, predicted);
    detection_.normal = fused.normal;
    detection_.distance = fused.distance;
    detection_.covariance = fused.covariance;
  }

  Parameters parameters_;
  RayTable rays_;
  TileMoments tiles_;
  GridSearch grid_;
  KdtreeSearch kdtree_;
  GroundSegmentation segmentation_;
  MissingGround missing_ground_;
  PlaneInventory inventory_;
  PlaneCovariance covariance_;
  Detection detection_;
};

DominantPlaneDetector::DominantPlaneDetector(const Parameters& parameters)
    : implementation_(std::make_unique<Implementation>(parameters)) {}
DominantPlaneDetector::~DominantPlaneDetector() = default;
DominantPlaneDetector::DominantPlaneDetector(DominantPlaneDetector&&) noexcept = default;
DominantPlaneDetector& DominantPlaneDetector::operator=(DominantPlaneDetector&&) noexcept = default;

const Detection& DominantPlaneDetector::detect(const DepthView& depth, const CameraModel& camera,
                                               const Prior& prior) {
  return implementation_->detect(depth, camera, prior);
}

const Parameters& DominantPlaneDetector::parameters() const {
  return implementation_->parameters();
}

}  // namespace dominant_plane_detection
