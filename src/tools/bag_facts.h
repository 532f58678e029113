#pragma once

#include <rosbag/bag.h>

#include "doctor/facts.h"
#include "doctor_report.h"

namespace dominant_plane_detection {

/// The topics of a recording that depth is to be taken from, and those that could be meant.
/// @throw std::runtime_error with several depth topics and none chosen.
InputFacts bagFacts(const rosbag::Bag& bag, const DoctorSettings& settings,
                    const RecordingOptions& options);

}  // namespace dominant_plane_detection
