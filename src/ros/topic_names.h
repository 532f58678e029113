#pragma once

namespace dominant_plane_detection::topics {

// Inputs, relative to the node's namespace.
constexpr const char* kDepth = "depth/image_raw";
constexpr const char* kPoints = "points";
constexpr const char* kPicture = "image";

// Outputs, private to the node.
constexpr const char* kPlane = "plane";
constexpr const char* kCoefficients = "coefficients";
constexpr const char* kGroundMask = "ground_mask";
constexpr const char* kOverlay = "overlay";
constexpr const char* kObstacles = "obstacles";
constexpr const char* kGround = "ground";

}  // namespace dominant_plane_detection::topics
