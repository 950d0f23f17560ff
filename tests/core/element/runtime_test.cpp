#include "core/element/runtime.h"

#include <thread>

#include <gmock/gmock.h>

#include "core/lockfree/thread_epoch.h"

namespace runnel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Node : public FrameworkElement {
 public:
  explicit Node(const Placement& placement, std::vector<std::string>* journal = nullptr)
      : FrameworkElement(placement), journal_(journal) {}
  ~Node() override { Note("destroyed"); }

  Result<void> Prepare() override {
    Note("prepared");
    if (fails) return Error{.message = "the device is missing"};
    if (throws) throw std::runtime_error("the file is missing");
    return {};
  }

  bool fails = false;
  bool throws = false;

 private:
  void Note(const std::string& what) {
    if (journal_ != nullptr) journal_->push_back(name() + " " + what);
  }
  std::vector<std::string>* journal_;
};

TEST(RuntimeTest, TwoRuntimesKnowNothingOfEachOther) {
  Runtime first, second;
  Node& here = first.Create<Node>(first.root(), "robot");
  Node& there = second.Create<Node>(second.root(), "robot");
  EXPECT_EQ(here.path(), there.path());
  EXPECT_EQ(&here.runtime(), &first);
  EXPECT_EQ(&there.runtime(), &second);
  ASSERT_TRUE(first.Delete(here));
  EXPECT_EQ(second.root().children().size(), 1u);
}

TEST(RuntimeTest, MakeReadyPreparesParentsFirstAndOnce) {
  std::vector<std::string> journal;
  {
    Runtime runtime;
    Node& a = runtime.Create<Node>(runtime.root(), "a", &journal);
    runtime.Create<Node>(a, "b", &journal);
    ASSERT_TRUE(runtime.MakeReady(runtime.root()));
    ASSERT_TRUE(runtime.MakeReady(runtime.root()));
    EXPECT_EQ(a.life_cycle(), LifeCycle::kReady);
    EXPECT_THAT(journal, ElementsAre("a prepared", "b prepared"));
    journal.clear();
  }
  EXPECT_THAT(journal, ElementsAre("b destroyed", "a destroyed"));
}

TEST(RuntimeTest, OneThatFailsKeepsAllFromBecomingReadyAndIsNamed) {
  Runtime runtime;
  Node& a = runtime.Create<Node>(runtime.root(), "a");
  Node& b = runtime.Create<Node>(a, "b");
  b.fails = true;
  const auto result = runtime.MakeReady(a);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().path, "/a/b");
  EXPECT_THAT(result.error().message, HasSubstr("device is missing"));
  EXPECT_EQ(a.life_cycle(), LifeCycle::kConstructed);
}

TEST(RuntimeTest, ExceptionInPrepareIsAnErrorWithThePath) {
  Runtime runtime;
  Node& a = runtime.Create<Node>(runtime.root(), "a");
  a.throws = true;
  const auto result = runtime.MakeReady(a);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().path, "/a");
  EXPECT_THAT(result.error().message, HasSubstr("file is missing"));
}

TEST(RuntimeTest, DeleteTakesOutTheElementWithAllBelow) {
  std::vector<std::string> journal;
  Runtime runtime;
  Node& a = runtime.Create<Node>(runtime.root(), "a", &journal);
  runtime.Create<Node>(a, "b", &journal);
  ASSERT_TRUE(runtime.Delete(a));
  EXPECT_TRUE(runtime.root().children().empty());
  EXPECT_THAT(journal, ElementsAre("b destroyed", "a destroyed"));
}

TEST(RuntimeTest, TheRootAndPartsOfOtherObjectsCannotBeDeleted) {
  Runtime runtime;
  EXPECT_FALSE(runtime.Delete(runtime.root()));
  Node member({runtime.root(), "member"});
  const auto result = runtime.Delete(member);
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, HasSubstr("part of another element"));
}

TEST(RuntimeTest, DeleteFromWithinACycleIsRefused) {
  Runtime runtime;
  Node& a = runtime.Create<Node>(runtime.root(), "a");
  const EpochGuard cycle;
  const auto result = runtime.Delete(a);
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, HasSubstr("within a cycle"));
}

TEST(RuntimeTest, DeleteWaitsForThreadsThatMayStillSeeTheElement) {
  Runtime runtime;
  Node& a = runtime.Create<Node>(runtime.root(), "a");
  std::atomic<bool> entered{false}, left{false};
  std::thread reader([&] {
    const EpochGuard cycle;
    entered = true;
    while (a.life_cycle() != LifeCycle::kDeleted) std::this_thread::yield();
    EXPECT_EQ(a.name(), "a");  // still whole
    left = true;
  });
  while (!entered) std::this_thread::yield();
  ASSERT_TRUE(runtime.Delete(a));
  EXPECT_TRUE(left);
  reader.join();
}

class Journal final : public ElementListener {
 public:
  std::vector<std::string> events;
  void OnReady(FrameworkElement& element) override { events.push_back("ready " + element.path()); }
  void OnDeleted(FrameworkElement& element) override {
    events.push_back("deleted " + element.path());
  }
};

TEST(RuntimeTest, ListenersAreToldInTheOrderOfTheChangesUntilRemoved) {
  Runtime runtime;
  Journal journal;
  runtime.AddListener(journal);
  Node& a = runtime.Create<Node>(runtime.root(), "a");
  ASSERT_TRUE(runtime.MakeReady(a));
  ASSERT_TRUE(runtime.Delete(a));
  runtime.RemoveListener(journal);
  runtime.Create<Node>(runtime.root(), "b");
  EXPECT_THAT(journal.events, ElementsAre("ready /a", "deleted /a"));
}

TEST(RuntimeTest, NothingCanBeCreatedInWhatIsBeingDeleted) {
  class Stubborn final : public ElementListener {
   public:
    bool refused = false;
    void OnDeleted(FrameworkElement& element) override {
      try {
        element.runtime().Create<Node>(element, "late");
      } catch (const ElementError&) {
        refused = true;
      }
    }
  } stubborn;
  Runtime runtime;
  runtime.AddListener(stubborn);
  ASSERT_TRUE(runtime.Delete(runtime.Create<Node>(runtime.root(), "a")));
  EXPECT_TRUE(stubborn.refused);
}

}  // namespace
}  // namespace runnel
