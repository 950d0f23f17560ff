// What clients say of the strangest kind: the component goes on, or comes to its end in order.

#include <chrono>
#include <csignal>

#include <gmock/gmock.h>

#include "plugins/real_time_check/sanitizer.h"
#include "tests/plugins/genom_standalone/standalone_process.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;

std::string LongLine(std::size_t length) { return R"({"state":true,"as":")" + std::string(length, 'x') + R"("})"; }

TEST(HostileLinesTest, ALineWithMoreKeysTakesNoLongerForEach) {
  StandaloneProcess meter(RUNNEL_TEST_METER);
  std::string line = R"({"state":true)";
  for (int i = 0; i < 250'000; ++i) line += ",\"" + std::to_string(i) + "\":0";
  const auto begin = std::chrono::steady_clock::now();
  meter.Say(line + "}");
  EXPECT_TRUE(meter.Hear().contains("done"));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(HostileLinesTest, WhoSaysATooLongLineIsLeftAndTheOthersAreNot) {
  StandaloneProcess meter(RUNNEL_TEST_METER);
  meter.Say(LongLine(5 << 20));
  EXPECT_EQ(meter.Hear(), "gone");
  meter.Send(SIGTERM);
  EXPECT_EQ(meter.Wait(), 0);
}

TEST(HostileLinesTest, WhatThereIsNoMemoryForIsAnError) {
  if (RUNNEL_UNDER_SANITIZER) GTEST_SKIP() << "a sanitizer has its own malloc";
  StandaloneProcess meter(RUNNEL_TEST_METER);
  // A thread that begins takes more than is left below.
  EXPECT_EQ(meter.Ask(Json::parse(R"({"as":5,"call":"count","with":{"turns":1}})"))["accepted"], 1);
  EXPECT_TRUE(meter.Hear().contains("done"));
  meter.LimitMemory(10 << 20);
  meter.Say(LongLine(3 << 20));
  EXPECT_THAT(meter.Hear().dump(), HasSubstr("cannot be done: std::bad_alloc"));
  EXPECT_TRUE(meter.Ask({{"kill", true}}).contains("done"));
  EXPECT_EQ(meter.Wait(), 0);
}

TEST(HostileLinesTest, EndsInOrderWhereThereIsNoMemoryAtAll) {
  if (RUNNEL_UNDER_SANITIZER) GTEST_SKIP() << "a sanitizer has its own malloc";
  StandaloneProcess meter(RUNNEL_TEST_METER);
  EXPECT_EQ(meter.Ask(Json::parse(R"({"as":5,"call":"count","with":{"turns":1000000}})"))["accepted"], 1);
  meter.LimitMemory(0);
  meter.Say(LongLine(3 << 20));
  EXPECT_EQ(meter.Wait(), 1) << "activities come to their end first";
}

TEST(HostileLinesTest, WhoOnlyListensAnyLongerIsAnswered) {
  StandaloneProcess meter(RUNNEL_TEST_METER);
  meter.SayLast(R"({"as":1,"call":"count","with":{"turns":2}})");
  EXPECT_EQ(meter.Hear()["accepted"], 1);
  EXPECT_EQ(meter.Hear(), Json::parse(R"({"as":1,"done":{"left":0}})"));
  EXPECT_EQ(meter.Hear(), "gone") << "there is nothing more to say";
}

TEST(HostileLinesTest, StepsEndWhereTheyAreToldTo) {
  StandaloneProcess meter(RUNNEL_TEST_METER, {"--stepped"});
  EXPECT_EQ(meter.Ask({{"step", 1}, {"every", 0.3}}), Json::parse(R"({"done":{"time":1.0}})"));
  EXPECT_EQ(meter.Ask({{"step", 0.5}, {"every", 1}}), Json::parse(R"({"done":{"time":1.5}})"));
  EXPECT_EQ(meter.Ask({{"step", 0}, {"every", 1}}), Json::parse(R"({"done":{"time":1.5}})"));
  EXPECT_THAT(meter.Ask({{"step", 1e300}}).dump(), HasSubstr("146 years at most"));
  EXPECT_THAT(meter.Ask({{"step", 1e9}, {"every", 1e-9}}).dump(), HasSubstr("more than 100000 pieces"));
  EXPECT_THAT(meter.Ask({{"step", 1}, {"every", 1e-12}}).dump(), HasSubstr("'every' is a number"));
  EXPECT_EQ(meter.Ask({{"step", 0.5}}), Json::parse(R"({"done":{"time":2.0}})"));
}

TEST(HostileLinesTest, NumbersBeyondAFloatDoNotFit) {
  StandaloneProcess meter(RUNNEL_TEST_GUIDE, {"--stepped"});
  EXPECT_THAT(meter.Ask(Json::parse(R"({"put":{"surroundings":{"sensor_range":1e300}}})")).dump(),
              HasSubstr("sensor_range: 1e+300 does not fit"));
}

}  // namespace
}  // namespace runnel::test
