#include "ros/correction_learner.h"

#include <ros/console.h>

#include <chrono>
#include <exception>
#include <stdexcept>

#include "calibration/depth_correction_file.h"

namespace dominant_plane_detection {
namespace {

constexpr double kBetween = 1.0;      // [s]
constexpr std::size_t kMinute = 60;   // [#] images
constexpr std::size_t kEnough = 600;  // [#]

/// What the thread does: writes what was learned, or says why not.
void learn(const FloorCorrection& correction, const std::string& file) {
  try {
    const FloorCorrection::Result learned = correction.learn();
    saveDepthCorrection(file, learned);
    ROS_INFO_STREAM(
        "Wrote " << file << ", learned from " << learned.images << " images: on others it leaves "
                 << 100.0 * learned.after / learned.before
                 << " % of the floor's unevenness. It is applied from the next start on "
                    "that names it as correction.");
  } catch (const std::exception& error) {
    ROS_INFO_STREAM("Learned no correction of depth from " << correction.images()
                                                           << " images: " << error.what());
  }
}

}  // namespace

CorrectionLearner::CorrectionLearner(const ros::NodeHandle& node, const NoiseModel& noise,
                                     bool corrected)
    : file_(node.param<std::string>("learn_correction", "")), correction_(noise) {
  if (file_.empty() || !corrected) return;
  ROS_ERROR_STREAM(
      "Refused " << node.resolveName("learn_correction")
                 << ": expected depth as the camera gives it, got a correction as well");
  file_.clear();
}

void CorrectionLearner::add(const DetectionInputs::Frame& frame, const Detection& detection) {
  if (file_.empty()) return;
  const ros::Time now = frame.header.stamp;
  // A recording may begin again.
  if (!last_.isZero() && now >= last_ && (now - last_).toSec() < kBetween) return;
  last_ = now;
  try {
    correction_.add(frame.depth, frame.camera, detection);
  } catch (const std::runtime_error& error) {
    ROS_ERROR_STREAM("No correction of depth is learned any more: " << error.what());
    file_.clear();
    return;
  }
  if (correction_.images() < learned_from_ + kMinute) return;
  const bool busy =
      learning_.valid() && learning_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
  if (!busy) begin();
}

void CorrectionLearner::begin() {
  learned_from_ = correction_.images();
  learning_ =
      std::async(std::launch::async, [copy = correction_, file = file_] { learn(copy, file); });
  if (learned_from_ >= kEnough) file_.clear();
}

}  // namespace dominant_plane_detection
