#include "nodelets/openni2_driver_nodelet.h"

#include <algorithm>
#include <pluginlib/class_list_macros.hpp>

#include "calibration/depth_calibration_file.h"
#include "ros/correction_parameter.h"

namespace dominant_plane_detection {
namespace {

/// What is read once, at the start.
const std::set<std::string> kStartParameters = {
    "device_id",           "depth_frame_id",     "rgb_frame_id",      "depth_camera_info_url",
    "rgb_camera_info_url", "ir_camera_info_url", "depth_calibration", "correction",
    "depth_ir_offset_x",   "depth_ir_offset_y"};

DriverNames readNames(const ros::NodeHandle& node) {
  DriverNames names;
  node.param("depth_frame_id", names.depth_frame_id, names.depth_frame_id);
  node.param("rgb_frame_id", names.rgb_frame_id, names.rgb_frame_id);
  node.param("depth_camera_info_url", names.depth_camera_info_url, names.depth_camera_info_url);
  node.param("rgb_camera_info_url", names.rgb_camera_info_url, names.rgb_camera_info_url);
  node.param("ir_camera_info_url", names.ir_camera_info_url, names.ir_camera_info_url);
  node.param("depth_ir_offset_x", names.depth_ir_offset_x, names.depth_ir_offset_x);
  node.param("depth_ir_offset_y", names.depth_ir_offset_y, names.depth_ir_offset_y);
  return names;
}

/// A serial number of digits only becomes a number on the way through a launch file.
std::string readDeviceId(const ros::NodeHandle& node) {
  XmlRpc::XmlRpcValue value;
  return node.getParam("device_id", value) ? asText(value) : "#1";
}

DepthCalibration readCalibration(const ros::NodeHandle& node) {
  const std::string file = node.param<std::string>("depth_calibration", "");
  if (file.empty()) return DepthCalibration::kinect();
  try {
    return loadDepthCalibration(file);
  } catch (const std::runtime_error& error) {
    ROS_ERROR_STREAM("Refused " << node.resolveName("depth_calibration")
                                << ", the usual calibration of a Kinect v1 is used: "
                                << error.what());
    return DepthCalibration::kinect();
  }
}

}  // namespace

OpenNI2DriverNodelet::~OpenNI2DriverNodelet() {
  stopTimer();
  // The session before the rest: whoever waits for the camera to follow parameters is answered, and
  // no image is published from here on.
  if (session_) session_->end();
  if (waiting_spinner_) waiting_spinner_->stop();
}

void OpenNI2DriverNodelet::onTimer() {
  // Somebody may have come during the start.
  followListeners();
  diagnostics_->report(session_->status());
}

void OpenNI2DriverNodelet::start() {
  const ros::NodeHandle& node = getNodeHandle();
  const ros::NodeHandle& private_node = getPrivateNodeHandle();
  corrector_ =
      std::make_unique<DepthCorrector>(readCalibration(private_node), readCorrection(private_node));
  setParameters(
      loadParameters<DriverParameters, OpenNI2DriverConfig>(private_node, kStartParameters));
  outputs_.advertise(node, readNames(private_node), [this] { followListeners(); });
  diagnostics_ = std::make_unique<DriverDiagnostics>(node, private_node, getName());
  DeviceSession::Callbacks callbacks;
  callbacks.frame = [this](StreamKind kind, const SensorFrame& frame) { onFrame(kind, frame); };
  callbacks.opened = [this](const CameraDevice& camera) { onOpened(camera); };
  callbacks.acceleration = [this](const openni2_plugin::Acceleration& acceleration) {
    onAcceleration(acceleration);
  };
  callbacks.tilt_angle = [this](double angle) { onTiltAngle(angle); };
  serial_server_ =
      getNodeHandle().advertiseService("get_serial", &OpenNI2DriverNodelet::onGetSerial, this);
  const DriverParameters now = parameters();
  session_ = std::make_unique<DeviceSession>(readDeviceId(private_node), now.camera,
                                             now.watchdog_timeout, std::move(callbacks));
  offerMotor();
  offerParameters();
}

void OpenNI2DriverNodelet::offerMotor() {
  MotorTopics::Orders orders;
  orders.tilt = [this](double angle) { session_->order({angle, std::nullopt}); };
  orders.led = [this](openni2_plugin::Led led) { session_->order({std::nullopt, led}); };
  motor_.advertise(getNodeHandle(), std::move(orders), [this] { followListeners(); });
}

/// In a queue of their own, with the reset, as a camera may take its time.
void OpenNI2DriverNodelet::offerParameters() {
  ros::NodeHandle own(getPrivateNodeHandle());
  own.setCallbackQueue(&waiting_queue_);
  reconfigure_ = std::make_unique<dynamic_reconfigure::Server<OpenNI2DriverConfig>>(own);
  reconfigure_->setCallback(
      [this](OpenNI2DriverConfig& config, std::uint32_t) { onReconfigure(config); });
  ros::NodeHandle node(getNodeHandle());
  node.setCallbackQueue(&waiting_queue_);
  reset_server_ = node.advertiseService("reset", &OpenNI2DriverNodelet::onReset, this);
  waiting_spinner_ = std::make_unique<ros::AsyncSpinner>(1, &waiting_queue_);
  waiting_spinner_->start();
}

void OpenNI2DriverNodelet::followListeners() {
  if (!started()) return;
  for (const StreamKind kind : kAllStreams) {
    const bool wanted = outputs_.wants(kind);
    diagnostics_->setWanted(kind, wanted);
    session_->want(kind, wanted);
  }
  session_->wantAcceleration(outputs_.wantsImu());
  session_->wantTiltAngle(motor_.wanted());
}

void OpenNI2DriverNodelet::onFrame(StreamKind kind, const SensorFrame& frame) {
  try {
    const ros::Time stamp = stampOf(kind, frame);
    diagnostics_->count(kind, frame);
    sensor_msgs::ImagePtr image = frame.image;
    if (kind == StreamKind::kDepth) {
      image = corrector_->correct(frame.image, frame.raw);
      if (frame.raw && outputs_.wantsRawDisparity()) {
        outputs_.publishRawDisparity(frame.image, stamp);
      }
    }
    outputs_.publish(kind, frame.registered, image, stamp);
  } catch (const std::exception& error) {
    NODELET_ERROR_STREAM_THROTTLE(5.0, "Dropped an image: " << error.what());
  }
}

ros::Time OpenNI2DriverNodelet::stampOf(StreamKind kind, const SensorFrame& frame) {
  const double arrival = ros::Time::now().toSec();
  const std::lock_guard<std::mutex> lock(mutex_);
  const double seconds = clock_.stamp(static_cast<std::size_t>(kind), frame.device_time, arrival);
  return ros::Time(std::max(seconds + parameters_.time_offset, 0.0));
}

void OpenNI2DriverNodelet::onAcceleration(const openni2_plugin::Acceleration& acceleration) {
  try {
    outputs_.publish(acceleration, ros::Time::now() + ros::Duration(parameters().time_offset));
  } catch (const std::exception& error) {
    NODELET_ERROR_STREAM_THROTTLE(5.0, "Dropped a reading: " << error.what());
  }
}

void OpenNI2DriverNodelet::onTiltAngle(double angle) {
  try {
    motor_.publish(angle);
  } catch (const std::exception& error) {
    NODELET_ERROR_STREAM_THROTTLE(5.0, "Dropped the motor's angle: " << error.what());
  }
}

void OpenNI2DriverNodelet::onOpened(const CameraDevice& camera) {
  outputs_.setCamera(camera);
  diagnostics_->beginNumbers();
  const std::lock_guard<std::mutex> lock(mutex_);
  clock_ = ClockFilter();
}

void OpenNI2DriverNodelet::onReconfigure(OpenNI2DriverConfig& config) {
  const DriverParameters old = parameters();
  std::string error;
  try {
    const auto wanted = fromConfig<DriverParameters>(config);
    error = joined(findErrors(wanted));
    const bool ask = error.empty() && !(wanted.camera == old.camera);
    if (ask) error = session_->apply(wanted.camera);
    if (error.empty()) {
      session_->setPatience(wanted.watchdog_timeout);
      setParameters(wanted);
    }
  } catch (const std::invalid_argument& exception) {
    error = exception.what();
  }
  if (error.empty()) return;
  NODELET_ERROR_STREAM("Refused parameters, the old ones stay: " << error << ".");
  config = toConfig<OpenNI2DriverConfig>(old);  // goes back to whoever asked
}

bool OpenNI2DriverNodelet::onReset(std_srvs::Trigger::Request& /*request*/,
                                   std_srvs::Trigger::Response& response) {
  const std::string problem = session_->reset();
  response.success = static_cast<std::uint8_t>(problem.empty());
  response.message = problem.empty() ? "opened " + describe(session_->status().camera)
                                     : "no camera is open: " + problem;
  return true;
}

bool OpenNI2DriverNodelet::onGetSerial(GetSerial::Request& /*request*/,
                                       GetSerial::Response& response) {
  if (started()) response.serial = session_->status().camera.serial;
  return true;
}

DriverParameters OpenNI2DriverNodelet::parameters() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return parameters_;
}

void OpenNI2DriverNodelet::setParameters(const DriverParameters& parameters) {
  corrector_->set(parameters.z_offset, parameters.z_scale);
  const std::lock_guard<std::mutex> lock(mutex_);
  parameters_ = parameters;
}

}  // namespace dominant_plane_detection

PLUGINLIB_EXPORT_CLASS(dominant_plane_detection::OpenNI2DriverNodelet, nodelet::Nodelet)
