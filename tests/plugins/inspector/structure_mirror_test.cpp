#include "plugins/inspector/structure_mirror.h"

#include <new>
#include <random>
#include <set>

#include "plugins/testing/fault_injection.h"
#include "tests/plugins/inspector/inspector_fixture.h"

namespace runnel::test {

namespace {

using internal::StructureMirror;

/// What a viewer knows that follows the messages.
struct Followed {
  std::map<std::string, Json> elements;  // by path
  std::multiset<std::string> connections;
  std::uint64_t revision = 0;

  void Follow(const std::string& text) {
    const Json message = Json::parse(text);
    revision = message["revision"];
    if (message["op"] == "structure") {
      elements.clear();
      connections.clear();
      for (const Json& each : message["connections"]) connections.insert(each.dump());
    } else {
      for (const std::string path : message["gone"]) EXPECT_EQ(elements.erase(path), 1U) << path;
      for (const Json& each : message["disconnected"]) {
        const auto found = connections.find(each.dump());
        ASSERT_NE(found, connections.end()) << each.dump();
        connections.erase(found);
      }
      for (const Json& each : message["connected"]) connections.insert(each.dump());
    }
    for (const Json& each : message["elements"]) {
      const std::string path = each["path"];
      const std::string parent = path.substr(0, path.rfind('/'));
      EXPECT_TRUE(parent.empty() || elements.count(parent) == 1) << path << " before its parent";
      elements[path] = each;
    }
  }
};

class StructureMirrorTest : public InspectorTest {
 protected:
  void LookUntilDone() {
    for (int i = 0; i < 10'000 && !mirror.Look(); ++i) {
    }
  }
  StructureMirror mirror{runtime, modules, scheduler, log};
};

TEST_F(StructureMirrorTest, KnowsNothingBeforeItHasLooked) {
  EXPECT_EQ(mirror.revision(), 0U);
  EXPECT_FALSE(mirror.Count());
  LookUntilDone();
  EXPECT_EQ(mirror.revision(), 1U);
  EXPECT_TRUE(mirror.Count());
}

TEST_F(StructureMirrorTest, HasNoNewsWhereNothingHasChanged) {
  LookUntilDone();
  for (int i = 0; i < 100; ++i) LookUntilDone();
  EXPECT_EQ(mirror.revision(), 1U);
  Apply("set /app/a/speed 1");  // as it was
  LookUntilDone();
  EXPECT_EQ(mirror.revision(), 1U);
}

TEST_F(StructureMirrorTest, DoesNotWaitForTheStructure) {
  const std::lock_guard lock(runtime.structure_mutex());
  bool has_looked = true;
  std::thread([&] { has_looked = mirror.Look(); }).join();
  EXPECT_FALSE(has_looked);
}

TEST_F(StructureMirrorTest, TellsOnlyWhatHasChanged) {
  LookUntilDone();
  Apply("set /app/a/speed 5");
  LookUntilDone();
  const std::string* const change = mirror.ChangeTo(2);
  ASSERT_NE(change, nullptr);
  const Json message = Json::parse(*change);
  ASSERT_EQ(message["elements"].size(), 1U);
  EXPECT_EQ(message["elements"][0]["value"], "5");
}

TEST_F(StructureMirrorTest, ForgetsOldChanges) {
  LookUntilDone();
  for (int i = 0; i < 150; ++i) {
    Apply("set /app/a/speed " + std::to_string(i % 2 + 2));
    LookUntilDone();
  }
  EXPECT_EQ(mirror.revision(), 151U);
  EXPECT_EQ(mirror.ChangeTo(51), nullptr);
  EXPECT_NE(mirror.ChangeTo(52), nullptr);
  EXPECT_NE(mirror.ChangeTo(151), nullptr);
  EXPECT_EQ(mirror.ChangeTo(152), nullptr);
}

TEST_F(StructureMirrorTest, TellsOfThreadsThatModulesAreMovedTo) {
  LookUntilDone();
  CreateThread(runtime, "second", {.period = 2ms});
  Apply("move /app/b to second");
  LookUntilDone();
  Followed viewer;
  viewer.Follow(mirror.Whole());
  EXPECT_EQ(viewer.elements["/app/b"]["thread"], "second");
  EXPECT_EQ(viewer.elements["/app/a"]["thread"], "main");
}

// The output itself and its connections stay as they were.
TEST_F(StructureMirrorTest, TellsThatSomethingMovesByAnOutputOnceWhatItFeedsDrives) {
  Apply("create group /app/drive");
  Apply("create /app/drive/motor test/sink");
  Apply("create port /app/drive/speed input int32");
  Apply("connect /app/a/out /app/drive/speed");
  Apply("connect /app/drive/speed /app/drive/motor/in");
  const auto told = [&] {
    LookUntilDone();
    Followed viewer;
    viewer.Follow(mirror.Whole());
    return viewer.elements["/app/a/output/out"]["moves"] == true;
  };
  EXPECT_FALSE(told());
  {
    const std::lock_guard lock(runtime.structure_mutex());
    ASSERT_TRUE(PortAt("/app/drive/motor/input/in").SetDriving(true, AnyValue(0), {}, DrivingKind::kEffort));
  }
  EXPECT_TRUE(told());
}

TEST_F(StructureMirrorTest, WhoFollowsTheChangesKnowsTheWhole) {
  std::mt19937 random(11);
  const auto below = [&](int end) { return std::uniform_int_distribution<>(0, end - 1)(random); };
  const auto name = [&] { return "/app/m" + std::to_string(below(6)); };
  LookUntilDone();
  Followed viewer;
  viewer.Follow(mirror.Whole());
  int done = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::vector<std::string> all{"create " + name() + " test/counter",
                                       "create " + name() + " test/sink",
                                       "create group " + name(),
                                       "create " + name() + "/inner test/counter",
                                       "create port " + name() + "/p input int",
                                       "delete " + name(),
                                       "connect " + name() + "/out " + name() + "/in queue=2",
                                       "disconnect " + name() + "/out " + name() + "/in",
                                       "connect " + name() + "/out " + name() + "/p",
                                       "connect /app/a/out " + name() + "/in",
                                       "replace " + name() + " with test/fast_counter",
                                       "set " + name() + "/speed " + std::to_string(below(9)),
                                       "delete " + name() + "; create " + name() + " test/sink"};
    Diagnostics diagnostics;
    const auto placed =
        ParseChanges(all[static_cast<std::size_t>(below(static_cast<int>(all.size())))], {}, diagnostics);
    done += editor.Apply(placed.changes) ? 1 : 0;
    if (below(3) == 0) continue;  // several in one look
    LookUntilDone();
    while (viewer.revision < mirror.revision()) {
      const std::string* const change = mirror.ChangeTo(viewer.revision + 1);
      ASSERT_NE(change, nullptr);
      ASSERT_NO_FATAL_FAILURE(viewer.Follow(*change));
    }
    Followed whole;
    whole.Follow(mirror.Whole());
    ASSERT_EQ(viewer.elements, whole.elements) << "after " << i;
    ASSERT_EQ(viewer.connections, whole.connections) << "after " << i;
  }
  EXPECT_GT(done, 300);
}

TEST_F(StructureMirrorTest, WhereverMemoryEndsItKnowsTheWholeAfterwards) {
  LookUntilDone();
  Followed viewer;
  viewer.Follow(mirror.Whole());
  // Something to look at: new, gone, connected.
  int number = 0;
  const auto change = [&] {
    const std::string last = "/app/n" + std::to_string((number + 1) % 2);
    const std::string next = "/app/n" + std::to_string(number % 2);
    Apply((number++ > 0 ? "delete " + last + "; " : "") + "create " + next + " test/sink; connect /app/a/out " + next +
          "/in");
  };
  change();
  const auto points = AtEachPoint(
      InjectedFault::kAllocation,
      [&] {
        try {
          LookUntilDone();
        } catch (const std::bad_alloc&) {
        }
      },
      [&](bool) {
        LookUntilDone();
        while (viewer.revision < mirror.revision()) {
          const std::string* const news = mirror.ChangeTo(viewer.revision + 1);
          viewer.Follow(news != nullptr ? *news : mirror.Whole());
        }
        std::set<std::string> there;
        runtime.root().Visit([&](FrameworkElement& each) {
          if (each.parent() != nullptr) there.insert(each.path());
        });
        std::set<std::string> told;
        for (const auto& [path, element] : viewer.elements) told.insert(path);
        ASSERT_EQ(told, there);
        ASSERT_TRUE(mirror.Count());
        change();
      });
  EXPECT_GT(points, 50u);
}

}  // namespace

}  // namespace runnel::test
