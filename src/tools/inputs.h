#pragma once

#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "frame_source.h"

namespace dominant_plane_detection {

/// What a command line's inputs turned out to be.
struct Inputs {
  std::vector<std::unique_ptr<FrameSource>> sources;
  std::vector<std::string> errors;  ///< one sentence for each input that cannot be read

  /// @return [#] of images in all sources.
  std::size_t frames() const;
};

/// @param paths PNG files, folders of PNG files, bags and .oni recordings, in any mixture and
/// order.
/// @param options with a correction, images come corrected.
Inputs openInputs(const std::vector<std::string>& paths, const SourceOptions& options);

/// Calls visit(frame) for each image, and prints what cannot be read.
/// @param tool that the lines begin with.
/// @return whether everything could be read.
template <typename Visit>
bool forEachFrame(const Inputs& inputs, const char* tool, Visit&& visit) {
  bool all = inputs.errors.empty();
  const auto complain = [&](const std::string& error) {
    std::cerr << tool << ": " << error << '\n';
    all = false;
  };
  for (const std::string& error : inputs.errors) complain(error);
  for (const auto& source : inputs.sources) {
    for (bool more = true; more;) {
      try {
        const std::optional<Frame> frame = source->next();
        more = frame.has_value();
        if (more) visit(*frame);
      } catch (const UnreadableFrame& error) {
        complain(error.what());
      }
    }
  }
  return all;
}

}  // namespace dominant_plane_detection
