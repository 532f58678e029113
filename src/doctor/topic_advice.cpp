#include "doctor/topic_advice.h"

#include <algorithm>

namespace dominant_plane_detection {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

const std::string& likeliestDepth(const std::vector<std::string>& topics) {
  const auto depth = std::find_if(topics.begin(), topics.end(), [](const std::string& topic) {
    return topic.find("depth") != std::string::npos;
  });
  return depth == topics.end() ? topics.front() : *depth;
}

std::string remapTo(const InputFacts& input) {
  const std::string to = likeliestDepth(input.depth.others);
  if (!input.live) return "--topic " + to;
  return input.from_points ? "points:=" + to + " (argument points of detection.launch)"
                           : "depth/image_raw:=" + to + " (argument depth of detection.launch)";
}

std::string chooseAnother(const InputFacts& input) {
  const auto& others = input.depth.others;
  if (others.empty()) return "";
  return " Topics of this type: " + listed(others) + ". Give one of them: " + remapTo(input) + ".";
}

std::string unpackFirst(const TopicFacts& depth) {
  const std::size_t slash = depth.packed.rfind('/');
  if (slash == std::string::npos) return "";
  const std::string base = depth.packed.substr(0, slash);
  return " " + depth.packed + " is depth that an image_transport packed. Unpack it: play the " +
         "recording, run rosrun image_transport republish " + depth.packed.substr(slash + 1) +
         " in:=" + base + " raw out:=" + base + ", and record " + base + " and its camera_info.";
}

}  // namespace dominant_plane_detection
