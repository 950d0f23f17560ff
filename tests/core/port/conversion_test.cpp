#include "core/conversion/conversion.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "core/port/connection_rules.h"
#include "core/port/probe_port.h"
#include "core/types/builtin_types.h"
#include "plugins/testing/guards.h"
#include "tests/core/port/port_fixture.h"

namespace runnel::test {

struct Place {
  double x = 0;
  double heading = 0;
};
inline void Describe(TypeBuilder<Place>& type) {
  type.Name("test::Place").Field("x", &Place::x, {.unit = "m"}).Field("heading", &Place::heading, {.unit = "rad"});
}

struct Sweep {
  std::vector<float> ranges;
  std::array<Place, 2> ends;
};
inline void Describe(TypeBuilder<Sweep>& type) {
  type.Name("test::Sweep").Field("ranges", &Sweep::ranges, {.unit = "m"}).Field("ends", &Sweep::ends);
}

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

template <typename From, typename To>
std::optional<To> Converted(From value, const ConversionRequest& request) {
  const auto conversion = Conversion::Find(request);
  EXPECT_TRUE(conversion) << (conversion ? "" : conversion.error().ToString());
  To result{};
  if (!conversion || !(**conversion)(&value, &result)) return std::nullopt;
  return result;
}

template <typename From, typename To>
std::optional<To> Converted(From value, std::string name = {}, std::string part = {}) {
  return Converted<From, To>(value, {TypeOf<From>(), TypeOf<To>(), std::move(part), std::move(name)});
}

template <typename From, typename To>
bool IsPossible(std::string name = {}) {
  return Conversion::Find({TypeOf<From>(), TypeOf<To>(), {}, std::move(name)}).has_value();
}

TEST(ConversionTest, NumbersBecomeNumbersWhereNothingIsLost) {
  EXPECT_EQ((Converted<std::int32_t, double>(-7)), -7.0);
  EXPECT_EQ((Converted<float, double>(0.5F)), 0.5);
  EXPECT_EQ((Converted<bool, std::uint8_t>(true)), 1);
  EXPECT_EQ((Converted<std::uint32_t, std::int64_t>(4'000'000'000U)), 4'000'000'000);
  EXPECT_TRUE((IsPossible<std::int16_t, float>()));
  EXPECT_FALSE((IsPossible<double, float>()));
  EXPECT_FALSE((IsPossible<std::int64_t, double>()));
  EXPECT_FALSE((IsPossible<std::int32_t, std::uint64_t>()));
  EXPECT_FALSE((IsPossible<std::uint8_t, bool>()));
}

TEST(ConversionTest, OtherNumbersAreConvertedByName) {
  EXPECT_EQ((Converted<double, std::int32_t>(2.5, "round")), 3);
  EXPECT_EQ((Converted<double, std::int32_t>(-2.7, "truncate")), -2);
  EXPECT_EQ((Converted<double, std::int8_t>(1e9, "round")), 127);
  EXPECT_EQ((Converted<std::int32_t, std::uint16_t>(-1, "round")), 0);
  EXPECT_EQ((Converted<double, std::int32_t>(std::nan(""), "round")), std::nullopt);
  EXPECT_EQ((Converted<std::int64_t, double>(std::int64_t{1} << 60, "round")), std::ldexp(1.0, 60));
  const auto refused = Conversion::Find({TypeOf<double>(), TypeOf<std::int32_t>()});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().hint, HasSubstr("round"));
}

TEST(ConversionTest, PartsAreFoundOnceAndLookedUpEachTime) {
  const Place place{.x = 2, .heading = 1};
  EXPECT_EQ((Converted<Place, double>(place, {}, "heading")), 1.0);
  const Sweep sweep{.ranges = {1, 2}, .ends = {place, {.x = 5}}};
  EXPECT_EQ((Converted<Sweep, double>(sweep, {}, "ranges[1]")), 2.0);
  EXPECT_EQ((Converted<Sweep, double>(sweep, {}, "ranges[2]")), std::nullopt);
  EXPECT_EQ((Converted<Sweep, double>(sweep, {}, "ends[1].x")), 5.0);
  const auto too_far = Conversion::Find({TypeOf<Sweep>(), TypeOf<double>(), "ends[2].x"});
  ASSERT_FALSE(too_far);
  EXPECT_THAT(too_far.error().ToString(), HasSubstr("2, counted from 0"));
  const auto misspelt = Conversion::Find({TypeOf<Place>(), TypeOf<double>(), "headnig"});
  ASSERT_FALSE(misspelt);
  EXPECT_THAT(misspelt.error().ToString(), HasSubstr("did you mean 'heading'"));
}

TEST(ConversionTest, UnitsBecomeUnits) {
  const ConversionRequest degrees{TypeOf<Place>(), TypeOf<double>(), "heading", {}, {}, "deg"};
  EXPECT_DOUBLE_EQ((Converted<Place, double>({.heading = std::numbers::pi}, degrees)).value(), 180);
  EXPECT_THAT(Conversion::Find(degrees).value()->text(), HasSubstr("rad to deg"));
  const auto wrong = Conversion::Find({TypeOf<Place>(), TypeOf<double>(), "heading", {}, {}, "m"});
  ASSERT_FALSE(wrong);
  EXPECT_THAT(wrong.error().message, HasSubstr("in rad"));
  const auto whole = Conversion::Find({TypeOf<std::int32_t>(), TypeOf<std::int32_t>(), {}, {}, "m", "km"});
  EXPECT_FALSE(whole) << "whole kilometres would be another length";
  EXPECT_EQ((Converted<std::int32_t, double>(1500, {TypeOf<std::int32_t>(), TypeOf<double>(), {}, {}, "m", "km"})),
            1.5);
}

TEST(ConversionTest, AnythingBecomesATextOrASignal) {
  EXPECT_EQ((Converted<Place, std::string>({.x = 1})), "{x: 1, heading: 0}");
  EXPECT_TRUE((Converted<Place, Signal>({})));
  EXPECT_EQ((Converted<std::string, double>("2.5", "parse")), 2.5);
  EXPECT_EQ((Converted<std::string, double>("two", "parse")), std::nullopt);
  EXPECT_FALSE((IsPossible<std::string, double>()));
}

TEST(ConversionTest, PluginsBringMore) {
  EXPECT_FALSE((IsPossible<Place, Sweep>("test/ends")));
  RegisterConversion<Place, Sweep>("test/ends", [](const Place& place, Sweep& sweep) { sweep.ends = {place, place}; });
  EXPECT_FALSE((IsPossible<Place, Sweep>())) << "only by its name";
  EXPECT_EQ((Converted<Place, Sweep>({.x = 3}, "test/ends"))->ends[1].x, 3);
  RegisterConversion<Place, Sweep>(
      "test/ends", [](const Place&, Sweep&) -> bool { throw std::runtime_error("not today"); }, "", true);
  EXPECT_TRUE((IsPossible<Place, Sweep>()));
  EXPECT_EQ((Converted<Place, Sweep>({}, "test/ends")).has_value(), false) << "what it throws is nothing";
  const auto unknown = Conversion::Find({TypeOf<Place>(), TypeOf<Sweep>(), {}, "test/end"});
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().hint, HasSubstr("test/ends"));
}

class ConvertedConnectionTest : public PortTest {};

TEST_F(ConvertedConnectionTest, ReadersQueuesAndWakersFindWhatAValueHasBecome) {
  auto& sender = MakeSender<Place>();
  auto& latest = MakeReceiver<double>("latest");
  auto& queued = MakeReceiver<double>("queued");
  CountingWaker waker;
  latest.in.SetWaker(&waker);
  sender.out.Publish(Place{.x = 1});
  Connect(sender.out, latest.in, {.part = "x"});
  Connect(sender.out, queued.in, {.queue = 8, .part = "heading"});
  EXPECT_EQ(waker.wakes, 1);
  EXPECT_EQ(latest.in.Read().value_or(0), 1.0);
  for (int i = 2; i <= 4; ++i) {
    clock.Advance(Duration(1000));
    sender.out.Publish(Place{.x = 1.0 * i, .heading = 10.0 * i}, Time(Duration(100 + i)));
  }
  const auto read = latest.in.Read();
  EXPECT_EQ(read.value_or(0), 4.0);
  EXPECT_EQ(read.timestamp(), Time(Duration(104))) << "when it was measured";
  EXPECT_EQ(read.publication_time(), clock.Now());
  EXPECT_EQ(read.missed(), 2u);
  EXPECT_THAT(TakeAll(queued.in), ElementsAre(0.0, 20.0, 30.0, 40.0));
  EXPECT_EQ(waker.wakes, 4);
  // The structure is what people have made.
  EXPECT_THAT(latest.in.Sources(), ElementsAre(&sender.out));
  EXPECT_THAT(sender.out.Sinks(), ElementsAre(&latest.in, &queued.in));
  EXPECT_EQ(sender.out.outgoing().front().SourceText(), "/sender/out.x");
  ASSERT_TRUE(Port::Disconnect(sender.out, latest.in));
  EXPECT_FALSE(latest.in.Read());
  sender.out.Publish(Place{.heading = 5});
  EXPECT_THAT(TakeAll(queued.in), ElementsAre(5.0));
  latest.in.SetWaker(nullptr);
}

TEST_F(ConvertedConnectionTest, ItPassesInterfacePortsOneAfterTheOther) {
  auto& sender = MakeSender<Sweep>();
  auto& other = MakeSender<Sweep>("other");
  auto& outer = runtime.Create<ProxyPort>(runtime.root(), "outer", Port::Direction::kInput, TypeOf<Sweep>());
  auto& inner = runtime.Create<ProxyPort>(runtime.root(), "inner", Port::Direction::kInput, TypeOf<float>());
  auto& receiver = MakeReceiver<double>();
  Connect(inner, receiver.in);  // float to double
  Connect(outer, inner, {.part = "ranges[0]"});
  Connect(sender.out, outer);
  sender.out.Publish(Sweep{.ranges = {2.5F}, .ends = {}});
  EXPECT_EQ(receiver.in.Get(), 2.5);
  Connect(other.out, outer);
  other.out.Publish(Sweep{.ranges = {3.5F}, .ends = {}});
  EXPECT_EQ(receiver.in.Get(), 3.5) << "the value published last counts";
  EXPECT_THAT(receiver.in.Sources(), ElementsAre(&sender.out, &other.out));
  ASSERT_TRUE(Port::Disconnect(other.out, outer));
  sender.out.Publish(Sweep{.ranges = {4.5F}, .ends = {}});
  other.out.Publish(Sweep{.ranges = {9.0F}, .ends = {}});
  EXPECT_EQ(receiver.in.Get(), 4.5);
  ASSERT_TRUE(runtime.Delete(sender));
  EXPECT_FALSE(receiver.in.Read());
}

TEST_F(ConvertedConnectionTest, SwappedModulesGoOn) {
  auto& before = MakeSender<Place>("before");
  auto& after = MakeSender<Place>("after");
  auto& receiver = MakeReceiver<double>("receiver");
  auto& next = MakeReceiver<double>("next");
  Connect(before.out, receiver.in, {.queue = 4, .part = "x"});
  before.out.Publish(Place{.x = 1});
  after.out.TakeOver(before.out);
  after.out.Publish(Place{.x = 2});
  next.in.TakeOver(receiver.in);
  after.out.Publish(Place{.x = 3});
  EXPECT_THAT(TakeAll(next.in), ElementsAre(1.0, 2.0, 3.0));
  ASSERT_TRUE(runtime.Delete(before));
  ASSERT_TRUE(runtime.Delete(receiver));
  after.out.Publish(Place{.x = 4});
  EXPECT_EQ(next.in.Get(), 4.0);
}

TEST_F(ConvertedConnectionTest, WhatIsSetByHandIsConverted) {
  auto& sender = MakeSender<Place>();
  auto& receiver = MakeReceiver<double>();
  Connect(sender.out, receiver.in, {.part = "x"});
  sender.out.Publish(Place{.x = 1});
  ASSERT_TRUE(sender.out.PublishByHand([](void* value) -> Result<void> {
    static_cast<Place*>(value)->x = 9;
    return {};
  }));
  sender.out.Publish(Place{.x = 2});
  EXPECT_EQ(receiver.in.Get(), 9.0);
  EXPECT_TRUE(sender.out.Release());
  EXPECT_EQ(receiver.in.Get(), 2.0);
  sender.out.Publish(Place{.x = 3});
  EXPECT_EQ(receiver.in.Get(), 3.0);
}

TEST_F(ConvertedConnectionTest, AWrongPairIsToldWithWhatWouldFit) {
  auto& sender = MakeSender<Place>();
  auto& receiver = MakeReceiver<double>();
  const auto refused = Port::Connect(sender.out, receiver.in);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("carries test::Place, but /receiver/in takes double"));
  EXPECT_THAT(refused.error().hint, HasSubstr("from=\"….x\", or from=\"….heading\""));
  auto& counter = MakeReceiver<int>("counter");
  const auto lossy = Port::Connect(sender.out, counter.in, {.part = "x"});
  ASSERT_FALSE(lossy);
  EXPECT_THAT(lossy.error().hint, HasSubstr("convert=\"round\""));
  EXPECT_THAT(sender.out.outgoing(), IsEmpty());
  EXPECT_FALSE(Port::Connect(sender.out, receiver.in, {.pull = true, .part = "x"}));
}

