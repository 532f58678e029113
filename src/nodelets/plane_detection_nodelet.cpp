#include "nodelets/plane_detection_nodelet.h"

#include <chrono>
#include <map>
#include <pluginlib/class_list_macros.hpp>

#include "ros/correction_parameter.h"
#include "ros/parameter_file.h"
#include "ros/sensor_profiles.h"

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

/// Sets the parameters of the profile that `sensor` names, over whatever they were.
void takeProfile(const ros::NodeHandle& node) {
  const std::string sensor = node.param<std::string>("sensor", "");
  if (sensor.empty()) return;
  try {
    Parameters checked;
    std::map<std::string, std::string> profile;
    visitParameterFile(findSensorProfile(sensor),
                       [&](const std::string& name, const std::string& value) {
                         setParameter(checked, name, value);
                         profile[name] = value;
                       });
    for (const auto& [name, value] : profile) node.setParam(name, value);
  } catch (const std::exception& error) {
    ROS_ERROR_STREAM("Refused " << node.resolveName("sensor")
                                << ", the parameters stay as they are: " << error.what());
  }
}

}  // namespace

void PlaneDetectionNodelet::onTimer() {
  // Somebody may have come during the start.
  followListeners();
  diagnostics_->report({inputs_->subscribed(), inputs_->counts(), inputs_->topics(),
                        inputs_->problem(), subscription_error_, prior_->status(),
                        trials_.cause()});
}

void PlaneDetectionNodelet::start() {
  const ros::NodeHandle& node = getNodeHandle();
  ros::NodeHandle& private_node = getPrivateNodeHandle();
  takeProfile(private_node);
  detector_ = DominantPlaneDetector(
      loadParameters<Parameters, PlaneDetectionConfig>(private_node, nodeletParameters()));
  trials_ = NoPlaneTrials(detector_.parameters());
  correction_ = readCorrection(private_node);
  learner_ = std::make_unique<CorrectionLearner>(private_node, detector_.parameters().noise,
                                                 correction_.has_value());
  inputs_ = std::make_unique<DetectionInputs>(
      node, private_node, readInputKind(private_node), private_node.param("rectified", false),
      [this](const DetectionInputs::Frame& frame) { onFrame(frame); });
  const NodeParameters own = loadNodeParameters(private_node);
  frames_ = std::make_unique<RobotFrames>(node);
  body_ = std::make_unique<RobotBody>(private_node, own, *frames_, rays_);
  prior_ = std::make_unique<PlanePrior>(node, own, *frames_);
  pictures_ = std::make_unique<PictureInput>(node, private_node, [this] { overlay_->onPicture(); });
  const auto listeners_changed = [this] { followListeners(); };
  outputs_.advertise(private_node, listeners_changed);
  overlay_ = std::make_unique<OverlayOutput>(private_node, *pictures_, listeners_changed);
  clouds_ = std::make_unique<CloudOutputs>(private_node, own, *frames_, *pictures_, rays_,
                                           listeners_changed);
  ground_tf_ = std::make_unique<GroundTf>(own, *frames_);
  scan_ = std::make_unique<ScanOutput>(private_node, own, rays_, listeners_changed);
  map_ = std::make_unique<MapOutput>(private_node, own, *frames_, rays_, listeners_changed);
  boxes_ = std::make_unique<BoxOutput>(private_node, own, *frames_, rays_, listeners_changed);
  mount_service_ = std::make_unique<MountService>(private_node, listeners_changed);
  reconfigure_ = std::make_unique<dynamic_reconfigure::Server<PlaneDetectionConfig>>(private_node);
  reconfigure_->setCallback(
      [this](PlaneDetectionConfig& config, std::uint32_t) { onReconfigure(config); });
  diagnostics_ = std::make_unique<DetectionDiagnostics>(node, private_node, getName());
}

