#include "doctor/input_rules.h"

#include <cstdio>

#include "doctor/time_rules.h"
#include "doctor/topic_advice.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kImageType = "sensor_msgs/Image";
constexpr const char* kCloudType = "sensor_msgs/PointCloud2";

/// @return a length with one digit.
std::string pixels(double length) {
  char text[48];
  std::snprintf(text, sizeof(text), "%.1f", length);
  return text;
}

std::string size(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

bool calibrated(const CameraInfoFacts& camera) { return camera.fx > 0.0 && camera.fy > 0.0; }

bool sameSize(const InputFacts& input) {
  return input.camera->width == input.width && input.camera->height == input.height;
}

}  // namespace

std::optional<Finding> findNotSubscribed(const InputFacts& input) {
  if (input.subscription_error.empty()) return std::nullopt;
  return Finding{Code::kUnusableImages, "Images of " + input.depth.name +
                                            " cannot be subscribed: " + input.subscription_error +
                                            ". Correct the parameter image_transport, or install "
                                            "the transport that it names."};
}

std::optional<Finding> findSwappedTopics(const InputFacts& input) {
  const TopicFacts& depth = input.depth;
  if (depth.type.empty() || depth.type == depth.expected_type) return std::nullopt;
  std::string text = depth.name + " has messages of type " + depth.type + ", but " +
                     depth.expected_type + " is expected: ";
  if (!input.from_points && depth.type == kCloudType) {
    text += "it is a cloud. Set the parameter input to points and remap points:=" + depth.name +
            ", or take a depth image.";
  } else if (input.from_points && depth.type == kImageType) {
    text +=
        "it is an image, and the parameter input is points. Set input to depth and remap "
        "depth/image_raw:=" +
        depth.name + ", or take a cloud.";
  } else {
    text += "take another topic (one that an image_transport packs is named without what it adds).";
  }
  return Finding{Code::kTopicsSwapped, text + chooseAnother(input) + unpackFirst(depth)};
}

std::optional<Finding> findNoImages(const InputFacts& input) {
  const TopicFacts& depth = input.depth;
  if (depth.messages > 0 || findSwappedTopics(input)) return std::nullopt;
  const std::string what = input.from_points ? "cloud" : "depth image";
  if (!input.live) {
    return Finding{Code::kNoImages,
                   "There is no " + what + " topic" + (depth.name.empty() ? "" : " " + depth.name) +
                       " of type " + depth.expected_type + " in the recording. Topics in it: " +
                       listed(depth.others) + ". Record the camera's depth image and its " +
                       "camera_info (record.launch does)" +
                       (input.from_points ? "." : ", or, for clouds, give --set input=points.") +
                       unpackFirst(depth)};
  }
  if (!depth.known) {
    return Finding{Code::kNoImages, "Nothing comes on " + depth.name +
                                        ", and the ROS master does not answer: nobody knows who "
                                        "publishes it. Start the system again, the master first."};
  }
  if (depth.type.empty()) {
    return Finding{Code::kNoImages, "Nothing comes on " + depth.name +
                                        ", which nobody publishes: the camera's driver does not "
                                        "run, or has another name. Topics of this type: " +
                                        listed(depth.others) + "." +
                                        (depth.others.empty() ? " Start the driver (camera.launch)."
                                                              : " Start the driver, or remap " +
                                                                    remapTo(input) + ".")};
  }
  return Finding{Code::kNoImages,
                 "Nothing comes on " + depth.name +
                     ", although it is published: the camera is not plugged in, does not stream, "
                     "or its bag has ended or is paused; its driver's line in /diagnostics says "
                     "more. Topics of this type: " +
                     listed(depth.others) + "."};
}

std::optional<Finding> findWrongEncoding(const InputFacts& input) {
  if (input.encoding_is_depth) return std::nullopt;
  return Finding{Code::kEncoding,
                 "Images of " + input.depth.name + " cannot be used: " + input.refusal +
                     ". It is no depth in millimetres or metres, but a picture, a disparity, or "
                     "depth as some viewer wants it. Give the depth image itself, such as "
                     "depth/image_raw of the camera." +
                     chooseAnother(input)};
}

std::optional<Finding> findNoCameraInfo(const InputFacts& input) {
  const TopicFacts& info = input.info;
  if (input.depth.messages == 0 || info.name.empty() || info.messages > 0) return std::nullopt;
  std::string text =
      "Images come on " + input.depth.name + ", but no camera_info for them on " + info.name +
      (info.known && info.type.empty() ? ", which nobody publishes" : "") +
      ": without it nobody knows where a pixel looks. Topics of this type: " + listed(info.others) +
      ". ";
  if (!input.live) {
    text += "Record it beside the image, or give --camera FX,FY,CX,CY.";
  } else {
    text += "Have the driver publish it beside the image, or remap " + info.name +
            ":=" + (info.others.empty() ? "TOPIC" : likeliestDepth(info.others)) + ".";
  }
  return Finding{Code::kNoCameraInfo, text};
}

std::optional<Finding> findUncalibrated(const InputFacts& input) {
  if (!input.camera || calibrated(*input.camera)) return std::nullopt;
  const CameraInfoFacts& camera = *input.camera;
  return Finding{Code::kUncalibrated,
                 "The camera_info on " + input.info.name + " has the focal lengths " +
                     pixels(camera.fx) + " and " + pixels(camera.fy) + " in " + camera.matrix +
                     ": the driver has no calibration. Expected a calibrated "
                     "camera_info. Give the driver one (depth_camera_info_url of camera.launch), " +
                     (camera.matrix[0] == 'P' ? "or set rectified to false, if K is filled."
                                              : "made by camera_calibration.")};
}

std::optional<Finding> findCameraInfoSize(const InputFacts& input) {
  if (!input.camera || !calibrated(*input.camera) || sameSize(input)) return std::nullopt;
  return Finding{
      Code::kCameraInfoSize,
      "Images of " + input.depth.name + " have " + size(input.width, input.height) +
          " pixels, but expected a camera_info of the image's size, and that on " +
          input.info.name + " is for " + size(input.camera->width, input.camera->height) +
          ": the calibration is of another resolution, or of another camera. Give the "
          "driver a calibration of this size, or set binning or region of interest in "
          "camera_info (depth_camera_info_url of camera.launch; the driver's parameter depth_mode "
          "is the images' size)."};
}

Findings examineInput(const InputFacts& input) {
  Findings findings;
  for (const auto rule : {findNotSubscribed, findSwappedTopics, findNoImages, findWrongEncoding,
                          findNoCameraInfo, findUncalibrated, findCameraInfoSize}) {
    if (const auto finding = rule(input)) {
      findings.push_back(*finding);
      break;
    }
  }
  if (findings.empty() && !input.refusal.empty()) {
    findings.push_back({Code::kUnusableImages, "Images of " + input.depth.name +
                                                   " cannot be used: " + input.refusal +
                                                   ". Correct what publishes them."});
  }
  if (findings.empty()) {
    if (const auto finding = findStampsApart(input)) findings.push_back(*finding);
  }
  if (const auto finding = findStampsOffClock(input)) findings.push_back(*finding);
  return findings;
}

}  // namespace dominant_plane_detection
