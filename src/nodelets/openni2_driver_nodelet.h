#pragma once

#include <dominant_plane_detection/GetSerial.h>
#include <dominant_plane_detection/OpenNI2DriverConfig.h>
#include <dynamic_reconfigure/server.h>
#include <ros/callback_queue.h>
#include <ros/spinner.h>
#include <std_srvs/Trigger.h>

#include <memory>
#include <mutex>

#include "nodelets/periodic_nodelet.h"
#include "openni2/clock_filter.h"
#include "openni2/device_session.h"
#include "ros/depth_corrector.h"
#include "ros/driver_diagnostics.h"
#include "ros/driver_outputs.h"
#include "ros/driver_parameters.h"
#include "ros/motor_topics.h"

namespace dominant_plane_detection {

/// An OpenNI2 camera as a nodelet: depth, colour and infrared images in the memory that the
/// camera's driver wrote; streams run while somebody listens.
///
/// Which thread calls what: the nodelet's own callback queue the timer, listeners that come and go,
/// orders to the motor, and get_serial, one after the other; a thread of each stream `onFrame`; the
/// session's thread `onOpened`, `onAcceleration` and `onTiltAngle`; a thread for what waits for the
/// camera `onReconfigure` and `onReset`.
class OpenNI2DriverNodelet : public PeriodicNodelet {
 public:
  ~OpenNI2DriverNodelet() override;

 private:
  void start() override;
  void onTimer() override;
  void offerMotor();
  void offerParameters();
  void followListeners();
  void onFrame(StreamKind kind, const SensorFrame& frame);
  void onOpened(const CameraDevice& camera);
  void onReconfigure(OpenNI2DriverConfig& config);
  void onAcceleration(const openni2_plugin::Acceleration& acceleration);
  void onTiltAngle(double angle);
  ros::Time stampOf(StreamKind kind, const SensorFrame& frame);
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool onGetSerial(GetSerial::Request& request, GetSerial::Response& response);
  DriverParameters parameters() const;
  void setParameters(const DriverParameters& parameters);

  mutable std::mutex mutex_;  ///< of what follows; never held while anything else is called
  DriverParameters parameters_;
  ClockFilter clock_;

  std::unique_ptr<DepthCorrector> corrector_;
  DriverOutputs outputs_;
  std::unique_ptr<DriverDiagnostics> diagnostics_;
  std::unique_ptr<DeviceSession> session_;
  MotorTopics motor_;  ///< gives the session orders: goes before it
  ros::ServiceServer serial_server_;
  ros::CallbackQueue waiting_queue_;
  ros::ServiceServer reset_server_;
  std::unique_ptr<dynamic_reconfigure::Server<OpenNI2DriverConfig>> reconfigure_;
  std::unique_ptr<ros::AsyncSpinner> waiting_spinner_;
};

}  // namespace dominant_plane_detection
