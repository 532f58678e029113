#include "ros/mount_service.h"

#include <chrono>
#include <stdexcept>

#include "ros/queued_call.h"

namespace dominant_plane_detection {
namespace {

constexpr std::uint32_t kUsualFrames = 100;
constexpr std::uint32_t kMostFrames = 10000;  // five minutes
constexpr std::chrono::seconds kPatience{5};  // without an image

}  // namespace

CalibrateMount::Response toResponse(const Mount& mount) {
  CalibrateMount::Response response;
  response.success = true;
  response.frames = static_cast<std::uint32_t>(mount.frames);
  response.height = mount.height;
  response.pitch = mount.pitch;
  response.roll = mount.roll;
  response.height_error = mount.height_error;
  response.pitch_error = mount.pitch_error;
  response.roll_error = mount.roll_error;
  response.launch = mount.launchText();
  return response;
}

MountService::MountService(const ros::NodeHandle& node, std::function<void()> wish_changed)
    : node_queue_(*node.getCallbackQueue()),
      wish_changed_(std::move(wish_changed)),
      spinner_(1, &queue_) {
  ros::NodeHandle own(node);
  own.setCallbackQueue(&queue_);
  server_ = own.advertiseService("calibrate_mount", &MountService::onCall, this);
  spinner_.start();
}

MountService::~MountService() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  spinner_.stop();
  server_.shutdown();
  removeCalls(node_queue_, this);
}

void MountService::tellWishChanged() { callLater(node_queue_, this, wish_changed_); }

bool MountService::wants() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return estimate_.has_value();
}

void MountService::add(const Detection& detection, const std::string& frame_id) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!estimate_) return;
  estimate_->add(detection, frame_id);
  changed_.notify_all();
}

bool MountService::onCall(CalibrateMount::Request& request, CalibrateMount::Response& response) {
  try {
    if (request.frames > kMostFrames) {
      throw std::invalid_argument("expected at most " + std::to_string(kMostFrames) +
                                  " frames (0: " + std::to_string(kUsualFrames) + "), got " +
                                  std::to_string(request.frames));
    }
    response = toResponse(collect(request.frames == 0 ? kUsualFrames : request.frames).mount());
  } catch (const std::exception& error) {
    response = CalibrateMount::Response();
    response.message = error.what();
  }
  return true;
}

MountEstimate MountService::collect(std::size_t frames) {
  std::unique_lock<std::mutex> lock(mutex_);
  estimate_.emplace();
  lock.unlock();
  tellWishChanged();
  lock.lock();
  for (std::size_t before = 0; !ending_ && before < frames; before = estimate_->frames()) {
    const bool more =
        changed_.wait_for(lock, kPatience, [&] { return ending_ || estimate_->frames() > before; });
    if (!more) break;
  }
  const MountEstimate estimate = *std::exchange(estimate_, std::nullopt);
  const bool complete = estimate.frames() >= frames;
  lock.unlock();
  tellWishChanged();
  if (complete) return estimate;
  throw std::runtime_error("expected " + std::to_string(frames) + " images, got " +
                           std::to_string(estimate.frames()) + " before none came any more");
}

}  // namespace dominant_plane_detection
