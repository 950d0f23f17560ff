// Structure that code makes: composites, and what modules ask for while they run.

#include <gmock/gmock.h>

#include "core/module/group.h"
#include "core/module/group_parameter.h"
#include "core/port/proxy_port.h"
#include "plugins/structure/structure_request.h"
#include "plugins/testing/guards.h"
#include "tests/plugins/application/counting_modules.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;

/// Adds its step to what comes.
class Stair final : public Module {
 public:
  using Module::Module;
  Input<double> in{this, "in"};
  Output<double> out{this, "out"};
  Parameter<double> step{this, "step", {.default_value = 1}};

 private:
  void Update() override { out.Publish(in.Get() + step.Get()); }
};

/// As many stairs in a row as its parameter says, behind an interface.
class Staircase final : public Group {
 public:
  using Group::Group;

  StaticParameter<std::uint32_t> stairs{this, "stairs", {.default_value = 2, .bounds = {1, 9}}};
  ProxyPort in{{*this, "in"}, Port::Direction::kInput, TypeOf<double>()};
  ProxyPort out{{*this, "out"}, Port::Direction::kOutput, TypeOf<double>()};
  GroupParameter height{{*this, "height"}};

 private:
  Result<void> Construct() override {
    Port* last = &in;
    for (std::uint32_t i = 1; i <= stairs.Get(); ++i) {
      const std::string name = "stair" + std::to_string(i);
      auto& stair = runtime().Create<Stair>(*this, name);
      if (auto connected = Port::Connect(*last, stair.in); !connected) return connected;
      last = &stair.out;
      height.Add(name + "/step");
    }
    return Port::Connect(*last, out);
  }
};

/// Asks for what its parameter says, once.
class Finder final : public Module {
 public:
  using Module::Module;
  Parameter<std::string> wish{this, "wish"};
  StructureRequest request{this};
  int asked = 0;
  std::string answer;

 private:
  void Update() override {
    if (const auto* const answered = request.answer()) {
      answer = *answered ? "done" : answered->error().message;
    }
    if (!wish.HasChanged() || wish.Get()->empty()) return;
    const AllocationGuard guard;
    asked += request.Ask(*wish.Get()) ? 1 : 0;
    allocations += guard.allocations();
  }

 public:
  std::size_t allocations = 0;
};

LoadedApplication Load(std::string_view text) {
  return Application::LoadFrom([&](const BuildTools& tools) {
    AddCountingTypes(tools.plugins);
    AddType<Staircase>(tools.plugins, "counting/staircase");
    AddType<Finder>(tools.plugins, "counting/finder");
    const auto document = XmlDocument::Parse(text, "made.xml");
    if (document) return BuildApplication(*document, "", tools, BuildMode::kConstruct);
    BuildOutcome failed;
    failed.diagnostics.Add(document.error());
    return failed;
  });
}

constexpr const char* kStaircase = R"(<application name="counting">
  <clock type="simulated" speed="0"/> <thread name="main" period="10ms"/>
  <module name="source" type="counting/source"/>
  <module name="stairs" type="counting/staircase">
    <parameter name="stairs" value="3"/> <parameter name="height" value="10"/>
  </module>
  <module name="judge" type="counting/judge"/>
  <connect from="source/count" to="stairs/in"/> <connect from="stairs/out" to="judge/in"/>
</application>)";

class Composite : public ::testing::Test {
 protected:
  Composite() : application_(Load(kStaircase)) {
    if (!application_) throw std::runtime_error(application_.diagnostics().ToString());
  }
  void Undo() {
    const auto undone = application_->Undo();
    ASSERT_TRUE(undone) << undone.diagnostics.ToString();
  }
  double Out() { return application_->Read<double>("/judge/out").value().value_or(0); }
  LoadedApplication application_;
};

TEST_F(Composite, IsAModuleOfAFile) {
  ASSERT_TRUE(application_->RunCycles(5));
  EXPECT_EQ(Out(), -(5 + 3 * 10));
}

TEST_F(Composite, HasParametersForWhatIsWithin) {
  ASSERT_TRUE(application_->Set("/stairs/height", "2"));
  ASSERT_TRUE(application_->RunCycles(1));
  EXPECT_EQ(Out(), -(1 + 3 * 2));
  EXPECT_EQ(application_->Get("/stairs/height").value(), "2");
}

TEST_F(Composite, IsMadeAnewByItsStaticParameterWithItsConnections) {
  ASSERT_TRUE(application_->RunCycles(1));
  ASSERT_TRUE(application_->Set("/stairs/stairs", "5"));
  ASSERT_TRUE(application_->RunCycles(1));
  EXPECT_EQ(Out(), -(2 + 5 * 10));
  Undo();
  ASSERT_TRUE(application_->RunCycles(1));
  EXPECT_EQ(Out(), -(3 + 3 * 10));
}

