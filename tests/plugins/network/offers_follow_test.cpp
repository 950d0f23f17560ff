// What is offered while files say it twice, and names change.
#include <chrono>
#include <thread>

#include <gmock/gmock.h>

#include "plugins/network/xml_network_words.h"
#include "plugins/services/service.h"
#include "plugins/structure/change.h"
#include "tests/plugins/network/network_member.h"

namespace runnel::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

class OffersFollow : public testing::Test {
 protected:
  void SetOffer(const std::string& port) {
    const std::lock_guard lock(a_.runtime.structure_mutex());
    a_.network->set_offers({{.port = port, .topic = "/map", .quality = ValueQuality::kLatched}});
  }

  const std::shared_ptr<WireEngine> engine_ = MakeFakeWire();
  Member a_{*engine_, "a"};
};

TEST_F(OffersFollow, WhatIsSaidOfOnePortCountsMoreThanAPattern) {
  a_.Offer({.patterns = {"module/*"}});
  a_.Offer({.port = "/application/module/place", .quality = ValueQuality::kLatched});
  a_.Begin();
  EXPECT_THAT(a_.Text(), ContainsRegex("as /a/module/place  [^\n]*latched"));
  EXPECT_THAT(a_.Text(), ContainsRegex("as /a/module/row  [^\n]*reliable, newest 1"));
}

// A swap lets it come back under its path; a new name does not.
TEST_F(OffersFollow, OfANameOfBeforeNothingIsOffered) {
  a_.Offer({.port = "/application/module/place", .topic = "/map", .quality = ValueQuality::kLatched});
  a_.Begin();
  const std::string before = "offers /application/module/output/place as /map";
  ASSERT_TRUE(a_.runtime.Delete(a_.module));
  auto& eyes = a_.runtime.Create<Module1>(a_.group, "eyes");
  ASSERT_TRUE(a_.runtime.MakeReady(eyes));
  EXPECT_THAT(a_.Text(), HasSubstr(before));
  SetOffer("/application/eyes/output/place");
  WaitUntil("it is offered by its new name",
            [&] { return a_.Text().find("offers /application/eyes/output/place as /map") != std::string::npos; });
  WaitUntil("it is no more by the one of before", [&] { return a_.Text().find(before) == std::string::npos; });
}

// A pattern fits the name of before as well.
TEST_F(OffersFollow, WhatAPatternOffersHasItsNewNameOnly) {
  a_.Offer({.patterns = {"**"}});
  AddNetworkChanges(a_.runtime);
  a_.Begin();
  EXPECT_THAT(a_.Text(), HasSubstr("as /a/module/place"));
  ASSERT_TRUE(a_.runtime.Delete(a_.module));  // as who is renamed: it is made anew
  ASSERT_TRUE(a_.runtime.MakeReady(a_.runtime.Create<Module1>(a_.group, "eyes")));
  {
    const std::lock_guard lock(a_.runtime.structure_mutex());
    const auto* const changes = a_.runtime.root().FindAnnotation<ExtensionChanges>();
    ASSERT_NE(changes, nullptr);
    ASSERT_TRUE(changes->rename("/application/module", "/application/eyes").apply());
  }
  WaitUntil("it is offered by its new name", [&] { return a_.Text().find("as /a/eyes/place") != std::string::npos; });
  WaitUntil("it is no more by the one of before",
            [&] { return a_.Text().find("as /a/module/place") == std::string::npos; });
}

class Arm final : public Module {
 public:
  using Module::Module;
  Service<int()> count{this, "count", [](Arm&) { return 1; }};

 private:
  void Update() override {}
};

// Whoever gets the name of before is not called in its place.
TEST_F(OffersFollow, AServiceHasItsNewName) {
  const auto make = [&](const char* name) -> Arm& {
    auto& made = a_.runtime.Create<Arm>(a_.group, name);
    EXPECT_TRUE(a_.runtime.MakeReady(made));
    return made;
  };
  const auto is_offered = [&](const std::string& arm) {
    return a_.Text().find("offers the service /application/" + arm + "/output/count as /count  runnel_msgs") !=
           std::string::npos;
  };
  Arm& arm = make("arm");
  AddNetworkChanges(a_.runtime);
  a_.Begin();
  {
    const std::lock_guard lock(a_.runtime.structure_mutex());
    a_.network->AddServiceOffer({.port = "/application/arm/output/count", .service = "/count"});
    a_.network->AddServiceOffer({.port = "/application/arm_2/output/count", .service = "/other"});
  }
  WaitUntil("it is offered", [&] { return is_offered("arm"); });
  ASSERT_TRUE(a_.runtime.Delete(arm));  // as who is renamed: it is made anew
  Arm& renamed = make("arm_of_before");
  ExtensionStep step;
  {
    const std::lock_guard lock(a_.runtime.structure_mutex());
    const auto* const changes = a_.runtime.root().FindAnnotation<ExtensionChanges>();
    ASSERT_NE(changes, nullptr);
    step = changes->rename("/application/arm", "/application/arm_of_before");
    ASSERT_TRUE(step.apply());
  }
  make("arm");
  WaitUntil("it is offered by its new name", [&] { return is_offered("arm_of_before"); });
  EXPECT_FALSE(is_offered("arm"));
  EXPECT_EQ(a_.network->options().services[1].port, "/application/arm_2/output/count");
  {
    const std::lock_guard lock(a_.runtime.structure_mutex());
    step.undo();
  }
  ASSERT_TRUE(a_.runtime.Delete(renamed));
  WaitUntil("it is offered by the one of before again", [&] { return is_offered("arm"); });
}

