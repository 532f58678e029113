#pragma once

// Keys of a detection's values in /diagnostics that the doctor reads.
namespace dominant_plane_detection::keys {

constexpr const char* kDepthTopic = "topic of depth images";
constexpr const char* kInfoTopic = "topic of camera_info";
constexpr const char* kPointsTopic = "topic of clouds";
constexpr const char* kCause = "likeliest cause";  // "code: text", or empty
constexpr const char* kMount = "mount";
constexpr const char* kMountIsHeight = "mount, of another height";
constexpr const char* kPlanesAtTfHeight = "planes at the height by tf";
constexpr const char* kPlanesElsewhere = "planes at quite another height";
constexpr const char* kTfProblem = "tf, what is missing";
constexpr const char* kTfImages = "tf, images that want it";
constexpr const char* kTfMissing = "tf, images without it";
constexpr const char* kTfLate = "tf, images for which it is of another time";
constexpr const char* kHeight = "height by the plane [m]";
constexpr const char* kTfHeight = "height by tf [m]";

}  // namespace dominant_plane_detection::keys
