#include "plugins/network_discovery/value_forecast.h"

#include <chrono>

#include <gtest/gtest.h>

namespace runnel {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Time kBegin{seconds(10)};

// Of a value each `interval`, now `jitter` early, now late: when the last of them came.
Time NoteMany(ValueForecast& forecast, Duration interval, Duration jitter, int count = 200) {
  Time came{};
  for (int i = 0; i < count; ++i) {
    came = kBegin + i * interval + (i % 2 == 0 ? jitter : -jitter);
    forecast.Note(came);
  }
  return came;
}

TEST(ValueForecast, ExpectsTheNextValueWhereAnEvenIntervalEnds) {
  ValueForecast forecast;
  const Time last = NoteMany(forecast, milliseconds(10), microseconds(5));
  const auto window = forecast.window(last);
  ASSERT_TRUE(window);
  EXPECT_LE(window->begin, last + milliseconds(10) - microseconds(5));
  EXPECT_GE(window->end, last + milliseconds(10) + microseconds(5));
  EXPECT_LE(window->end - window->begin, microseconds(100));
}

TEST(ValueForecast, IsWiderForWhoIsLessPunctual) {
  ValueForecast punctual;
  ValueForecast other;
  const auto narrow = punctual.window(NoteMany(punctual, milliseconds(10), microseconds(1)));
  const auto wide = other.window(NoteMany(other, milliseconds(10), microseconds(20)));
  ASSERT_TRUE(narrow && wide);
  EXPECT_LT(narrow->end - narrow->begin, wide->end - wide->begin);
}

TEST(ValueForecast, ExpectsNothingOfWhoPublishesAsItLikes) {
  ValueForecast forecast;
  const Time last = NoteMany(forecast, milliseconds(10), milliseconds(2));
  EXPECT_FALSE(forecast.window(last));
}

TEST(ValueForecast, ExpectsNothingAtTheBeginningNorTooOftenNorTooSeldom) {
  ValueForecast few;
  EXPECT_FALSE(few.window(NoteMany(few, milliseconds(10), {}, 4)));
  ValueForecast often;
  EXPECT_FALSE(often.window(NoteMany(often, microseconds(50), {})));
  ValueForecast seldom;
  EXPECT_FALSE(seldom.window(NoteMany(seldom, seconds(5), {})));
}

TEST(ValueForecast, GivesUpWhenNoneComesAndFollowsAnotherInterval) {
  ValueForecast forecast;
  Time last = NoteMany(forecast, milliseconds(10), {});
  EXPECT_FALSE(forecast.window(last + milliseconds(11)));
  for (int i = 0; i < 100; ++i) forecast.Note(last += milliseconds(4));
  const auto window = forecast.window(last);
  ASSERT_TRUE(window);
  EXPECT_LT(window->begin, last + milliseconds(4));
  EXPECT_GT(window->end, last + milliseconds(4));
}

TEST(ValueForecast, ForgetsOneThatCameMuchTooLate) {
  ValueForecast forecast;
  const Time last = NoteMany(forecast, milliseconds(10), {});
  forecast.Note(last + milliseconds(12));
  const auto window = forecast.window(last + milliseconds(12));
  ASSERT_TRUE(window);
  EXPECT_LT(window->begin, last + milliseconds(20));
  EXPECT_GT(window->end, last + milliseconds(20));
}

}  // namespace
}  // namespace runnel
