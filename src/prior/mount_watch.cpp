#include "prior/mount_watch.h"

#include <cmath>
#include <cstdio>

namespace dominant_plane_detection {
namespace {

constexpr double kMountError =
    0.175;  // [rad] a mount is reported, not refused, that is off by less
/// Height by tf: of a floor that is uneven, and a mount that was knocked.
constexpr double kHeightError = 0.1;        // [m]
constexpr double kHeightErrorShare = 0.05;  // [-] of the height
constexpr int kManyElsewhere = 15;          // [#] images

}  // namespace

MountedGround mountedGround(const Eigen::Isometry3d& camera) {
  MountedGround ground{{camera.linear().transpose() * Eigen::Vector3d::UnitZ(), kMountError},
                       std::nullopt};
  const double height = camera.translation().z();
  if (height > 0.0) {
    ground.height = Prior::ExpectedHeight{height, kHeightError + kHeightErrorShare * height};
  }
  return ground;
}

void MountWatch::forget() {
  compared_.reset();
  elsewhere_ = 0;
  heights_ = Heights();
  text_.clear();
}

void MountWatch::add(double stamp, const Detection& detection,
                     const std::optional<Eigen::Isometry3d>& camera,
                     const std::optional<Prior::ExpectedHeight>& height) {
  constexpr double kPatience = 1.0;  // [s]
  if (!camera || !height || !detection.found()) {
    if (!compared_ || !(stamp - *compared_ < kPatience)) {
      text_.clear();
      elsewhere_ = 0;
    }
    return;
  }
  compared_ = stamp;
  const double off = detection.distance - height->height;
  elsewhere_ = std::abs(off) > height->tolerance ? elsewhere_ + 1 : 0;
  ++(elsewhere_ == 0 ? heights_.expected : heights_.others);
  if (elsewhere_ == 0) {
    check_.add(stamp, detection, *camera);
    text_ = check_.moved() ? check_.moved()->text() : "";
  } else if (elsewhere_ >= kManyElsewhere) {
    char text[200];
    std::snprintf(
        text, sizeof(text),
        "The plane is %.2f m %s where tf has the ground of %s: it is another level, or the "
        "mount is not where tf has it.",
        std::abs(off), off < 0.0 ? "above" : "below", base_frame_.c_str());
    text_ = text;
  }
}

}  // namespace dominant_plane_detection
