#include "core/element/runtime.h"

#include <atomic>
#include <mutex>
#include <thread>

#include <gmock/gmock.h>

#include "core/lockfree/thread_epoch.h"
#include "tests/support/wait_until.h"

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
    const auto is_deleted = [&] {
      const std::lock_guard lock(runtime.structure_mutex());
      return a.life_cycle() == LifeCycle::kDeleted;
    };
    test::WaitUntil("the element is marked as deleted", is_deleted);
    EXPECT_EQ(a.name(), "a");  // still whole
    left = true;
  });
  test::WaitUntil("the reader has entered", [&] { return entered.load(); });
  ASSERT_TRUE(runtime.Delete(a));
  EXPECT_TRUE(left);
  reader.join();
}

TEST(RuntimeTest, ExceptionOfUnknownTypeInPrepareIsAnErrorToo) {
  class Odd final : public FrameworkElement {
   public:
    explicit Odd(const Placement& placement) : FrameworkElement(placement) {}
    Result<void> Prepare() override { throw 7; }
  };
  Runtime runtime;
  const auto result = runtime.MakeReady(runtime.Create<Odd>(runtime.root(), "odd"));
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().path, "/odd");
  EXPECT_THAT(result.error().message, HasSubstr("exception of type int"));
}

TEST(RuntimeTest, OneThatThrowsInItsConstructorLeavesNothingBehind) {
  class Broken final : public FrameworkElement {
   public:
    explicit Broken(const Placement& placement) : FrameworkElement(placement) { throw std::runtime_error("broken"); }
  };
  Runtime runtime;
  EXPECT_THROW(runtime.Create<Broken>(runtime.root(), "broken"), std::runtime_error);
  EXPECT_TRUE(runtime.root().children().empty());
  EXPECT_NO_THROW(runtime.Create<Node>(runtime.root(), "broken"));
}

// Looks at a member, so that a half destroyed element would be seen.
class Whole final : public FrameworkElement {
 public:
  explicit Whole(const Placement& placement) : FrameworkElement(placement) {}
  ~Whole() override { whole = false; }
  std::atomic<bool> whole{true};
};

TEST(RuntimeTest, WhoVisitsTheTreeNeverMeetsAnElementThatIsBeingDestroyed) {
  Runtime runtime;
  std::atomic<bool> stop{false};
  std::atomic<int> halves{0}, visits{0};
  std::thread viewer([&] {
    while (!stop) {
      const std::lock_guard lock(runtime.structure_mutex());
      runtime.root().Visit([&](FrameworkElement& element) {
        const auto* whole = dynamic_cast<const Whole*>(&element);
        if (element.parent() != nullptr && (whole == nullptr || !whole->whole)) ++halves;
      });
      ++visits;
    }
  });
  for (int i = 0; i < 300 || visits < 20; ++i) {
    Whole& outer = runtime.Create<Whole>(runtime.root(), "outer");
    runtime.Create<Whole>(outer, "inner");
    ASSERT_TRUE(runtime.Delete(outer));
  }
  stop = true;
  viewer.join();
  EXPECT_EQ(halves, 0);
}

TEST(RuntimeTest, ChildMayStillBeLeavingWhenItsParentIsDeleted) {
  Runtime runtime;
  Node& a = runtime.Create<Node>(runtime.root(), "a");
  Node& b = runtime.Create<Node>(a, "b");
  std::atomic<bool> reading{false}, looked{false}, deleted{false};
  std::thread reader([&] {
    const EpochGuard guard;
    reading = true;
    test::WaitUntil("the child is out of the tree", [&] { return looked.load(); });
    EXPECT_FALSE(deleted);
    EXPECT_EQ(b.path(), "/a/b");
  });
  test::WaitUntil("the reader has entered", [&] { return reading.load(); });
  std::thread child([&] {
    EXPECT_TRUE(runtime.Delete(b));  // waits for the reader
    deleted = true;
  });
  test::WaitUntil("the child leaves its parent", [&] {
    const std::lock_guard lock(runtime.structure_mutex());
    return a.children().empty();
  });
  looked = true;
  EXPECT_TRUE(runtime.Delete(a));
  reader.join();
  child.join();
}

TEST(RuntimeTest, ListenersCannotDelete) {
  class Twice final : public ElementListener {
   public:
    std::string answer;
    void OnDeleted(FrameworkElement& element) override {
      const auto again = element.runtime().Delete(element);
      answer = again ? "deleted" : again.error().message;
    }
  } twice;
  Runtime runtime;
  runtime.AddListener(twice);
  ASSERT_TRUE(runtime.Delete(runtime.Create<Node>(runtime.root(), "a")));
  EXPECT_THAT(twice.answer, HasSubstr("cannot be deleted under the structure lock"));
}

TEST(RuntimeTest, WhatIsBeingDeletedCannotBeDeletedAgain) {
  Runtime runtime;
  auto& a = runtime.Create<Node>(runtime.root(), "a");
  std::atomic<bool> is_in_cycle{false}, may_end{false};
  std::thread cycle([&] {
    const EpochGuard guard;
    is_in_cycle = true;
    test::WaitUntil("the cycle may end", [&] { return may_end.load(); });
  });
  test::WaitUntil("the cycle has begun", [&] { return is_in_cycle.load(); });
  std::thread deleting([&] { EXPECT_TRUE(runtime.Delete(a)); });  // waits for the cycle
  const auto is_listed = [&] {
    const std::lock_guard lock(runtime.structure_mutex());
    return runtime.root().FindChild("a") != nullptr;
  };
  test::WaitUntil("the element is out of the tree", [&] { return !is_listed(); });
  EXPECT_THAT(runtime.Delete(a).error().message, HasSubstr("being deleted already"));
  may_end = true;
  deleting.join();
  cycle.join();
}

class Journal final : public ElementListener {
 public:
  explicit Journal(std::string prefix = "") : prefix_(std::move(prefix)) {}
  std::vector<std::string> events;
  void OnReady(FrameworkElement& element) override { Note("ready ", element); }
  void OnDeleted(FrameworkElement& element) override { Note("deleted ", element); }
  std::vector<std::string>* shared = nullptr;

 private:
  void Note(const std::string& what, const FrameworkElement& element) {
    (shared != nullptr ? *shared : events).push_back(prefix_ + what + element.path());
  }
  std::string prefix_;
};

TEST(RuntimeTest, ListenersAreToldInTheOrderInWhichTheyCame) {
  std::vector<std::string> all;
  Journal first("first "), second("second ");
  Runtime runtime;
  first.shared = second.shared = &all;
  runtime.AddListener(first);
  runtime.AddListener(second);
  ASSERT_TRUE(runtime.MakeReady(runtime.Create<Node>(runtime.root(), "a")));
  EXPECT_THAT(all, ElementsAre("first ready /a", "second ready /a"));
}

TEST(RuntimeTest, ListenersAreToldNothingOfWhatDidNotBecomeReady) {
  Journal journal;
  Runtime runtime;
  runtime.AddListener(journal);
  Node& a = runtime.Create<Node>(runtime.root(), "a");
  a.fails = true;
  ASSERT_FALSE(runtime.MakeReady(a));
  EXPECT_TRUE(journal.events.empty());
}

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
