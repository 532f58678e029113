#pragma once

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
Inputs openInputs(const std::vector<std::string>& paths, const SourceOptions& options);

}  // namespace dominant_plane_detection
