// A parameter is set or not, wherever memory runs out or a copy throws, and can be set the next time.

#include <memory>
#include <new>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/module/module.h"
#include "core/port/output.h"
#include "core/types/type_builder.h"
#include "plugins/parameters/parameter.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/testing/fault_injection.h"

namespace runnel::test {
namespace {

/// Held, since it has a text, and fails when it is copied.
struct FragileWords {
  FragileWords() = default;
  FragileWords(std::string of) : words(std::move(of)) {}
  FragileWords(const FragileWords&) = default;
  FragileWords& operator=(const FragileWords& other) {
    InjectionPoint();
    words = other.words;
    return *this;
  }
  std::string words;
};
void Describe(TypeBuilder<FragileWords>& type) { type.Name("test::FragileWords").Field("words", &FragileWords::words); }

class Talker final : public Module {
 public:
  using Module::Module;
  Parameter<FragileWords> words{this, "words", {.default_value = {"nothing"}}};

 private:
  void Update() override {}
};

struct Robot {
  Robot() {
    (void)Port::Connect(output, *talker.words.Feed());
    (void)runtime.MakeReady(runtime.root());
    (void)scheduler.RunUntil(runtime.clock().Now() + std::chrono::milliseconds(40));
  }
  [[nodiscard]] std::string Words() const { return talker.words.Get()->words; }

  Runtime runtime;
  Scheduler scheduler{runtime, {.clock = SchedulerOptions::ClockKind::kSimulated}};
  Talker& talker = runtime.Create<Talker>(runtime.root(), "talker");
  Output<FragileWords> output{runtime.root(), "output"};
};

const std::string kLong(100, 'x');  // not within the text itself

TEST(ParameterFaults, WhatCouldNotBeSetIsAsBeforeAndIsSetTheNextTime) {
  for (const InjectedFault fault : kInjectedFaults) {
    auto robot = std::make_unique<Robot>();
    bool is_set = false;
    const std::size_t points = AtEachPoint(
        fault,
        [&] {
          is_set = false;
          try {
            is_set = robot->talker.words.Set({kLong}).has_value();
          } catch (...) {
          }
        },
        [&](bool has_struck) {
          ASSERT_NE(is_set, has_struck);
          ASSERT_EQ(robot->Words(), is_set ? kLong : "nothing");
          ASSERT_TRUE(robot->talker.words.Set({"later"}));
          ASSERT_EQ(robot->Words(), "later");
          robot = std::make_unique<Robot>();
        });
    EXPECT_GT(points, 0u);
  }
}

TEST(ParameterFaults, WhatCouldNotBeFedIsAsBeforeAndIsSetByHandThen) {
  for (const InjectedFault fault : kInjectedFaults) {
    auto robot = std::make_unique<Robot>();
    const auto publish = [&] {
      robot = std::make_unique<Robot>();
      robot->output.Publish({kLong});
    };
    publish();
    const std::size_t points = AtEachPoint(
        fault,
        [&] {
          try {
            (void)robot->scheduler.RunUntil(robot->runtime.clock().Now() + std::chrono::milliseconds(40));
          } catch (...) {
          }
        },
        [&](bool has_struck) {
          ASSERT_TRUE(has_struck || robot->Words() == kLong);
          ASSERT_TRUE(robot->talker.words.Set({"by hand"}));
          ASSERT_EQ(robot->Words(), "by hand");
          publish();
        });
    EXPECT_GT(points, 0u);
  }
}

}  // namespace
}  // namespace runnel::test
