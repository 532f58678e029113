#pragma once

#include <vector>

#include "../test/synthetic/synthetic_set.h"
#include "support/recordings.h"

namespace dominant_plane_detection {

/// The real recordings that are there, and random scenes, which are always there.
inline std::vector<ReferenceSet> loadAllSets(std::uint32_t random_scenes) {
  std::vector<ReferenceSet> sets;
  for (const auto& load : {loadRobotLab, loadCabinet, loadLowRobot}) {
    ReferenceSet set = load();
    if (!set.images.empty()) sets.push_back(std::move(set));
  }
  sets.push_back(loadRandomScenes(random_scenes));
  sets.push_back(loadSmoothRandomScenes(random_scenes));
  return sets;
}

}  // namespace dominant_plane_detection