TEST_F(Composite, WhatIsSetAtItsPortsGoesAlongAndWhatHoldsAPartIsNotLost) {
  const auto port = [&](const char* path) { return application_->Find<Port>(path).value(); };
  ASSERT_TRUE(
      port("/stairs/in")->SetDriving(true, {TypeOf<double>(), std::make_shared<double>(0)}, {}, DrivingKind::kEffort));
  ASSERT_TRUE(
      port("/stairs/out")->SetDriving(true, {TypeOf<double>(), std::make_shared<double>(0)}, {}, DrivingKind::kEffort));
  ASSERT_TRUE(port("/stairs/out")->Block());
  ASSERT_TRUE(application_->PublishByHand("/stairs/stair3/in", "7"));
  const auto is_kept = [&] {
    const std::lock_guard lock(application_->runtime().structure_mutex());
    return port("/stairs/in")->is_driving() && port("/stairs/out")->is_driving() && port("/stairs/out")->is_blocked();
  };
  const auto is_set = [&] {
    const std::lock_guard lock(application_->runtime().structure_mutex());
    const auto value = port("/stairs/stair3/in")->ValueByHand();
    return value && *static_cast<const double*>(value->value.get()) == 7;
  };
  ASSERT_TRUE(application_->RunCycles(1));
  EXPECT_EQ(Out(), 0);
  const auto set = [&](const char* stairs) {
    const auto changed = application_->Apply({SetParameter{"/stairs/stairs", stairs}});
    EXPECT_TRUE(changed) << changed.diagnostics.ToString();
    return changed.diagnostics.ToString();
  };
  EXPECT_EQ(set("5"), "");
  EXPECT_TRUE(is_kept());
  EXPECT_TRUE(is_set());
  ASSERT_TRUE(application_->RunCycles(1));
  EXPECT_EQ(Out(), 0) << "still blocked";
  for (const auto& refused :
       {application_->Apply({SetParameter{"/stairs/stairs", "1"}}), application_->Swap("/stairs", "counting/filter")}) {
    EXPECT_THAT(
        refused.diagnostics.ToString(),
        HasSubstr("/stairs/stair3/input/in: it is held, and the new module has no such port; release it first"));
    EXPECT_TRUE(is_kept());
    EXPECT_TRUE(is_set());
  }
  ASSERT_TRUE(application_->Release("/stairs/stair3/in"));
  EXPECT_EQ(set("1"), "");
  EXPECT_TRUE(is_kept());
  Undo();
  EXPECT_TRUE(is_kept());
  EXPECT_THAT(application_->Swap("/stairs", "counting/filter").diagnostics.ToString(),
              HasSubstr("moves nothing, or not in the same way"));
  EXPECT_TRUE(is_kept());
}

TEST_F(Composite, MakesRoomForAModuleAndComesBack) {
  const auto swapped = application_->Swap("/stairs", "counting/filter");
  ASSERT_TRUE(swapped) << swapped.diagnostics.ToString();
  ASSERT_TRUE(application_->RunCycles(1));
  EXPECT_EQ(Out(), -1001);
  Undo();
  ASSERT_TRUE(application_->RunCycles(1));
  EXPECT_EQ(Out(), -(2 + 3 * 10));
  EXPECT_THAT(application_->Swap("/stairs", "counting/talker").diagnostics.ToString(), HasSubstr("has no port"));
  ASSERT_TRUE(application_->Apply("delete /stairs"));
  Undo();
  ASSERT_TRUE(application_->RunCycles(1));
  EXPECT_EQ(Out(), -(3 + 3 * 10));
}

constexpr const char* kFinder = R"(<application name="counting">
  <clock type="simulated" speed="0"/> <thread name="main" period="10ms"/>
  <module name="finder" type="counting/finder"/>
  <module name="judge" type="counting/judge"/>
</application>)";

class RequestTest : public ::testing::Test {
 protected:
  RequestTest() : application_(Load(kFinder)) {
    if (!application_) throw std::runtime_error(application_.diagnostics().ToString());
  }
  void Wish(const std::string& text) {
    ASSERT_TRUE(application_->Apply({SetParameter{"/finder/wish", text}}));
    ASSERT_TRUE(application_->RunCycles(20));
  }
  Finder& finder() { return **application_->Find<Finder>("/finder"); }
  LoadedApplication application_;
};

TEST_F(RequestTest, IsCarriedOutBetweenCycles) {
  Wish("create /found counting/source factor=3; connect /found/count /judge/in");
  EXPECT_EQ(finder().asked, 1);
  EXPECT_EQ(finder().answer, "done");
  EXPECT_EQ(finder().allocations, 0u);
  const double first = application_->Read<double>("/judge/out").value().value_or(0);
  EXPECT_LT(first, 0);
  EXPECT_THAT(application_->TakeEvents(),
              Contains(Field(&ApplicationEvent::text, HasSubstr("has had it done: create /found"))));
  const LoadedApplication again = Load(kFinder);
  ASSERT_TRUE(again->Apply(
      {SetParameter{"/finder/wish", "create /found counting/source factor=3; connect /found/count /judge/in"}}));
  ASSERT_TRUE(again->RunCycles(20));
  EXPECT_EQ(again->Read<double>("/judge/out").value().value_or(0), first) << "in the same cycle in every run";
}

TEST_F(RequestTest, IsDoneAsAWholeOrNotAtAll) {
  Wish("create /found counting/source; connect /found/cuont /judge/in");
  EXPECT_THAT(finder().answer, HasSubstr("no 'cuont'"));
  EXPECT_FALSE(application_->Find<CountingSource>("/found"));
  Wish("creat /found counting/source");
  EXPECT_THAT(finder().answer, HasSubstr("no change 'creat'"));
  EXPECT_EQ(finder().asked, 2);
}

TEST_F(RequestTest, MayEndWhoHasAsked) {
  Wish("delete /finder");
  EXPECT_FALSE(application_->Find<Finder>("/finder"));
  ASSERT_TRUE(application_->RunCycles(10));
}

TEST_F(RequestTest, TooLongIsNotAskedFor) {
  Wish(std::string(StructureRequest::kLongest + 1, 'x'));
  EXPECT_EQ(finder().asked, 0);
}

}  // namespace
}  // namespace runnel::test
