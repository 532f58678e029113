#pragma once

namespace dominant_plane_detection::topics {

// The driver's outputs, relative to its namespace; the first is the detection's input, too.
constexpr const char* kDepth = "depth/image_raw";
constexpr const char* kRegisteredDepth = "depth_registered/image_raw";
constexpr const char* kColour = "rgb/image_raw";
constexpr const char* kInfrared = "ir/image_raw";
constexpr const char* kRawDisparity = "depth/disparity_raw";
constexpr const char* kImu = "imu/data_raw";  // REP 145: without an orientation
constexpr const char* kTiltNow = "cur_tilt_angle";
constexpr const char* kProjector = "projector/camera_info";

// Inputs of the driver, relative to its namespace.
constexpr const char* kTilt = "tilt_angle";
constexpr const char* kLed = "led_option";

// More inputs of the detection, relative to its namespace.
constexpr const char* kPoints = "points";
constexpr const char* kPicture = "image";
constexpr const char* kImuData = "imu/data";  // REP 145: with an orientation

// Outputs, private to the node.
constexpr const char* kPlane = "plane";
constexpr const char* kPlanes = "planes";
constexpr const char* kCoefficients = "coefficients";
constexpr const char* kGroundMask = "ground_mask";
constexpr const char* kLabels = "labels";
constexpr const char* kPlaneIndex = "plane_index";
constexpr const char* kOverlay = "overlay";
constexpr const char* kObstacles = "obstacles";
constexpr const char* kGround = "ground";
constexpr const char* kDropOffs = "drop_offs";
constexpr const char* kMissingGround = "missing_ground";
constexpr const char* kObstacleIndices = "obstacle_indices";
constexpr const char* kHeightImage = "height_image";
constexpr const char* kOutline = "outline";
constexpr const char* kMarkers = "markers";
constexpr const char* kScan = "scan";
constexpr const char* kLocalMap = "local_map";
constexpr const char* kObstacleBoxes = "obstacle_boxes";
constexpr const char* kBoxMarkers = "obstacle_box_markers";

}  // namespace dominant_plane_detection::topics