TEST_F(ConvertedConnectionTest, NeitherAllocatesNorCostsWhoIsNotConverted) {
  auto& sender = MakeSender<Place>();
  auto& receiver = MakeReceiver<double>();
  Connect(sender.out, receiver.in, {.queue = 2, .part = "x"});
  const CycleScope cycle({.now = Time(Duration(1))});
  double sum = 0;
  const auto turn = [&] {
    sender.out.Publish(Place{.x = 1});
    sum += receiver.in.Get() + *receiver.in.Take();
  };
  for (int i = 0; i < 20; ++i) turn();
  const AllocationGuard allocations;
  for (int i = 0; i < 100; ++i) turn();
  EXPECT_EQ(allocations.allocations(), 0u);
  EXPECT_EQ(sum, 240);
}

TEST_F(ConvertedConnectionTest, RulesSayWhyNot) {
  AddConnectionRule({.name = "test/one_way", .summary = "", .check = [](const Port& from, const Port&) -> Result<void> {
                       if (from.path() != "/sender/out") return {};
                       return Error{.message = "nobody may listen"};
                     }});
  auto& sender = MakeSender<double>();
  auto& other = MakeSender<double>("other");
  auto& receiver = MakeReceiver<double>();
  const auto refused = Port::Connect(sender.out, receiver.in);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().ToString(), HasSubstr("nobody may listen (rule 'test/one_way')"));
  Connect(other.out, receiver.in);
  AddConnectionRule({.name = "test/one_way", .summary = {}, .check = {}});
  Connect(sender.out, receiver.in);
}

}  // namespace
}  // namespace runnel::test
