#include "openni2/image_pool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

namespace dominant_plane_detection {
namespace {

constexpr std::size_t kBytes = 1000;

TEST(ImagePool, MessageOwnsTheMemoryThatWasLent) {
  ImagePool pool;
  auto* memory = static_cast<std::uint8_t*>(pool.lend(kBytes));
  std::fill_n(memory, kBytes, std::uint8_t{7});
  const sensor_msgs::ImagePtr image = pool.take(memory);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->data.data(), memory);
  EXPECT_EQ(image->data, std::vector<std::uint8_t>(kBytes, 7));
}

TEST(ImagePool, CountsWhatSubscribersKeep) {
  ImagePool pool;
  void* const memory = pool.lend(kBytes);
  EXPECT_EQ(pool.takenBytes(), 0U);
  sensor_msgs::ImagePtr image = pool.take(memory);
  EXPECT_EQ(pool.takenBytes(), kBytes);
  image->data.resize(10);  // whatever becomes of it
  pool.giveBack(memory);
  EXPECT_EQ(pool.takenBytes(), kBytes);
  sensor_msgs::ImagePtr made = pool.make(3 * kBytes);
  EXPECT_EQ(made->data.size(), 3 * kBytes);
  EXPECT_FALSE(pool.lent());
  EXPECT_EQ(pool.takenBytes(), 4 * kBytes);
  made.reset();
  image.reset();
  EXPECT_EQ(pool.takenBytes(), 0U);
}

TEST(ImagePool, UsesAMessageAgainOnlyWhenBothHaveLetGo) {
  ImagePool pool;
  void* first = pool.lend(kBytes);
  sensor_msgs::ImagePtr image = pool.take(first);
  pool.giveBack(first);
  void* second = pool.lend(kBytes);
  EXPECT_NE(second, first) << "a subscriber has the first";
  image.reset();
  EXPECT_EQ(pool.lend(kBytes), first);

  image = pool.take(second);
  image.reset();
  EXPECT_NE(pool.lend(kBytes), second) << "the driver has the second";
  EXPECT_EQ(pool.messages(), 3U);
}

TEST(ImagePool, AKeptMessageStaysAsItIs) {
  ImagePool pool;
  std::vector<sensor_msgs::ImagePtr> kept;
  for (std::uint8_t i = 0; i < 50; ++i) {
    void* memory = pool.lend(kBytes);
    std::fill_n(static_cast<std::uint8_t*>(memory), kBytes, i);
    kept.push_back(pool.take(memory));
    pool.giveBack(memory);
  }
  for (std::uint8_t i = 0; i < 50; ++i) {
    EXPECT_EQ(kept[i]->data, std::vector<std::uint8_t>(kBytes, i));
  }
}

TEST(ImagePool, KeepsNoMoreSpareMessagesThanItWasTold) {
  ImagePool pool(2);
  std::vector<sensor_msgs::ImagePtr> kept;
  for (int i = 0; i < 10; ++i) {
    void* memory = pool.lend(kBytes);
    kept.push_back(pool.take(memory));
    pool.giveBack(memory);
  }
  EXPECT_EQ(pool.messages(), 10U);
  kept.clear();
  EXPECT_EQ(pool.messages(), 2U);
}

TEST(ImagePool, KnowsMemoryThatIsNotItsOwn) {
  ImagePool pool;
  int other = 0;
  EXPECT_FALSE(pool.take(&other));
  pool.giveBack(&other);
  void* memory = pool.lend(kBytes);
  const auto image = pool.take(memory);
  EXPECT_FALSE(pool.take(memory)) << "a frame is published once";
}

TEST(ImagePool, MessageOutlivesThePool) {
  sensor_msgs::ImagePtr image;
  {
    ImagePool pool;
    void* memory = pool.lend(kBytes);
    image = pool.take(memory);
    pool.giveBack(memory);
  }
  image->data.assign(kBytes, 3);
  EXPECT_EQ(image->data.back(), 3);
}

TEST(ImagePool, SizeMayChangeFromFrameToFrame) {
  ImagePool pool;
  void* memory = pool.lend(2 * kBytes);
  sensor_msgs::ImagePtr image = pool.take(memory);
  image->data.resize(kBytes);  // the frame has less than the driver asked for
  pool.giveBack(memory);
  image.reset();
  memory = pool.lend(2 * kBytes);
  image = pool.take(memory);
  EXPECT_EQ(image->data.size(), 2 * kBytes);
}

TEST(ImagePool, ManyThreads) {
  ImagePool pool;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&pool, t] {
      for (int i = 0; i < 2000; ++i) {
        const auto value = static_cast<std::uint8_t>(t + i);
        void* memory = pool.lend(64);
        std::fill_n(static_cast<std::uint8_t*>(memory), 64, value);
        const sensor_msgs::ImageConstPtr image = pool.take(memory);
        pool.giveBack(memory);
        ASSERT_EQ(std::count(image->data.begin(), image->data.end(), value), 64);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_LE(pool.messages(), 8U);
}

}  // namespace
}  // namespace dominant_plane_detection
