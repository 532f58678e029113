#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace dominant_plane_detection {

// What was seen of a running system or a recording, before anybody judges it.

/// One of the topics that a detection takes, and what came on it.
struct TopicFacts {
  std::string name;                 ///< as it is resolved
  std::string expected_type;        ///< such as sensor_msgs/Image
  std::string type;                 ///< as which it is published; empty: nobody does
  std::size_t messages = 0;         ///< [#] that came
  std::vector<std::string> others;  ///< topics of the expected type that there are
  bool known = true;                ///< false: the master, which knows types, does not answer
  std::string packed = {};          ///< depth that an image_transport packed, in a recording
};

/// What a camera_info says of the images.
struct CameraInfoFacts {
  std::string frame_id;
  int width = 0;             ///< [px] of the images, binning and region of interest taken off
  int height = 0;            ///< [px]
  double fx = 0.0;           ///< [px]
  double fy = 0.0;           ///< [px]
  const char* matrix = "K";  ///< that the focal lengths are from; P for rectified images
};

/// Where depth comes from.
struct InputFacts {
  bool live = true;          ///< false: a recording
  bool from_points = false;  ///< clouds instead of images
  TopicFacts depth;          ///< images, or clouds
  TopicFacts info;           ///< camera_info; without a name where none is needed
  std::string frame_id;      ///< of an image
  std::string encoding;      ///< of an image
  bool encoding_is_depth = true;
  int width = 0;                          ///< [px] of an image
  int height = 0;                         ///< [px]
  std::optional<CameraInfoFacts> camera;  ///< that came with or beside the image
  std::string refusal;             ///< why images cannot be used: what was expected and what came
  std::string subscription_error;  ///< why nothing is subscribed
  /// [s] from an image's stamp to that of the nearest camera_info, the least of all images that
  /// have none of their own, where most have not
  std::optional<double> info_offset;
  std::optional<double> age;  ///< [s] of images when they come, by this computer's clock
};

/// The clock that nodes go by.
struct ClockFacts {
  bool use_sim_time = false;
  bool ticks = false;  ///< a time came on /clock
};

/// What tf says of the camera, and how the plane differs.
struct RobotFacts {
  std::string base_frame;   ///< empty: nothing is wanted of tf
  std::string tf_problem;   ///< why most images have no transform; empty where they have
  bool tf_is_late = false;  ///< tf has the frames, but not at the times of most of these
  std::string mount;        ///< how the plane differs from tf's ground; empty where it does not
  bool mount_is_height = false;         ///< that is of a plane at quite another height
  std::size_t planes_at_tf_height = 0;  ///< [#]
  std::size_t planes_elsewhere = 0;     ///< [#] at quite another height
  double height = 0.0;                  ///< [m] of the camera by the plane; 0: not known
  double tf_height = 0.0;               ///< [m] by tf; 0: not known
};

}  // namespace dominant_plane_detection
