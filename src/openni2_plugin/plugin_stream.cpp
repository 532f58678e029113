#include "openni2_plugin/plugin_stream.h"

#include <cmath>

#include "openni2_plugin/property.h"

namespace dominant_plane_detection::openni2_plugin {
namespace {

constexpr int kMaxDepth = 10000;  // [mm]

bool sameMode(const OniVideoMode& a, const OniVideoMode& b) {
  return a.pixelFormat == b.pixelFormat && a.resolutionX == b.resolutionX &&
         a.resolutionY == b.resolutionY && a.fps == b.fps;
}

}  // namespace

PluginStream::PluginStream(OniSensorType sensor, const std::vector<OniVideoMode>& modes)
    : sensor_(sensor), modes_(modes), mode_(modes.front()) {}

OniStatus PluginStream::getProperty(int id, void* data, int* size) {
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return giveProperty(mode_, data, size);
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
      return giveProperty(fieldOfView(false), data, size);
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return giveProperty(fieldOfView(true), data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return giveProperty(sensor_ == ONI_SENSOR_DEPTH ? kMaxDepth : 0, data, size);
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return giveProperty(0, data, size);
    case ONI_STREAM_PROPERTY_STRIDE:
      return giveProperty(stride(), data, size);
    case ONI_STREAM_PROPERTY_CROPPING:
      // OpenNI2's player shows no frame of a recording that does not say how it is cropped.
      return giveProperty(OniCropping{}, data, size);
    case ONI_STREAM_PROPERTY_MIRRORING:
      return giveProperty(OniBool{FALSE}, data, size);
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      return giveProperty(auto_exposure_.load(), data, size);
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return giveProperty(auto_white_balance_.load(), data, size);
    case ONI_STREAM_PROPERTY_EXPOSURE:
      return hasSetting(id) ? giveProperty(exposure(), data, size) : ONI_STATUS_NOT_SUPPORTED;
    case ONI_STREAM_PROPERTY_GAIN:
      return hasSetting(id) ? giveProperty(gain(), data, size) : ONI_STATUS_NOT_SUPPORTED;
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniStatus PluginStream::setProperty(int id, const void* data, int size) {
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return setMode(data, size);
    case ONI_STREAM_PROPERTY_MIRRORING: {
      OniBool mirrored = FALSE;
      const OniStatus status = takeProperty(mirrored, data, size);
      return status == ONI_STATUS_OK && mirrored != FALSE ? ONI_STATUS_NOT_SUPPORTED : status;
    }
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      return setSetting(auto_exposure_, id, data, size);
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return setSetting(auto_white_balance_, id, data, size);
    case ONI_STREAM_PROPERTY_EXPOSURE:
      return setSetting(exposure_, id, data, size);
    case ONI_STREAM_PROPERTY_GAIN:
      return setSetting(gain_, id, data, size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniStatus PluginStream::setMode(const void* data, int size) {
  OniVideoMode wanted{};
  const OniStatus status = takeProperty(wanted, data, size);
  if (status != ONI_STATUS_OK) return status;
  if (running()) return ONI_STATUS_OUT_OF_FLOW;
  for (const OniVideoMode& mode : modes_) {
    if (!sameMode(mode, wanted)) continue;
    mode_ = mode;
    return ONI_STATUS_OK;
  }
  return ONI_STATUS_NOT_SUPPORTED;
}

OniStatus PluginStream::setSetting(std::atomic<int>& setting, int id, const void* data, int size) {
  if (!hasSetting(id)) return ONI_STATUS_NOT_SUPPORTED;
  int value = 0;
  const OniStatus status = takeProperty(value, data, size);
  if (status != ONI_STATUS_OK) return status;
  const int old = setting.exchange(value);
  if (onSetting(id)) return ONI_STATUS_OK;
  setting = old;
  return ONI_STATUS_ERROR;
}

void PluginStream::forgetExposure() {
  exposure_ = 0;
  gain_ = kUnitGain;
}

bool PluginStream::hasSetting(int id) const {
  if (sensor_ != ONI_SENSOR_COLOR) return false;
  if (id == ONI_STREAM_PROPERTY_EXPOSURE) return hasExposure();
  if (id == ONI_STREAM_PROPERTY_GAIN) return hasGain();
  return id == ONI_STREAM_PROPERTY_AUTO_EXPOSURE || id == ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE;
}

OniBool PluginStream::isPropertySupported(int id) {
  return hasSetting(id) ||
         (id >= ONI_STREAM_PROPERTY_CROPPING && id <= ONI_STREAM_PROPERTY_MIRRORING);
}

void PluginStream::describe(int index, std::uint64_t timestamp, OniFrame& frame) const {
  frame.sensorType = sensor_;
  frame.timestamp = timestamp;
  frame.frameIndex = index;
  frame.videoMode = mode_;
  frame.width = mode_.resolutionX;
  frame.height = mode_.resolutionY;
  frame.stride = stride();
  frame.dataSize = frame.stride * mode_.resolutionY;
  frame.croppingEnabled = FALSE;
  frame.cropOriginX = frame.cropOriginY = 0;
}

int PluginStream::stride() const {
  return (mode_.pixelFormat == ONI_PIXEL_FORMAT_RGB888 ? 3 : 2) * mode_.resolutionX;
}

float PluginStream::fieldOfView(bool vertical) const {
  const int size = vertical ? mode_.resolutionY : mode_.resolutionX;
  return static_cast<float>(2.0 * std::atan(0.5 * size / focalLength(vertical)));
}

}  // namespace dominant_plane_detection::openni2_plugin
