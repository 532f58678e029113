#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace dominant_plane_detection {

/// What can be wrong. The names are stable: scripts may look for them.
enum class Code : std::uint8_t {
  kNoClock = 0,     ///< use_sim_time without a clock
  kNoImages,        ///< nobody publishes, or a recording has no depth
  kTopicsSwapped,   ///< an image where a cloud is expected, or the reverse
  kEncoding,        ///< images that are no depth
  kNoCameraInfo,    ///< images without one
  kUncalibrated,    ///< camera_info without focal lengths
  kCameraInfoSize,  ///< camera_info of images of another size
  kStampsApart,     ///< images and camera_info of other times
  kUnusableImages,  ///< refused for another reason
  kStampsOffClock,  ///< stamps of another clock than this computer's
  kNoTf,            ///< base_frame is set, and tf does not have it
  kTfDisagrees,     ///< the plane is not where tf has the ground
  kDepthScale,      ///< readings in another unit
  kUpsideDown,      ///< the ground is where the ceiling is expected
  kRangeMax,        ///< the ground is beyond it
  kMirrored,        ///< left and right are exchanged
};

/// The one table of codes, in the order of `Code`.
constexpr std::array<const char*, 16> kCodeNames{
    "no-clock",     "no-images",        "topics-swapped", "encoding",        "no-camera-info",
    "uncalibrated", "camera-info-size", "stamps-apart",   "unusable-images", "stamps-off-clock",
    "no-tf",        "tf-disagrees",     "depth-scale",    "upside-down",     "range-max",
    "mirrored"};

/// @return the name, such as "no-images".
const char* codeName(Code code);

/// Something that is wrong.
struct Finding {
  Code code;
  std::string text;  ///< what was seen, the likely cause, what to change: sentences in one line
};

/// @return "code: text"
std::string asLine(const Finding& finding);

/// @return what somebody else says over several lines, without the rules of dashes between them.
std::string inOneLine(const std::string& text);

using Findings = std::vector<Finding>;

/// @return whether one of them has the code.
bool hasCode(const Findings& findings, Code code);

}  // namespace dominant_plane_detection
