#pragma once

#include "dominant_plane_detection/tile_moments.h"
#include "image_kernel.h"

namespace dominant_plane_detection {

/// The loop of `computeTileMoments`, with the widest vector instructions that this machine has.
/// @param tiles of the image's size already.
void runTileMomentsKernel(const ImageInput& input, TileMoments& tiles);

}  // namespace dominant_plane_detection
