// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "ros/waiting_callbacks.h"

namespace ardee::node {
namespace {

class Callback : public ros::CallbackInterface {
 public:
  explicit Callback(std::function<void()> act) : act_(std::move(act)) {}
  CallResult call() override {
    act_();
    return Success;
  }

 private:
  std::function<void()> act_;
};

void add(ros::CallbackQueue& queue, const std::function<void()>& act) {
  queue.addCallback(boost::make_shared<Callback>(act), 1);
}

TEST(WaitingCallbacks, AreCalledOnceAndInOrder) {
  ros::CallbackQueue queue;
  std::vector<int> called;
  for (int i = 0; i < 3; ++i) add(queue, [&called, i] { called.push_back(i); });
  call_waiting(queue, 0.0);
  EXPECT_EQ(called, (std::vector<int>{0, 1, 2}));
  call_waiting(queue, 0.0);
  EXPECT_EQ(called.size(), 3u);
}

TEST(WaitingCallbacks, AreCalledFromACallbackToo) {
  ros::CallbackQueue queue;
  constexpr int kRounds = 100000;  // enough rounds to move that list at a bad moment
  std::mt19937 random;
  int outer = 0, left = 0, inner = 0, inner_added = 0;
  for (int round = 0; round < kRounds; ++round) {
    add(queue, [&] {
      ++outer;
      for (auto count = random() % 3; count > 0; --count, ++inner_added) {
        add(queue, [&inner] { ++inner; });
      }
      call_waiting(queue, 0.0);
    });
    add(queue, [&left] { ++left; });
    call_waiting(queue, 0.0);
  }
  EXPECT_EQ(outer, kRounds);
  EXPECT_EQ(left, kRounds);
  EXPECT_EQ(inner, inner_added);
}

TEST(WaitingCallbacks, ThatNeverEndComeBackToTheCaller) {
  ros::CallbackQueue queue;
  int called = 0;
  std::function<void()> again = [&] {
    ++called;
    add(queue, again);
  };
  again();
  call_waiting(queue, 0.0);
  EXPECT_GT(called, 100);
  EXPECT_LT(called, 1000000);
}

}  // namespace
}  // namespace ardee::node
