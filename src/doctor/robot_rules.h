#pragma once

#include <optional>

#include "doctor/facts.h"
#include "doctor/finding.h"

namespace dominant_plane_detection {

/// @return nothing while no `base_frame` is set: then nothing is wanted of tf.
std::optional<Finding> findNoTf(const RobotFacts& robot);

/// The plane is so much higher or lower than tf's ground as a wrong unit would make it.
/// @return nothing where the ground is seen at tf's height as well.
std::optional<Finding> findScaleByHeight(const RobotFacts& robot);

/// @return nothing where a wrong unit explains it (see `findScaleByHeight`).
std::optional<Finding> findTfDisagrees(const RobotFacts& robot);

Findings examineRobot(const RobotFacts& robot);

}  // namespace dominant_plane_detection
