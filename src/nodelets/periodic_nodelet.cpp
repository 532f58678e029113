#include "nodelets/periodic_nodelet.h"

namespace dominant_plane_detection {
namespace {

constexpr double kSoon = 0.01;   // [s] after onInit
constexpr double kPeriod = 1.0;  // [s]

}  // namespace

void PeriodicNodelet::onInit() {
  try {
    name_ = std::make_unique<NameClaim>(getName());
    start();
  } catch (const std::exception& error) {
    NODELET_ERROR_STREAM("Could not start: " << error.what());
    return;
  }
  started_ = true;
  const auto tick = [this](const ros::WallTimerEvent&) {
    timer_.setPeriod(ros::WallDuration(kPeriod));
    onTimer();
  };
  timer_ = getNodeHandle().createWallTimer(ros::WallDuration(kSoon), tick, false, false);
  timer_.start();
}

}  // namespace dominant_plane_detection