void PlaneDetectionNodelet::followListeners() {
  if (!started()) return;
  std::string error;
  try {
    trySubscriptions();
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  // Tried again at the next occasion: once a second at least.
  if (!error.empty() && error != subscription_error_) {
    NODELET_ERROR_STREAM("Could not subscribe, see "
                         << getPrivateNodeHandle().resolveName("image_transport") << ": " << error);
  }
  subscription_error_ = error;
}

void PlaneDetectionNodelet::trySubscriptions() {
  const bool wanted = outputs_.anybodyListens() || overlay_->anybodyListens() ||
                      clouds_->anybodyListens() || ground_tf_->always() ||
                      scan_->anybodyListens() || map_->anybodyListens() ||
                      boxes_->anybodyListens() || mount_service_->wants() || learner_->wants();
  if (wanted && !inputs_->subscribed()) {
    inputs_->subscribe();
    prior_->subscribe();
  } else if (!wanted && inputs_->subscribed()) {
    inputs_->unsubscribe();
    prior_->unsubscribe();
    trials_ = NoPlaneTrials(detector_.parameters());
  }
  overlay_->followListeners();
  pictures_->follow(overlay_->anybodyListens() || clouds_->wantPictures());
}

void PlaneDetectionNodelet::onFrame(const DetectionInputs::Frame& frame) {
  try {
    detect(prepared(frame));
  } catch (const std::exception& error) {
    diagnostics_->countFailure(error.what());
    NODELET_ERROR_STREAM_THROTTLE(5.0, "Dropped an image: " << error.what());
  }
}

/// @return the image without the camera's fixed error and the robot's body.
DetectionInputs::Frame PlaneDetectionNodelet::prepared(const DetectionInputs::Frame& frame) {
  DetectionInputs::Frame result = frame;
  if (correction_) result.depth = correction_->correct(frame.depth);
  result.depth = body_->mask(result);
  return result;
}

void PlaneDetectionNodelet::detect(const DetectionInputs::Frame& frame) {
  pictures_->beginImage(frame.header.frame_id);
  const Prior prior = prior_->of(frame);
  const auto start = std::chrono::steady_clock::now();
  const Detection& detection = detector_.detect(frame.depth, frame.camera, prior);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  diagnostics_->count(detection, time.count());
  prior_->add(frame, detection);
  mount_service_->add(detection, frame.header.frame_id);
  learner_->add(frame, detection);
  outputs_.publish(frame, detection, time.count());
  const Parameters& parameters = detector_.parameters();
  const auto ground_frame = groundFrame(frame, detection);
  scan_->publish(frame, detection, ground_frame, parameters.range_max);
  map_->publish(frame, detection, ground_frame, parameters);
  boxes_->publish(frame, detection, parameters);
  clouds_->publish(frame, detection);  // after the tf that they may be in
  overlay_->publish(frame, detection);
  trials_.add(frame.depth, frame.camera, prior, detection);
}

/// Lets the frame on the ground go out where somebody needs it.
/// @return which one is there now.
std::optional<std::string> PlaneDetectionNodelet::groundFrame(const DetectionInputs::Frame& frame,
                                                              const Detection& detection) {
  const bool wanted = ground_tf_->always() || scan_->anybodyListens() || map_->needsGroundFrame();
  if (!wanted || !detection.found()) return std::nullopt;
  return ground_tf_->publish(frame.header, detection);
}

void PlaneDetectionNodelet::onReconfigure(PlaneDetectionConfig& config) {
  const Parameters parameters = fromConfig<Parameters>(config);
  const std::string errors = joined(findErrors(parameters));
  if (errors.empty()) {
    detector_ = DominantPlaneDetector(parameters);
    trials_ = NoPlaneTrials(parameters);
    return;
  }
  NODELET_ERROR_STREAM("Refused parameters, the old ones stay: " << errors);
  config = toConfig<PlaneDetectionConfig>(detector_.parameters());  // goes back to whoever asked
}

}  // namespace dominant_plane_detection

PLUGINLIB_EXPORT_CLASS(dominant_plane_detection::PlaneDetectionNodelet, nodelet::Nodelet)
