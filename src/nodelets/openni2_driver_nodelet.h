#pragma once

#include <dominant_plane_detection/GetSerial.h>
#include <dominant_plane_detection/OpenNI2DriverConfig.h>
#include <dynamic_reconfigure/server.h>
#include <nodelet/nodelet.h>
#include <ros/callback_queue.h>
#include <ros/spinner.h>

#include <atomic>
#include <memory>
#include <mutex>

#include "nodelets/name_claim.h"
#include "openni2/clock_filter.h"
#include "openni2/device_session.h"
#include "ros/depth_corrector.h"
#include "ros/driver_diagnostics.h"
#include "ros/driver_outputs.h"
#include "ros/driver_parameters.h"

namespace dominant_plane_detection {

/// An OpenNI2 camera as a nodelet: depth, colour and infrared images in the memory that the
/// camera's driver wrote; streams run while somebody listens.
///
/// Which thread calls what: the nodelet's own callback queue the timer, listeners that come and go,
/// and get_serial, one after the other; a thread of each stream `onFrame`; the session's thread
/// `onOpened` and `onAcceleration`; a thread for parameters `onReconfigure`, which waits for the
/// camera. The manager's threads call `onInit`, one nodelet after the other, as loading transports
/// wants it, while callbacks already come and find that nothing has started; and the destructor,
/// after the queue's last callback.
class OpenNI2DriverNodelet : public nodelet::Nodelet {
 public:
  ~OpenNI2DriverNodelet() override;

 private:
  void onInit() override;
  void onTimer();
  void start();
  void offerParameters();
  void followListeners();
  void onFrame(StreamKind kind, const SensorFrame& frame);
  void onOpened(const CameraDevice& camera);
  void onReconfigure(OpenNI2DriverConfig& config);
  void onAcceleration(const openni2_plugin::Acceleration& acceleration);
  ros::Time stampOf(StreamKind kind, const SensorFrame& frame);
  bool onGetSerial(GetSerial::Request& request, GetSerial::Response& response);
  DriverParameters parameters() const;
  void setParameters(const DriverParameters& parameters);

  std::unique_ptr<NameClaim> name_;   ///< first, so that it is let go of last
  std::atomic<bool> started_{false};  ///< what follows is complete

  mutable std::mutex mutex_;  ///< of what follows; never held while anything else is called
  DriverParameters parameters_;
  ClockFilter clock_;

  std::unique_ptr<DepthCorrector> corrector_;
  DriverOutputs outputs_;
  std::unique_ptr<DriverDiagnostics> diagnostics_;
  std::unique_ptr<DeviceSession> session_;
  ros::ServiceServer serial_server_;
  ros::CallbackQueue reconfigure_queue_;
  std::unique_ptr<dynamic_reconfigure::Server<OpenNI2DriverConfig>> reconfigure_;
  std::unique_ptr<ros::AsyncSpinner> reconfigure_spinner_;
  ros::WallTimer timer_;
};

}  // namespace dominant_plane_detection
