#pragma once

#include "core/image_kernel.h"
#include "core/tile_moments.h"

namespace dominant_plane_detection {

/// The loop of `computeTileMoments`, with the widest vector instructions that this machine has.
/// @param tiles of the image's size already.
void runTileMomentsKernel(const ImageInput& input, TileMoments& tiles);

}  // namespace dominant_plane_detection
