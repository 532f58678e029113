#pragma once

#include <opencv2/core/mat.hpp>

#include "dominant_plane_detection/depth_image.h"
#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {

/// @return the depth as a grey picture, 8-bit BGR: near bright, far dark, no reading dark blue.
cv::Mat greyPicture(const DepthView& depth);

/// The picture with the ground painted black, as in the paper's Fig. 4(b) and 5(b), obstacles
/// tinted red and drop-offs tinted yellow.
/// @param picture 8-bit BGR of the detection's size; changed in place.
void paintOverlay(const Detection& detection, cv::Mat& picture);

}  // namespace dominant_plane_detection
