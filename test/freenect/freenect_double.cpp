#include "freenect/freenect_double.h"

#include <libfreenect.h>
#include <libfreenect_registration.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

using freenect_double::Kinect;
using Steady = std::chrono::steady_clock;

namespace {

constexpr int kWidth = 640, kHeight = 480;
constexpr int kRaw = 2048, kFarthest = 10000;
constexpr std::chrono::milliseconds kPeriod{33};

struct Plugged {
  Kinect kinect;
  std::map<int, bool> flags;
  int exposure = 0;
  freenect_double::Motor motor;
};

std::mutex mutex;  // of what follows
std::map<std::string, Plugged> plugged;
int open_devices = 0;
int times_opened = 0;

freenect_frame_mode makeMode(int format, freenect_resolution resolution, int width, int height,
                             int bytes_per_pixel, int rate) {
  freenect_frame_mode mode{};
  mode.resolution = resolution;
  mode.dummy = format;
  mode.width = static_cast<std::int16_t>(width);
  mode.height = static_cast<std::int16_t>(height);
  mode.bytes = width * height * bytes_per_pixel;
  mode.framerate = static_cast<std::int8_t>(rate);
  mode.is_valid = 1;
  return mode;
}

const std::vector<freenect_frame_mode>& videoModes() {
  static const std::vector<freenect_frame_mode> modes = {
      makeMode(FREENECT_VIDEO_RGB, FREENECT_RESOLUTION_HIGH, 1280, 1024, 3, 10),
      makeMode(FREENECT_VIDEO_RGB, FREENECT_RESOLUTION_MEDIUM, kWidth, kHeight, 3, 30),
      makeMode(FREENECT_VIDEO_IR_10BIT, FREENECT_RESOLUTION_MEDIUM, kWidth, 488, 2, 30)};
  return modes;
}

}  // namespace

struct _freenect_device {
  std::string serial;
  void* user = nullptr;
  freenect_depth_cb depth_callback = nullptr;
  freenect_video_cb video_callback = nullptr;
  void* depth_buffer = nullptr;
  void* video_buffer = nullptr;
  freenect_frame_mode video_mode{};
  bool depth_runs = false, video_runs = false;
  freenect_raw_tilt_state tilt{};
  Steady::time_point next = Steady::now();
  std::uint32_t ticks = 4294000000U;  // begins again at 0 soon
};

struct _freenect_context {
  int subdevices = FREENECT_DEVICE_MOTOR | FREENECT_DEVICE_CAMERA;
  std::unique_ptr<_freenect_device> device;
};

namespace freenect_double {

void plug(const std::string& serial, const Kinect& kinect) {
  const std::lock_guard<std::mutex> lock(mutex);
  plugged[serial] = Plugged{kinect, {}, 0, {}};
}

void unplug(const std::string& serial) {
  const std::lock_guard<std::mutex> lock(mutex);
  plugged.erase(serial);
}

void change(const std::string& serial, const Kinect& kinect) {
  const std::lock_guard<std::mutex> lock(mutex);
  plugged.at(serial).kinect = kinect;
}

std::map<int, bool> flags(const std::string& serial) {
  const std::lock_guard<std::mutex> lock(mutex);
  return plugged.at(serial).flags;
}

int exposure(const std::string& serial) {
  const std::lock_guard<std::mutex> lock(mutex);
  return plugged.at(serial).exposure;
}

Motor motor(const std::string& serial) {
  const std::lock_guard<std::mutex> lock(mutex);
  return plugged.at(serial).motor;
}

void setMotor(const std::string& serial, const Motor& motor) {
  const std::lock_guard<std::mutex> lock(mutex);
  plugged.at(serial).motor = motor;
}

int open() {
  const std::lock_guard<std::mutex> lock(mutex);
  return open_devices;
}

int opened() {
  const std::lock_guard<std::mutex> lock(mutex);
  return times_opened;
}

}  // namespace freenect_double

namespace {

/// @return nothing when it is not plugged in.
std::unique_ptr<Kinect> find(const std::string& serial) {
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = plugged.find(serial);
  return found == plugged.end() ? nullptr : std::make_unique<Kinect>(found->second.kinect);
}

void sendDepth(_freenect_device& device, const Kinect& kinect) {
  auto* const pixels = static_cast<std::uint16_t*>(device.depth_buffer);
  std::fill_n(pixels, kWidth * kHeight, kinect.raw);
  for (int v = 0; v < kHeight; ++v) pixels[v * kWidth] = FREENECT_DEPTH_RAW_NO_VALUE;
  device.depth_callback(&device, pixels, device.ticks);
}

void sendVideo(_freenect_device& device, const Kinect& kinect) {
  if (device.video_mode.video_format == FREENECT_VIDEO_RGB) {
    std::memset(device.video_buffer, kinect.colour,
                static_cast<std::size_t>(device.video_mode.bytes));
  } else {
    auto* const pixels = static_cast<std::uint16_t*>(device.video_buffer);
    for (int v = 0; v < device.video_mode.height; ++v) {
      std::fill_n(pixels + v * kWidth, kWidth, static_cast<std::uint16_t>(v));
    }
  }
  device.video_callback(&device, device.video_buffer, device.ticks);
}

}  // namespace

