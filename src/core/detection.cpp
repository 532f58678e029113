#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {

const char* stateName(State state) {
  switch (state) {
    case State::kFound:
      return "FOUND";
    case State::kNoDepth:
      return "NO_DEPTH";
    case State::kTooFewPoints:
      return "TOO_FEW_POINTS";
    case State::kNoRegion:
      return "NO_REGION";
    case State::kTooSmall:
      return "TOO_SMALL";
    case State::kTooTilted:
      return "TOO_TILTED";
    case State::kOutOfHeightRange:
      return "OUT_OF_HEIGHT_RANGE";
    case State::kBadInput:
      return "BAD_INPUT";
  }
  return "";
}

const char* kindName(PlaneKind kind) {
  switch (kind) {
    case PlaneKind::kFloor:
      return "floor";
    case PlaneKind::kRamp:
      return "ramp";
    case PlaneKind::kStep:
      return "step";
    case PlaneKind::kTable:
      return "table";
    case PlaneKind::kWall:
      return "wall";
  }
  return "";
}

}  // namespace dominant_plane_detection
