#pragma once

#include "core/further_planes.h"
#include "core/hesse_plane.h"
#include "core/tile_moments.h"
#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {

/// Tells what a plane is beside the ground.
///
/// Its slope against the ground decides: a wall from 45 degrees on, a ramp from 5; a ceiling is
/// level, as what is seen from above. What is less steep is a ramp where it begins as low as the
/// ground and rises by half of its mean height at least; otherwise it is level: floor where it is
/// as high as the ground, a step up to 0.35 m up or down, two of a stair's, and else a table.
/// @param ground the dominant plane.
/// @param band [m] |height| of the ground's own points at a depth.
PlaneKind kindOf(const HessePlane& ground, const TilePlane& plane, const TileMoments& tiles,
                 const DepthThreshold& band, const NoiseModel& noise);

/// @return [rad] between a plane and the ground, 0 to pi: more than pi / 2 is seen from below.
double slopeOf(const HessePlane& ground, const HessePlane& plane);

/// @return whether a plane's surface begins on the ground: in three places at least their tiles are
/// neighbours and closer than delta.
bool joinsGround(const TilePlane& plane, const std::vector<std::uint8_t>& ground,
                 const TileMoments& tiles, const TileLimits& limits);

}  // namespace dominant_plane_detection
