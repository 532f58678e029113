#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace freenect_double {

// A libfreenect without USB, for what fakenect does not have: several Kinects with serial numbers,
// plugging and unplugging, transfers that fail, infrared, registration, and exposure. A Kinect's
// images are simple: raw disparity is the same in every pixel, the infrared image has each row's
// number, the colour image its Kinect's colour.

/// In [mm]: raw value plus this, by the table that the device itself has.
constexpr int kTableOffset = 1000;
/// [px] A registered pixel is seen so far to the right, wherever it is.
constexpr int kRegistrationShift = 7;

struct Kinect {
  std::uint16_t raw = 700;         ///< [-] of all pixels but the first column, which has no reading
  std::uint8_t colour = 100;       ///< of all bytes
  bool may_open = true;            ///< this user may
  bool has_motor = true;           ///< and an accelerometer
  bool starts = true;              ///< streams can be started
  bool sends_video = true;         ///< colour and infrared images come
  bool transfers_work = true;      ///< otherwise the camera is given up as soon as it streams
  int longest_exposure = 1000000;  ///< [us] that it takes
  double acceleration[3] = {0.0, 9.80665, 0.0};  ///< [m/s^2] in the Kinect's own axes
};

void plug(const std::string& serial, const Kinect& kinect = {});
void unplug(const std::string& serial);
/// Changes one that is plugged in.
void change(const std::string& serial, const Kinect& kinect);
/// @return what was set with freenect_set_flag, by flag.
std::map<int, bool> flags(const std::string& serial);
/// @return [us] what freenect_set_exposure has set since the video stream was started or automatic
/// exposure was turned on; 0: nothing.
int exposure(const std::string& serial);
/// What was set of its motor and its light; kept when it is opened again.
struct Motor {
  double degrees = 0.0;
  bool moves = false;  ///< it has no angle meanwhile
  int led = -1;        ///< -1: never set
};
Motor motor(const std::string& serial);
void setMotor(const std::string& serial, const Motor& motor);
/// @return [#] of devices that are open, and of times that one was opened.
int open();
int opened();

}  // namespace freenect_double
