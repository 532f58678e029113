#pragma once

#include <dominant_plane_detection/GetSerial.h>
#include <dominant_plane_detection/OpenNI2DriverConfig.h>
#include <dynamic_reconfigure/server.h>
#include <nodelet/nodelet.h>

#include <boost/thread/recursive_mutex.hpp>
#include <memory>
#include <mutex>

#include "core/disparity_table.h"
#include "openni2/clock_filter.h"
#include "openni2/device_session.h"
#include "ros/driver_diagnostics.h"
#include "ros/driver_outputs.h"
#include "ros/driver_parameters.h"

namespace dominant_plane_detection {

/// An OpenNI2 camera as a nodelet: depth, colour and infrared images in the memory that the
/// camera's driver wrote; streams run while somebody listens.
class OpenNI2DriverNodelet : public nodelet::Nodelet {
 public:
  ~OpenNI2DriverNodelet() override;

 private:
  void onInit() override;
  void start();
  void onListenersChanged();
  /// In a thread of the camera's, one frame after the other.
  void onFrame(StreamKind kind, const SensorFrame& frame);
  /// In the session's thread.
  void onOpened(const CameraDevice& camera);
  void onReconfigure(OpenNI2DriverConfig& config);
  /// In the session's thread.
  void onAcceleration(const openni2_plugin::Acceleration& acceleration);
  void toDepth(const SensorFrame& frame, const ros::Time& stamp);
  bool onGetSerial(GetSerial::Request& request, GetSerial::Response& response);
  DriverParameters parameters() const;
  void setParameters(const DriverParameters& parameters);

  mutable std::mutex mutex_;  ///< of what follows
  DriverParameters parameters_;
  std::shared_ptr<const DisparityTable> disparity_table_;

  DepthCalibration calibration_;
  ClockFilter clocks_[kStreamKinds];  ///< of the camera's thread alone
  DriverOutputs outputs_;
  std::unique_ptr<DriverDiagnostics> diagnostics_;
  std::mutex listeners_mutex_;  ///< of `session_` while listeners come and go
  std::unique_ptr<DeviceSession> session_;
  ros::ServiceServer serial_server_;
  boost::recursive_mutex reconfigure_mutex_;
  std::unique_ptr<dynamic_reconfigure::Server<OpenNI2DriverConfig>> reconfigure_;
};

}  // namespace dominant_plane_detection
