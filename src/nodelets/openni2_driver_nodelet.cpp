#include "nodelets/openni2_driver_nodelet.h"

#include <algorithm>
#include <pluginlib/class_list_macros.hpp>

#include "calibration/depth_calibration_file.h"
#include "ros/depth_correction.h"

namespace dominant_plane_detection {
namespace {

/// What is read once, at the start.
const std::set<std::string> kStartParameters = {
    "device_id",           "depth_frame_id",     "rgb_frame_id",     "depth_camera_info_url",
    "rgb_camera_info_url", "ir_camera_info_url", "depth_calibration"};

DriverNames readNames(const ros::NodeHandle& node) {
  DriverNames names;
  node.param("depth_frame_id", names.depth_frame_id, names.depth_frame_id);
  node.param("rgb_frame_id", names.rgb_frame_id, names.rgb_frame_id);
  node.param("depth_camera_info_url", names.depth_camera_info_url, names.depth_camera_info_url);
  node.param("rgb_camera_info_url", names.rgb_camera_info_url, names.rgb_camera_info_url);
  node.param("ir_camera_info_url", names.ir_camera_info_url, names.ir_camera_info_url);
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
  // Each of these waits for what it may be doing in another thread: none of the locks is held.
  reconfigure_.reset();
  serial_server_.shutdown();
  std::unique_ptr<DeviceSession> session;
  {
    const std::lock_guard<std::mutex> lock(listeners_mutex_);
    session = std::move(session_);
  }
  session.reset();  // no image is published from here on
  outputs_.shutdown();
  diagnostics_.reset();
}

void OpenNI2DriverNodelet::onInit() {
  try {
    start();
  } catch (const std::exception& error) {
    NODELET_ERROR_STREAM("Could not start: " << error.what());
  }
}

void OpenNI2DriverNodelet::start() {
  const ros::NodeHandle& node = getNodeHandle();
  ros::NodeHandle& private_node = getPrivateNodeHandle();
  calibration_ = readCalibration(private_node);
  setParameters(
      loadParameters<DriverParameters, OpenNI2DriverConfig>(private_node, kStartParameters));
  {
    // Somebody may connect before everything is in place, and has to wait until it is.
    const std::lock_guard<std::mutex> lock(listeners_mutex_);
    outputs_.advertise(node, readNames(private_node), [this] { onListenersChanged(); });
    DeviceSession::Callbacks callbacks;
    callbacks.frame = [this](StreamKind kind, const SensorFrame& frame) { onFrame(kind, frame); };
    callbacks.opened = [this](const CameraDevice& camera) { onOpened(camera); };
    callbacks.acceleration = [this](const openni2_plugin::Acceleration& acceleration) {
      onAcceleration(acceleration);
    };
    diagnostics_ = std::make_unique<DriverDiagnostics>(node, private_node, getName(), [this] {
      const std::lock_guard<std::mutex> guard(listeners_mutex_);
      return session_ ? session_->status() : SessionStatus();
    });
    session_ = std::make_unique<DeviceSession>(readDeviceId(private_node), parameters_.camera,
                                               parameters_.watchdog_timeout, std::move(callbacks));
  }
  onListenersChanged();
  serial_server_ =
      getNodeHandle().advertiseService("get_serial", &OpenNI2DriverNodelet::onGetSerial, this);
  reconfigure_ = std::make_unique<dynamic_reconfigure::Server<OpenNI2DriverConfig>>(
      reconfigure_mutex_, private_node);
  reconfigure_->setCallback(
      [this](OpenNI2DriverConfig& config, std::uint32_t) { onReconfigure(config); });
}

void OpenNI2DriverNodelet::onListenersChanged() {
  const std::lock_guard<std::mutex> lock(listeners_mutex_);
  if (!session_) return;
  for (const StreamKind kind : kAllStreams) {
    const bool wanted = outputs_.wants(kind);
    diagnostics_->setWanted(kind, wanted);
    session_->want(kind, wanted);
  }
  session_->wantAcceleration(outputs_.wantsImu());
}

void OpenNI2DriverNodelet::onFrame(StreamKind kind, const SensorFrame& frame) {
  try {
    const ros::Time arrival = ros::Time::now();
    const DriverParameters now = parameters();
    const double seconds =
        clocks_[static_cast<int>(kind)].stamp(frame.device_time, arrival.toSec()) + now.time_offset;
    const ros::Time stamp(std::max(seconds, 0.0));
    if (kind == StreamKind::kDepth) toDepth(frame, stamp);
    diagnostics_->count(kind, frame);
    outputs_.publish(kind, frame, stamp);
  } catch (const std::exception& error) {
    NODELET_ERROR_STREAM_THROTTLE(5.0, "Dropped an image: " << error.what());
  }
}

void OpenNI2DriverNodelet::toDepth(const SensorFrame& frame, const ros::Time& stamp) {
  if (!frame.raw) {
    const DriverParameters now = parameters();
    correctDepth(now.z_offset, now.z_scale, *frame.image);
    return;
  }
  if (outputs_.wantsRawDisparity()) outputs_.publishRawDisparity(*frame.image, stamp);
  std::shared_ptr<const DisparityTable> table;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    table = disparity_table_;
  }
  toMillimetres(*table, *frame.image);
}

void OpenNI2DriverNodelet::onAcceleration(const openni2_plugin::Acceleration& acceleration) {
  try {
    outputs_.publish(acceleration, ros::Time::now());
  } catch (const std::exception& error) {
    NODELET_ERROR_STREAM_THROTTLE(5.0, "Dropped a reading: " << error.what());
  }
}

void OpenNI2DriverNodelet::onOpened(const CameraDevice& camera) {
  outputs_.setCamera(camera);
  diagnostics_->beginNumbers();
}

void OpenNI2DriverNodelet::onReconfigure(OpenNI2DriverConfig& config) {
  const DriverParameters old = parameters();
  std::string error;
  try {
    const auto wanted = fromConfig<DriverParameters>(config);
    error = joined(findErrors(wanted));
    // The camera may take its time to answer, and this is called from onInit as well.
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

bool OpenNI2DriverNodelet::onGetSerial(GetSerial::Request& /*request*/,
                                       GetSerial::Response& response) {
  const std::lock_guard<std::mutex> lock(listeners_mutex_);
  if (session_) response.serial = session_->status().camera.serial;
  return true;
}

DriverParameters OpenNI2DriverNodelet::parameters() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return parameters_;
}

void OpenNI2DriverNodelet::setParameters(const DriverParameters& parameters) {
  const auto table =
      std::make_shared<const DisparityTable>(calibration_, parameters.z_offset, parameters.z_scale);
  const std::lock_guard<std::mutex> lock(mutex_);
  parameters_ = parameters;
  disparity_table_ = table;
}

}  // namespace dominant_plane_detection

PLUGINLIB_EXPORT_CLASS(dominant_plane_detection::OpenNI2DriverNodelet, nodelet::Nodelet)
