#include "doctor/time_rules.h"

#include <cmath>
#include <cstdio>
#include <string>

namespace dominant_plane_detection {
namespace {

/// [s] by which images of this computer's clock may come late: a robot that acts on older ones acts
/// on what is gone, and a busy computer is not so late.
constexpr double kStale = 2.0;
/// [s] by which they may be early: clocks that are set over the network agree to a hundredth, and a
/// replay at ten times the speed delivers its clock up to a few tenths late.
constexpr double kEarly = 0.5;

std::string number(double value) {
  char text[48];
  std::snprintf(text, sizeof(text), "%.1f", value);
  return text;
}

}  // namespace

std::optional<Finding> findNoClock(const ClockFacts& clock) {
  if (!clock.use_sim_time || clock.ticks) return std::nullopt;
  return Finding{Code::kNoClock,
                 "The parameter /use_sim_time is true, but no time comes on /clock, so that time "
                 "stands still for every node. Either play the bag with rosbag play --clock (or "
                 "start the simulator), or set it back: rosparam set /use_sim_time false, and "
                 "start the nodes again."};
}

std::optional<Finding> findStampsApart(const InputFacts& input) {
  if (!input.info_offset || !input.camera) return std::nullopt;
  const bool other_frame = input.camera->frame_id != input.frame_id;
  std::string text = "No camera_info on " + input.info.name + " has the stamp of an image on " +
                     input.depth.name + ": the nearest is " +
                     number(1e3 * std::abs(*input.info_offset)) + " ms off. ";
  text += other_frame
              ? "Its frame is '" + input.camera->frame_id + "' and not '" + input.frame_id +
                    "' either, so that it is not used at all. "
              : "The latest one of the same frame and size is used instead, a second late. ";
  return Finding{Code::kStampsApart,
                 text +
                     "Image and camera_info come from two programs, or the driver stamps them "
                     "apart. Have one driver publish both with the same stamp (header.stamp)" +
                     (other_frame ? " and frame_id." : ".")};
}

std::optional<Finding> findStampsOffClock(const InputFacts& input) {
  if (!input.live || !input.age) return std::nullopt;
  const double age = *input.age;
  if (-kEarly <= age && age <= kStale) return std::nullopt;
  const std::string what = "Images of " + input.depth.name + " come " + number(std::abs(age)) +
                           " s " + (age > 0.0 ? "after" : "before") + " their stamps: ";
  const bool replay = age > 3600.0;
  return Finding{Code::kStampsOffClock,
                 what + (replay ? "they are of a recording that plays without its clock. Play it "
                                  "with rosbag play --clock, with /use_sim_time true "
                                  "(replay.launch does)."
                                : "the camera's computer has another time than this one, or "
                                  "stamps come from the camera's own clock, so that tf and gravity "
                                  "do not fit. Set the clocks by NTP or chrony, or correct the "
                                  "driver's time_offset.")};
}

}  // namespace dominant_plane_detection
