#include "core/element/unlisted_element.h"

#include <gmock/gmock.h>

#include "core/element/runtime.h"

namespace runnel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class UnlistedNode : public FrameworkElement {
 public:
  explicit UnlistedNode(const Placement& placement, std::vector<std::string>* journal = nullptr)
      : FrameworkElement(placement), journal_(journal) {}
  ~UnlistedNode() override { Note("destroyed"); }
  bool fails = false;

 private:
  Result<void> Prepare() override {
    Note("prepared");
    if (fails) return Error{.message = "has no device"};
    return {};
  }
  void Detach() noexcept override { Note("detached"); }
  void Note(const std::string& what) {
    if (journal_ != nullptr) journal_->push_back(name() + " " + what);
  }
  std::vector<std::string>* journal_;
};

class EventJournal final : public ElementListener {
 public:
  std::vector<std::string> events;
  void OnReady(FrameworkElement& element) override { events.push_back("ready " + element.path()); }
  void OnDeleted(FrameworkElement& element) override { events.push_back("deleted " + element.path()); }
};

class UnlistedElementTest : public testing::Test {
 protected:
  UnlistedElementTest() { runtime.AddListener(listener); }
  ~UnlistedElementTest() override { runtime.RemoveListener(listener); }
  UnlistedElement Make(const std::string& name) {
    return UnlistedElement(std::make_unique<UnlistedNode>(Placement{runtime.root(), name, false}, &journal));
  }
  std::vector<std::string> Names() {
    std::vector<std::string> names;
    for (const auto* each : runtime.root().children()) names.push_back(each->name());
    return names;
  }

  std::vector<std::string> journal;
  EventJournal listener;
  Runtime runtime;
};

TEST_F(UnlistedElementTest, IsFoundOnlyWhenItIsListed) {
  UnlistedElement made = Make("a");
  runtime.Create<UnlistedNode>(*made, "b", &journal);
  EXPECT_EQ(made->path(), "/a");
  EXPECT_EQ(runtime.root().FindChild("a"), nullptr);
  ASSERT_TRUE(Runtime::Prepare(made));
  EXPECT_THAT(journal, ElementsAre("a prepared", "b prepared"));
  EXPECT_THAT(listener.events, ElementsAre());
  ASSERT_TRUE(runtime.List(std::move(made)));
  EXPECT_TRUE(runtime.root().Find("/a/b"));
  EXPECT_THAT(listener.events, ElementsAre("ready /a"));
}

TEST_F(UnlistedElementTest, GoesWithoutATraceIfItIsNeverListed) {
  {
    UnlistedElement made = Make("a");
    runtime.Create<UnlistedNode>(*made, "b", &journal);
    runtime.Create<UnlistedNode>(*made, "c", &journal);
  }
  EXPECT_THAT(journal, ElementsAre("c destroyed", "b destroyed", "a destroyed"));
  EXPECT_THAT(Names(), ElementsAre());
  EXPECT_THAT(listener.events, ElementsAre());
}

TEST_F(UnlistedElementTest, TakesThePlaceItIsGivenAmongItsSiblings) {
  runtime.Create<UnlistedNode>(runtime.root(), "a");
  auto& c = runtime.Create<UnlistedNode>(runtime.root(), "c");
  ASSERT_TRUE(runtime.List(Make("b"), &c));
  ASSERT_TRUE(runtime.List(Make("d")));
  EXPECT_THAT(Names(), ElementsAre("a", "b", "c", "d"));
}

TEST_F(UnlistedElementTest, StaysWithItsOwnerIfItsNameIsTaken) {
  runtime.Create<UnlistedNode>(runtime.root(), "a");
  UnlistedElement made = Make("a");
  const auto listed = runtime.List(std::move(made));
  ASSERT_FALSE(listed);
  EXPECT_THAT(listed.error().message, HasSubstr("already an element called 'a'"));
  EXPECT_TRUE(made);
  EXPECT_THAT(Names(), ElementsAre("a"));
}

TEST_F(UnlistedElementTest, IsNotReadyIfItCouldNotBePrepared) {
  UnlistedElement made = Make("a");
  static_cast<UnlistedNode&>(*made).fails = true;
  EXPECT_EQ(Runtime::Prepare(made).error().path, "/a");
  EXPECT_EQ(made->life_cycle(), LifeCycle::kConstructed);
  static_cast<UnlistedNode&>(*made).fails = false;
  EXPECT_TRUE(Runtime::Prepare(made));
}

TEST_F(UnlistedElementTest, ComesBackAsItWentAway) {
  auto& a = runtime.Create<UnlistedNode>(runtime.root(), "a", &journal);
  runtime.Create<UnlistedNode>(a, "b", &journal);
  ASSERT_TRUE(runtime.MakeReady(runtime.root()));
  journal.clear();
  listener.events.clear();
  auto taken = runtime.Unlist(a);
  ASSERT_TRUE(taken);
  EXPECT_EQ(a.life_cycle(), LifeCycle::kDeleted);
  EXPECT_FALSE(runtime.root().Find("/a"));
  EXPECT_FALSE(runtime.Unlist(a));
  ASSERT_TRUE(runtime.List(std::move(*taken)));
  EXPECT_EQ(a.life_cycle(), LifeCycle::kReady);
  EXPECT_TRUE(runtime.root().Find("/a/b"));
  EXPECT_THAT(journal, ElementsAre());
  EXPECT_THAT(listener.events, ElementsAre("deleted /a", "ready /a"));
}

TEST_F(UnlistedElementTest, IsDetachedAndDestroyedInOneGo) {
  auto& a = runtime.Create<UnlistedNode>(runtime.root(), "a", &journal);
  auto& b = runtime.Create<UnlistedNode>(runtime.root(), "b", &journal);
  std::vector<UnlistedElement> taken;
  taken.push_back(std::move(*runtime.Unlist(a)));
  taken.push_back(std::move(*runtime.Unlist(b)));
  runtime.Destroy(std::move(taken));
  EXPECT_THAT(journal, ElementsAre("a detached", "b detached", "b destroyed", "a destroyed"));
}

TEST_F(UnlistedElementTest, TheRootAndPartsOfOthersStayWhereTheyAre) {
  EXPECT_FALSE(runtime.Unlist(runtime.root()));
  struct Whole final : UnlistedNode {
    using UnlistedNode::UnlistedNode;
    UnlistedNode part{{*this, "part"}};
  };
  auto& whole = runtime.Create<Whole>(runtime.root(), "whole");
  EXPECT_THAT(runtime.Unlist(whole.part).error().hint, HasSubstr("delete /whole"));
}

}  // namespace
}  // namespace runnel
