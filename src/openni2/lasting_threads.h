#pragma once

#include <functional>
#include <future>

namespace dominant_plane_detection {

/// Runs a function in a thread that does not end with it: it waits for the next function.
///
/// Whatever calls OpenNI2 has to run in such a thread, or in main(). OpenNI2 2.2 keeps errors by
/// thread, and whenever a new thread calls it, asks the system after every thread that ever did;
/// asking after one that has ended is undefined and crashes with today's C libraries.
/// @return ready when the function has returned; what it throws comes out of get().
std::future<void> runInLastingThread(std::function<void()> function);

}  // namespace dominant_plane_detection
