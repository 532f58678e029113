#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "doctor/finding.h"
#include "dominant_plane_detection/dominant_plane_detector.h"

namespace dominant_plane_detection {

/// Looks for what keeps the detector from seeing a plane by looking again with one thing changed:
/// what heals most of the images that showed none is the cause.
class ImageTrials {
 public:
  explicit ImageTrials(const Parameters& parameters);

  /// An image that was looked at as it should be.
  /// @param detection what was seen of it; with a plane nothing more is tried.
  void add(const DepthView& depth, const CameraModel& camera, const Prior& prior,
           const Detection& detection);
  /// @return `upside-down` or `range-max`, or nothing: with planes in more than a quarter of
  /// the images, with a single one without where more came, and where nothing heals most of these.
  Findings findings() const;

  std::size_t images() const { return images_; }
  std::size_t planes() const { return images_ - failed_; }

 private:
  /// Another value of one thing.
  struct Trial {
    bool upside_down = false;
    double range_max = 0.0;  ///< [m] 0: as it is
    std::size_t healed = 0;  ///< [#] images with a plane only by it
  };

  /// @return whether there is a plane by it, at tf's height where that is known.
  bool heals(const Trial& trial, const DepthView& depth, const CameraModel& camera,
             const Prior& prior) const;
  Finding describe(const Trial& trial) const;

  Parameters parameters_;
  std::vector<Trial> trials_;  ///< the likeliest first
  std::size_t images_ = 0;
  std::size_t failed_ = 0;  ///< [#] without a plane
  UpSource up_source_ = UpSource::kFixed;
  std::string reason_;  ///< of the last one without
};

}  // namespace dominant_plane_detection