// A renaming that is taken back leaves all as it was, also what is offered of something that has gone. If it is not just that
// any more, what has the name goes along.
TEST_F(OffersFollow, ARenamingIsTakenBack) {
  AddNetworkChanges(a_.runtime);
  a_.Begin();
  const std::lock_guard lock(a_.runtime.structure_mutex());
  const auto rename = [&](const std::string& from, const std::string& to) {
    ASSERT_TRUE(a_.runtime.root()
                    .FindAnnotation<ExtensionChanges>()
                    ->rename("/application/" + from, "/application/" + to)
                    .apply());
  };
  const auto ports = [&] {
    std::vector<std::string> all;
    for (const OfferOptions& each : a_.network->options().offers) all.push_back(each.port);
    return all;
  };
  a_.network->AddServiceOffer({.port = "/application/left/count", .service = "/count"});
  a_.network->set_offers({{.port = "/application/left/scan"}, {.port = "/application/right/scan"}});
  rename("right", "left");
  rename("left", "middle");
  EXPECT_EQ(ports(), (std::vector<std::string>{"/application/middle/scan", "/application/middle/scan"}));
  rename("middle", "left");
  rename("left", "right");
  EXPECT_EQ(ports(), (std::vector<std::string>{"/application/left/scan", "/application/right/scan"}));
  EXPECT_EQ(a_.network->options().services[0].port, "/application/left/count");
  rename("right", "left");
  a_.network->set_offers({{.port = "/application/left/scan"}, {.port = "/application/left/state"}});
  rename("left", "right");
  EXPECT_EQ(ports(), (std::vector<std::string>{"/application/right/scan", "/application/right/state"}));
}

TEST_F(OffersFollow, OfEachValueTheNewestIsSentWhereTheRateIsBounded) {
  Member b(*engine_, "b");
  a_.Offer({.port = "/application/module/place", .topic = "/slow", .quality = ValueQuality::kEach, .rate = 2});
  b.Take({.topic = "/slow"}, b.module.goal);
  a_.Begin();
  b.Begin();
  WaitUntil("it is read", [&] { return IsConnected(a_.module.place); });
  a_.module.place.Publish({1, 0});
  WaitUntil("the first has come", [&] { return b.module.goal.Get().x == 1; });
  for (int i = 2; i <= 5; ++i) a_.module.place.Publish({1.0 * i, 0});
  WaitUntil("the last has come", [&] { return b.module.goal.Get().x == 5; });
}

TEST(OfferWordsTest, AStrengthBeyondThoseOfTheWireIsAMistake) {
  const auto with = [](const std::string& strength) {
    return OfferSaid([&](const char* name) { return std::string(name) == "strength" ? strength : ""; });
  };
  EXPECT_EQ(with("2147483647").strength, 2147483647);
  EXPECT_FALSE(WhatIsWrong(with("2147483647")));
  EXPECT_FALSE(WhatIsWrong(with("")));
  const auto wrong = WhatIsWrong(with("3000000000"));
  ASSERT_TRUE(wrong);
  EXPECT_THAT(wrong->message, HasSubstr("from 0 to 2147483647"));
}

// Its endpoints go while somebody looks at them.
TEST_F(OffersFollow, AServiceComesAndGoesWhileItIsShown) {
  a_.Begin();
  {
    const std::lock_guard lock(a_.runtime.structure_mutex());
    a_.network->AddServiceOffer({.port = "/application/arm/output/count", .service = "/arm/count_of_what_it_holds"});
  }
  std::jthread shows([this](const std::stop_token& end) {
    while (!end.stop_requested()) (void)a_.Text();
  });
  for (int i = 0; i < 200; ++i) {
    auto& arm = a_.runtime.Create<Arm>(a_.group, "arm");
    ASSERT_TRUE(a_.runtime.MakeReady(arm));
    std::this_thread::sleep_for(std::chrono::microseconds(300));
    ASSERT_TRUE(a_.runtime.Delete(arm));
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
}

}  // namespace
}  // namespace runnel::test