extern "C" {

int freenect_init(freenect_context** context, freenect_usb_context*) {
  *context = new _freenect_context;
  return 0;
}
int freenect_shutdown(freenect_context* context) {
  delete context;
  return 0;
}
void freenect_set_log_level(freenect_context*, freenect_loglevel) {}
void freenect_select_subdevices(freenect_context* context, freenect_device_flags subdevices) {
  context->subdevices = subdevices;
}
freenect_device_flags freenect_enabled_subdevices(freenect_context* context) {
  return static_cast<freenect_device_flags>(context->subdevices);
}

int freenect_num_devices(freenect_context*) {
  const std::lock_guard<std::mutex> lock(mutex);
  return static_cast<int>(plugged.size());
}
int freenect_list_device_attributes(freenect_context*, freenect_device_attributes** list) {
  const std::lock_guard<std::mutex> lock(mutex);
  *list = nullptr;
  for (auto one = plugged.rbegin(); one != plugged.rend(); ++one) {
    *list = new freenect_device_attributes{*list, strdup(one->first.c_str())};
  }
  return static_cast<int>(plugged.size());
}
void freenect_free_device_attributes(freenect_device_attributes* list) {
  while (list != nullptr) {
    freenect_device_attributes* const next = list->next;
    free(const_cast<char*>(list->camera_serial));
    delete list;
    list = next;
  }
}

int freenect_open_device_by_camera_serial(freenect_context* context, freenect_device** device,
                                          const char* serial) {
  const auto kinect = find(serial);
  const bool wants_motor = (context->subdevices & FREENECT_DEVICE_MOTOR) != 0;
  if (!kinect || !kinect->may_open || (wants_motor && !kinect->has_motor)) return -1;
  context->device = std::make_unique<_freenect_device>();
  context->device->serial = serial;
  *device = context->device.get();
  const std::lock_guard<std::mutex> lock(mutex);
  ++open_devices;
  ++times_opened;
  return 0;
}
int freenect_open_device(freenect_context*, freenect_device**, int) { return -1; }
int freenect_close_device(freenect_device*) {
  const std::lock_guard<std::mutex> lock(mutex);
  --open_devices;
  return 0;
}

void freenect_set_user(freenect_device* device, void* user) { device->user = user; }
void* freenect_get_user(freenect_device* device) { return device->user; }
void freenect_set_depth_callback(freenect_device* device, freenect_depth_cb callback) {
  device->depth_callback = callback;
}
void freenect_set_video_callback(freenect_device* device, freenect_video_cb callback) {
  device->video_callback = callback;
}
int freenect_set_depth_buffer(freenect_device* device, void* buffer) {
  device->depth_buffer = buffer;
  return 0;
}
int freenect_set_video_buffer(freenect_device* device, void* buffer) {
  device->video_buffer = buffer;
  return 0;
}
int freenect_start_depth(freenect_device* device) {
  const auto kinect = find(device->serial);
  if (!kinect || !kinect->starts) return -1;
  device->depth_runs = true;
  return 0;
}
int freenect_start_video(freenect_device* device) {
  device->video_runs = true;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = plugged.find(device->serial);
  if (found != plugged.end()) found->second.exposure = 0;  // it forgets
  return 0;
}
int freenect_stop_depth(freenect_device* device) {
  device->depth_runs = false;
  return 0;
}
int freenect_stop_video(freenect_device* device) {
  device->video_runs = false;
  return 0;
}

int freenect_process_events_timeout(freenect_context* context, timeval* timeout) {
  _freenect_device& device = *context->device;
  const auto wait = std::chrono::microseconds(timeout->tv_usec);
  std::this_thread::sleep_until(std::min(device.next, Steady::now() + wait));
  const auto kinect = find(device.serial);
  if (!kinect || !kinect->transfers_work) return -1;
  if (Steady::now() < device.next) return 0;
  device.next = std::max(device.next + kPeriod, Steady::now());
  device.ticks += 60U * 33000U;
  if (device.depth_runs) sendDepth(device, *kinect);
  if (device.video_runs && kinect->sends_video) sendVideo(device, *kinect);
  return 0;
}

int freenect_update_tilt_state(freenect_device* device) {
  const auto kinect = find(device->serial);
  if (!kinect) return -1;
  const auto counts = [&](int axis) {
    return static_cast<std::int16_t>(
        std::lround(kinect->acceleration[axis] / 9.80665 * FREENECT_COUNTS_PER_G));
  };
  device->tilt.accelerometer_x = counts(0);
  device->tilt.accelerometer_y = counts(1);
  device->tilt.accelerometer_z = counts(2);
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = plugged.find(device->serial);
  if (found == plugged.end()) return -1;
  const freenect_double::Motor& motor = found->second.motor;
  device->tilt.tilt_angle =
      motor.moves ? std::int8_t{-128} : static_cast<std::int8_t>(std::lround(2.0 * motor.degrees));
  return 0;
}
freenect_raw_tilt_state* freenect_get_tilt_state(freenect_device* device) { return &device->tilt; }
void freenect_get_mks_accel(freenect_raw_tilt_state* state, double* x, double* y, double* z) {
  *x = state->accelerometer_x * 9.80665 / FREENECT_COUNTS_PER_G;
  *y = state->accelerometer_y * 9.80665 / FREENECT_COUNTS_PER_G;
  *z = state->accelerometer_z * 9.80665 / FREENECT_COUNTS_PER_G;
}

double freenect_get_tilt_degs(freenect_raw_tilt_state* state) { return 0.5 * state->tilt_angle; }
int freenect_set_tilt_degs(freenect_device* device, double angle) {
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = plugged.find(device->serial);
  if (found == plugged.end()) return -1;
  found->second.motor.degrees = angle;
  return 0;
}
int freenect_set_led(freenect_device* device, freenect_led_options option) {
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = plugged.find(device->serial);
  if (found == plugged.end()) return -1;
  found->second.motor.led = option;
  return 0;
}

int freenect_get_depth_mode_count() { return 1; }
freenect_frame_mode freenect_get_depth_mode(int) {
  return makeMode(FREENECT_DEPTH_11BIT, FREENECT_RESOLUTION_MEDIUM, kWidth, kHeight, 2, 30);
}
int freenect_set_depth_mode(freenect_device*, const freenect_frame_mode) { return 0; }
int freenect_get_video_mode_count() { return static_cast<int>(videoModes().size()); }
freenect_frame_mode freenect_get_video_mode(int i) {
  return videoModes().at(static_cast<std::size_t>(i));
}
int freenect_set_video_mode(freenect_device* device, freenect_frame_mode mode) {
  device->video_mode = mode;
  return 0;
}

int freenect_set_flag(freenect_device* device, freenect_flag flag, freenect_flag_value value) {
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = plugged.find(device->serial);
  if (found == plugged.end()) return -1;
  found->second.flags[flag] = value == FREENECT_ON;
  if (flag == FREENECT_AUTO_EXPOSURE && value == FREENECT_ON) found->second.exposure = 0;
  return 0;
}

// Of later versions than the header is.
__attribute__((visibility("default"))) int freenect_set_exposure(freenect_device* device,
                                                                 int time) {
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = plugged.find(device->serial);
  if (found == plugged.end() || time > found->second.kinect.longest_exposure) return -1;
  found->second.exposure = time;
  return 0;
}

freenect_registration freenect_copy_registration(freenect_device*) {
  freenect_registration registration{};
  registration.raw_to_mm_shift = new std::uint16_t[kRaw];
  for (int raw = 0; raw < kRaw; ++raw) {
    registration.raw_to_mm_shift[raw] =
        raw == FREENECT_DEPTH_RAW_NO_VALUE
            ? std::uint16_t{0}
            : static_cast<std::uint16_t>(raw + freenect_double::kTableOffset);
  }
  registration.depth_to_rgb_shift = new std::int32_t[kFarthest];
  std::fill_n(registration.depth_to_rgb_shift, kFarthest,
              256 * freenect_double::kRegistrationShift);
  registration.registration_table = new std::int32_t[kWidth * kHeight][2];
  for (int i = 0; i < kWidth * kHeight; ++i) {
    registration.registration_table[i][0] = 256 * (i % kWidth);
    registration.registration_table[i][1] = i / kWidth;
  }
  return registration;
}
int freenect_destroy_registration(freenect_registration* registration) {
  delete[] registration->raw_to_mm_shift;
  delete[] registration->depth_to_rgb_shift;
  delete[] registration->registration_table;
  return 0;
}

}  // extern "C"
