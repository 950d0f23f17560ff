// Composites in the place of modules, and of one another.

#include "core/element/tags.h"
#include "core/paths/late_connections.h"
#include "core/paths/path_search.h"
#include "core/port/port_options.h"
#include "core/port/proxy_port.h"
#include "core/port/stand_in.h"
#include "plugins/structure/change_history.h"
#include "tests/plugins/structure/editor_fixture.h"

namespace runnel::test {
namespace {

/// Passes on all that it takes.
class Passer final : public Module {
 public:
  using Module::Module;
  Input<int> in{this, "in"};
  Input<int> more{this, "more"};
  Output<int> out{this, "out"};

 private:
  void Update() override {
    in.Drain([this](const auto& value) { out.Publish(*value); });
  }
};

class FaultyFilter final : public Module {
 public:
  using Module::Module;
  Input<int> in{this, "in"};
  Output<int> out{this, "out"};

 private:
  void Update() override { throw std::runtime_error("is faulty"); }
};

class Taker final : public Module {
 public:
  using Module::Module;
  Input<int> in{this, "in"};

 private:
  void Update() override {}
};

struct Interface : Group {
  using Group::Group;
  ProxyPort& in = runtime().Create<ProxyPort>(*this, "in", Port::Direction::kInput, TypeOf<int>());
  ProxyPort& out = runtime().Create<ProxyPort>(*this, "out", Port::Direction::kOutput, TypeOf<int>());
};
struct Boxed final : Interface {
  using Interface::Interface;
  Result<void> Construct() override {
    auto& part = runtime().Create<Passer>(*this, "part");
    if (auto tied = Port::Connect(in, part.in, {.queue = 20}); !tied) return tied;
    return Port::Connect(part.out, out);
  }
};
struct Straight final : Interface {
  using Interface::Interface;
  Result<void> Construct() override { return Port::Connect(in, out); }
};
/// Reads other numbers, within limits.
class Measured final : public Module {
 public:
  using Module::Module;
  Input<double> in{this, "in", {.limits = {.maximum = 100.}}};
  Output<double> out{this, "out"};

