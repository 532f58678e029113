#pragma once

#include <OpenNI.h>
#include <nodelet/loader.h>
#include <ros/ros.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "openni2/runtime.h"
#include "openni2_plugin/motor.h"
#include "virtual_kinect/virtual_kinect.h"

namespace dominant_plane_detection {

/// A nodelet manager in the test's own process: what its nodelets share, the test shares.
class Manager {
 public:
  Manager() : loader_(false) {}

  /// @param name resolved, such as "/camera/driver".
  bool load(const std::string& name, const std::string& type,
            const nodelet::M_string& remappings = {}) {
    return loader_.load(name, "dominant_plane_detection/" + type, remappings, {});
  }
  bool unload(const std::string& name) { return loader_.unload(name); }

  /// A driver called NAMESPACE/driver.
  bool loadDriver(const std::string& ns, const std::string& device_id,
                  const std::map<std::string, std::string>& parameters = {}) {
    const ros::NodeHandle node(ns + "/driver");
    ros::param::del(node.getNamespace());
    node.setParam("device_id", device_id);
    for (const auto& [name, value] : parameters) node.setParam(name, value);
    return load(node.getNamespace(), "OpenNI2Driver");
  }
  bool loadDetection(const std::string& ns) {
    return load(ns + "/plane_detection", "PlaneDetection");
  }

 private:
  nodelet::Loader loader_;
};

/// A virtual Kinect, reached beside the driver that streams it.
class Probe {
 public:
  explicit Probe(std::string uri) : uri_(std::move(uri)) {}

  /// @return the latest depth frames, oldest first; none while it is unplugged.
  std::vector<virtual_kinect::FrameRecord> records() const {
    std::vector<virtual_kinect::FrameRecord> records(256);
    int size = static_cast<int>(records.size() * sizeof(records[0]));
    with([&](openni::Device& device) {
      device.getProperty(virtual_kinect::kFrameRecords, records.data(), &size);
    });
    records.resize(static_cast<std::size_t>(size) / sizeof(records[0]));
    return records;
  }
  /// @param replug [s] after unplugging.
  void unplug(double replug) const {
    with([&](openni::Device& device) {
      double now = 0.0;
      device.invoke(virtual_kinect::kReplugAfter, &replug, sizeof(replug));
      device.invoke(virtual_kinect::kUnplug, &now, sizeof(now));
    });
  }
  void stall() const {
    with([](openni::Device& device) { device.invoke(virtual_kinect::kStall, nullptr, 0); });
  }
  /// @param sensor whose streams do not start from now on.
  void refuseStart(openni::SensorType sensor) const {
    auto number = static_cast<std::int32_t>(sensor);
    with([&](openni::Device& device) {
      device.invoke(virtual_kinect::kRefuseStart, &number, sizeof(number));
    });
  }
  /// @return what its light shows, see openni2_plugin::Led.
  std::int32_t led() const {
    std::int32_t led = -1;
    with([&](openni::Device& device) { device.getProperty(openni2_plugin::kLed, &led); });
    return led;
  }
  void drift(double rate) const {
    with([&](openni::Device& device) {
      device.invoke(virtual_kinect::kDrift, &rate, sizeof(rate));
    });
  }

 private:
  template <typename Call>
  void with(Call&& call) const {
    const auto runtime = OpenNi2Runtime::instance();
    auto device = runtime->open(uri_);
    call(*device);
    runtime->close(std::move(device));
  }

  std::string uri_;
};

/// @return the record of the frame whose pixels were written to an address.
inline std::optional<virtual_kinect::FrameRecord> recordAt(
    const std::vector<virtual_kinect::FrameRecord>& records, const void* address) {
  for (auto record = records.rbegin(); record != records.rend(); ++record) {
    if (record->address == reinterpret_cast<std::uint64_t>(address)) return *record;
  }
  return std::nullopt;
}

}  // namespace dominant_plane_detection
