#pragma once

#include <sensor_msgs/Image.h>

#include <cstddef>
#include <memory>

namespace dominant_plane_detection {

/// Image messages whose pixels a camera driver writes: the driver's frame buffer is the message's
/// memory, so that nothing is copied on the way from the sensor to whoever subscribes.
///
/// A message goes round: the driver gets its memory (`lend`), the message is published (`take`),
/// the driver gives the memory back (`giveBack`), the last subscriber lets go. Only when both are
/// done with it is it used again; somebody who keeps a message keeps its pixels as they are. May be
/// used from any thread; messages may outlive the pool.
class ImagePool {
 public:
  /// [byte] More than that is not to be handed to subscribers at a time: 22 s of depth, 14 s of
  /// colour at 640x480 and 30 Hz.
  static constexpr std::size_t kMostTaken = 400'000'000;

  /// @param spare [#] of messages that are kept for reuse; more are freed.
  explicit ImagePool(std::size_t spare = 8);

  /// @return memory for a frame of that many bytes.
  void* lend(std::size_t bytes);

  /// @param memory lent, not yet given back.
  /// @return the message that owns it, with the pixels and fields that it has; nobody else has it.
  /// Nothing for memory that is not on loan, or whose message was taken before.
  sensor_msgs::ImagePtr take(const void* memory);

  /// @return a message of that many bytes, which nobody else has, with what happens to be in it.
  sensor_msgs::ImagePtr make(std::size_t bytes);

  /// The driver does not need the memory any more.
  void giveBack(const void* memory);

  /// @return whether the driver has memory that it did not give back.
  bool lent() const;
  /// @return [byte] of the messages that were taken and not let go of.
  std::size_t takenBytes() const;
  /// @return [#] of messages that are made and not freed.
  std::size_t messages() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace dominant_plane_detection
