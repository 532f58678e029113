#pragma once

#include <cstddef>

namespace dominant_plane_detection {

/// @return [#] calls of operator new in this program so far. Only in programs that
/// count_allocations.cpp is part of; Eigen and the standard library both allocate through it.
std::size_t allocationCount();

}  // namespace dominant_plane_detection
