#include "nodelets/plane_detection_nodelet.h"

#include <chrono>
#include <pluginlib/class_list_macros.hpp>

namespace dominant_plane_detection {
namespace {

InputKind readInputKind(const ros::NodeHandle& node) {
  const std::string name = node.param<std::string>("input", "depth");
  if (name == "points") return InputKind::kPoints;
  if (name != "depth") {
    ROS_ERROR_STREAM("Refused " << node.resolveName("input") << ": expected depth or points, got '"
                                << name << "'; depth is used.");
  }
  return InputKind::kDepth;
}

}  // namespace

PlaneDetectionNodelet::~PlaneDetectionNodelet() {
  // Each of these waits for its running callback, which may be waiting for the mutex: it must not
  // be held here. Outputs first, or else a new listener would subscribe the inputs again.
  if (mount_service_) mount_service_->shutdown();
  outputs_.shutdown();
  if (inputs_) inputs_->unsubscribe();
  reconfigure_.reset();
}

void PlaneDetectionNodelet::onInit() {
  try {
    start();
  } catch (const std::exception& error) {
    NODELET_ERROR_STREAM("Could not start: " << error.what());
  }
}

void PlaneDetectionNodelet::start() {
  ros::NodeHandle& private_node = getPrivateNodeHandle();
  // Somebody may connect before everything is in place, and has to wait until it is.
  const boost::lock_guard<boost::recursive_mutex> lock(mutex_);
  detector_ = DominantPlaneDetector(
      loadParameters<Parameters, PlaneDetectionConfig>(private_node, {"input", "rectified"}));
  inputs_ = std::make_unique<DetectionInputs>(
      getNodeHandle(), readInputKind(private_node), private_node.param("rectified", false),
      [this](const DetectionInputs::Frame& frame) { onFrame(frame); }, [this] { onPicture(); });
  outputs_.advertise(private_node, [this] { onListenersChanged(); });
  mount_service_ = std::make_unique<MountService>(private_node, [this] { onListenersChanged(); });
  reconfigure_ =
      std::make_unique<dynamic_reconfigure::Server<PlaneDetectionConfig>>(mutex_, private_node);
  reconfigure_->setCallback(
      [this](PlaneDetectionConfig& config, std::uint32_t) { onReconfigure(config); });
}

void PlaneDetectionNodelet::onListenersChanged() {
  const boost::lock_guard<boost::recursive_mutex> lock(mutex_);
  if (!inputs_) return;
  const bool wanted = outputs_.anybodyListens() || (mount_service_ && mount_service_->wants());
  if (wanted == inputs_->subscribed()) return;
  inputs_->subscribed() ? inputs_->unsubscribe() : inputs_->subscribe();
}

void PlaneDetectionNodelet::onFrame(const DetectionInputs::Frame& frame) {
  const boost::lock_guard<boost::recursive_mutex> lock(mutex_);
  try {
    const auto start = std::chrono::steady_clock::now();
    const Detection& detection = detector_.detect(frame.depth, frame.camera);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    mount_service_->add(detection);
    outputs_.publish(frame, detection, time.count(), *inputs_);
  } catch (const std::exception& error) {
    NODELET_ERROR_STREAM_THROTTLE(5.0, "Dropped an image: " << error.what());
  }
}

void PlaneDetectionNodelet::onPicture() {
  const boost::lock_guard<boost::recursive_mutex> lock(mutex_);
  outputs_.publishWaitingOverlay(*inputs_);
}

void PlaneDetectionNodelet::onReconfigure(PlaneDetectionConfig& config) {
  const boost::lock_guard<boost::recursive_mutex> lock(mutex_);
  const Parameters parameters = fromConfig<Parameters>(config);
  const std::string errors = joined(findErrors(parameters));
  if (errors.empty()) {
    detector_ = DominantPlaneDetector(parameters);
    return;
  }
  NODELET_ERROR_STREAM("Refused parameters, the old ones stay: " << errors);
  config = toConfig<PlaneDetectionConfig>(detector_.parameters());  // goes back to whoever asked
}

}  // namespace dominant_plane_detection

PLUGINLIB_EXPORT_CLASS(dominant_plane_detection::PlaneDetectionNodelet, nodelet::Nodelet)