 private:
  void Update() override { out.Publish(in.Get()); }
};
struct BoxedMeasured final : Group {
  using Group::Group;
  Result<void> Construct() override {
    auto& in = runtime().Create<ProxyPort>(*this, "in", Port::Direction::kInput, TypeOf<double>());
    auto& out = runtime().Create<ProxyPort>(*this, "out", Port::Direction::kOutput, TypeOf<double>());
    auto& part = runtime().Create<Measured>(*this, "part");
    if (auto tied = Port::Connect(in, part.in); !tied) return tied;
    return Port::Connect(part.out, out);
  }
};

class CompositeTest : public EditorTest {
 protected:
  CompositeTest() {
    (void)TypeOf<double>();
    Register<Passer>("test/passer");
    Register<Boxed>("test/boxed");
    Register<Straight>("test/straight");
    Register<Taker>("test/taker");
    Register<Measured>("test/measured");
    Register<BoxedMeasured>("test/boxed_measured");
  }
  void Make(const std::string& type, const std::string& convert = {}) {
    Must({CreateModule{"/app/counter", "test/counter"}, CreateModule{"/app/m", type},
          CreateModule{"/app/sink", "test/sink"}, ConnectPorts{"/app/counter/out", "/app/m/in", {.queue = 20}},
          ConnectPorts{"/app/m/out", "/app/sink/in", {.queue = 20, .convert = convert}},
          ConnectPorts{"/app/m/out", "/app/sink/side", {.convert = convert}}});
  }
  void Swap(const std::string& type) {
    const auto outcome = history_.Apply({ReplaceModule{"/app/m", type}});
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  }
  void ExpectItRuns() {
    const std::size_t before = At<Sink>("/app/sink").taken.size();
    Steps(6);
    const auto& taken = At<Sink>("/app/sink").taken;
    ASSERT_GE(taken.size(), before + 3);
    EXPECT_GE(taken.back(), At<Counter>("/app/counter").count.value - 3) << "the newest";
    EXPECT_EQ(At<Sink>("/app/sink").side.Get(), taken.back());
    EXPECT_EQ(At<Port>("/app/counter/output/out").outgoing().front().options.queue, 20U);
  }
  ChangeHistory history_{editor};
};

TEST_F(CompositeTest, DataFlowOnAfterEachSwapItsUndoAndItsRedo) {
  for (const char* const first : {"test/passer", "test/boxed", "test/straight"}) {
    Make(first);
    for (const char* const second : {"test/boxed", "test/passer", "test/straight", "test/boxed"}) {
      SCOPED_TRACE(std::string(first) + " -> " + second);
      Swap(second);
      ExpectItRuns();
      EXPECT_TRUE(history_.Undo());
      ExpectItRuns();
      EXPECT_TRUE(history_.Redo());
      ExpectItRuns();
    }
    Must({DeleteElement{"/app/m"}, DeleteElement{"/app/counter"}, DeleteElement{"/app/sink"}});
  }
}

TEST_F(CompositeTest, AnUndoLeavesTheConnectionsOfNow) {
  Make("test/passer");
  Swap("test/boxed");
  Must({CreateModule{"/app/other", "test/sink"}, ConnectPorts{"/app/m/out", "/app/other/in", {.queue = 7}},
        DisconnectPorts{"/app/m/out", "/app/sink/side"}});
  EXPECT_TRUE(history_.Undo());
  EXPECT_EQ(At<Passer>("/app/m").out.outgoing().size(), 2U);
  EXPECT_EQ(At<Sink>("/app/other").in.Sources().front(), &At<Passer>("/app/m").out);
  EXPECT_TRUE(At<Sink>("/app/sink").side.Sources().empty());
}

TEST_F(CompositeTest, WhatIsConnectedToAPartStaysIfTheOtherHasThePart) {
  Make("test/boxed");
  Must({ConnectPorts{"/app/counter/out", "/app/m/part/more"}});
  Swap("test/boxed");
  EXPECT_EQ(At<Passer>("/app/m/part").more.incoming().size(), 1U);
  ExpectItRuns();
  EXPECT_THAT(Refusal({ReplaceModule{"/app/m", "test/straight"}}),
              HasSubstr("/app/m/part/input/more: the new module has no port 'more', which is connected"));
}

TEST_F(CompositeTest, ACycleOfInterfacePortsIsRefused) {
  Make("test/passer");
  Must({ConnectPorts{"/app/m/out", "/app/m/in"}});
  EXPECT_THAT(Refusal({ReplaceModule{"/app/m", "test/straight"}}), HasSubstr("would close a cycle of interface ports"));
  Swap("test/boxed");
  EXPECT_EQ(At<Port>("/app/m/out").outgoing().size(), 3U) << "what leads round it stays";
  EXPECT_THAT(Refusal({ReplaceModule{"/app/m", "test/straight"}}), HasSubstr("would close a cycle of interface ports"));
  Must({DisconnectPorts{"/app/m/out", "/app/sink/in"}, DisconnectPorts{"/app/m/out", "/app/sink/side"}});
  EXPECT_THAT(Refusal({ReplaceModule{"/app/m", "test/taker"}}),
              HasSubstr("/app/m/out: the new module has no port 'out', which is connected"));
  Must({ConnectPorts{"/app/m/out", "/app/sink/in"}, ConnectPorts{"/app/m/out", "/app/sink/side"}});
  Swap("test/passer");
  EXPECT_EQ(At<Passer>("/app/m").out.outgoing().size(), 3U);
  Must({CreateGroup{"/app/g"}, CreatePort{"/app/g/in", Port::Direction::kInput, "int32"},
        CreatePort{"/app/g/out", Port::Direction::kOutput, "int32"}, ConnectPorts{"/app/g/in", "/app/g/out"},
        DisconnectPorts{"/app/m/out", "/app/m/in"}, ConnectPorts{"/app/m/out", "/app/g/in"},
        ConnectPorts{"/app/g/out", "/app/m/in"}});
  EXPECT_THAT(Refusal({ReplaceModule{"/app/m", "test/straight"}}), HasSubstr("would close a cycle of interface ports"));
}

TEST_F(CompositeTest, WhatIsSetAtAPortGoesAlong) {
  Make("test/passer");
  for (const char* const type : {"test/boxed", "test/straight", "test/passer"}) {
    for (const std::string port : {"in", "out"}) {
      auto& before = **PathSearch(At<FrameworkElement>("/app/m"))
                           .FindPort(port, port == "in" ? PathKind::kInput : PathKind::kOutput);
      for (const auto setter : {Port::Setter::kPerson, Port::Setter::kRule}) {
        ASSERT_TRUE(before.PublishByHand(internal::FillWith(AnyValue(int(setter) - 10)), setter));
      }
    }
    Swap(type);
    auto& in = **PathSearch(At<FrameworkElement>("/app/m")).FindPort("in", PathKind::kInput);
    auto& out = **PathSearch(At<FrameworkElement>("/app/m")).FindPort("out", PathKind::kOutput);
    EXPECT_EQ(At<Sink>("/app/sink").side.Get(), -10);
    out.Release();
    EXPECT_EQ(At<Sink>("/app/sink").side.Get(), -9);
    out.Release(Port::Setter::kRule);
    Steps(4);
    EXPECT_EQ(At<Sink>("/app/sink").side.Get(), -10) << "what is set at the input";
    in.Release();
    in.Release(Port::Setter::kRule);
    ExpectItRuns();
  }
}

TEST_F(CompositeTest, ValuesAreConvertedAndWithinTheLimitsOfWhoReadsThem) {
  Make("test/measured", "round");
  for (const char* const type : {"test/boxed_measured", "test/measured", "test/boxed_measured"}) {
    Swap(type);
    Steps(5);
    EXPECT_NEAR(At<Sink>("/app/sink").side.Get(), At<Counter>("/app/counter").count.value, 3);
    EXPECT_TRUE(history_.Undo());
    Steps(5);
    EXPECT_NEAR(At<Sink>("/app/sink").side.Get(), At<Counter>("/app/counter").count.value, 3);
    EXPECT_TRUE(history_.Redo());
  }
  Steps(5);
  At<Counter>("/app/counter").count.value = 200;
  const int last = At<Sink>("/app/sink").side.Get();
  Steps(5);
  EXPECT_NEAR(At<Sink>("/app/sink").side.Get(), last, 3) << "out of the limits";
}

// By which rules, and connections that wait, know it.
TEST_F(CompositeTest, IsFoundByThePathsOfAModule) {
  Make("test/passer");
  const auto found = [&](const char* path) { return *PathSearch(runtime).FindPort(path, PathKind::kElement); };
  Swap("test/boxed");
  for (const char* const path : {"/app/m/in", "/app/m/input/in"}) EXPECT_EQ(found(path), &At<Port>("/app/m/in"));
  Swap("test/passer");
  for (const char* const path : {"/app/m/in", "/app/m/input/in"}) EXPECT_EQ(found(path), &At<Passer>("/app/m").in);
  EXPECT_FALSE(PathSearch(runtime).FindPort("/app/input/m", PathKind::kElement));
}

TEST_F(CompositeTest, HasTheTagsOfThePlaceAndTellsOfLimits) {
  Make("test/measured", "round");
  ASSERT_TRUE(SetTags(At<Port>("/app/m/input/in"), {"fast"}));
  At<Port>("/app/m/input/in").Annotate(std::make_unique<GivenLimits>(InputLimits{.maximum = 3.}));
  const auto swapped = history_.Apply({ReplaceModule{"/app/m", "test/boxed_measured"}});
  ASSERT_TRUE(swapped);
  EXPECT_THAT(swapped.diagnostics.ToString(), HasSubstr("/app/m/input/in: its limits went with it"));
  EXPECT_THAT(TagsOf(At<Port>("/app/m/in")), ElementsAre("fast"));
  ASSERT_TRUE(history_.Undo());
  EXPECT_THAT(TagsOf(At<Port>("/app/m/input/in")), ElementsAre("fast"));
  EXPECT_EQ(At<Port>("/app/m/input/in").limits().maximum, 3.);
}

TEST_F(CompositeTest, HasAnotherNameWithAllItsConnections) {
  Make("test/boxed");
  ASSERT_TRUE(At<Port>("/app/m/in").PublishByHand(internal::FillWith(AnyValue(-3))));
  ASSERT_TRUE(history_.Apply({RenameElement{"/app/m", "n"}}));
  Steps(5);
  EXPECT_EQ(At<Sink>("/app/sink").side.Get(), -3);
  ASSERT_TRUE(history_.Undo());
  At<Port>("/app/m/in").Release();
  ExpectItRuns();
}

// Who is put back closes no cycle either, and what it cannot take over is told.
TEST_F(CompositeTest, IsNotPutBackWhereItWouldCloseACycle) {
  Register<FaultyFilter>("test/faulty_filter");
  Make("test/straight");
  Must({ReplaceModule{"/app/m", "test/faulty_filter"}, ConnectPorts{"/app/m/out", "/app/m/in"}});
  Steps(5);
  EXPECT_EQ(FindModuleType(At<FrameworkElement>("/app/m")), "test/faulty_filter") << "stays, and does not run";
  EXPECT_EQ(At<FaultyFilter>("/app/m").out.outgoing().size(), 3U);
}

// It waits for the place, by whichever of both paths.
TEST_F(CompositeTest, WhatWaitsForAPortThatTheNextOneHasNotIsAskedFor) {
  Make("test/passer");
  {
    const std::lock_guard lock(runtime.structure_mutex());
    ASSERT_TRUE(LateConnections::Of(runtime).Add("//other/m/cmd", "/app/m/in", {}));
  }
  for (const char* const type : {"test/boxed", "test/straight", "test/passer", "test/boxed"}) Swap(type);
  Must({DisconnectPorts{"/app/counter/out", "/app/m/in"}, DisconnectPorts{"/app/m/out", "/app/sink/in"},
        DisconnectPorts{"/app/m/out", "/app/sink/side"}});
  EXPECT_THAT(Refusal({ReplaceModule{"/app/m", "test/counter"}}),
              HasSubstr("/app/m/in: the new module has no port 'in', which is connected"));
  // It is the input that is waited for.
  Swap("test/passer");
  Swap("test/taker");
}

// What was published before the release of a part counts no more, and there is no place for that in the next one.
TEST_F(CompositeTest, APartThatWasReleasedIsNotForgotten) {
  Make("test/boxed_measured", "round");
  auto& in = At<Measured>("/app/m/part").in;
  Must({DisconnectPorts{"/app/counter/out", "/app/m/in"}, CreateModule{"/app/s", "test/measured"},
        ConnectPorts{"/app/s/out", "/app/m/in"}});
  Steps(2);
  ASSERT_TRUE(in.SetDriving(true, AnyValue(0.0), {}, DrivingKind::kVelocity));
  ASSERT_TRUE(in.Block());
  in.Unblock();
  ASSERT_TRUE(in.SetDriving(false, AnyValue(0.0), {}, DrivingKind::kVelocity));
  EXPECT_THAT(Refusal({ReplaceModule{"/app/m", "test/measured"}}),
              HasSubstr("it waits for a value from after its release, and the new module has no such port"));
  Steps(2);
  Swap("test/measured");
}

}  // namespace
}  // namespace runnel::test
