#include <cstdlib>

#include <gmock/gmock.h>

#include "core/port/proxy_port.h"
#include "plugins/structure/change_history.h"
#include "tests/plugins/structure/random_changes.h"

namespace runnel::test {

namespace {

constexpr const char* kTop = "/app/w";

// All that is there, apart from what modules remember and the order of siblings.
std::string WholeText(Runtime& runtime) {
  const std::lock_guard lock(runtime.structure_mutex());
  std::set<std::string> lines;
  (*runtime.root().Find(kTop))->Visit([&](FrameworkElement& each) {
    std::string line = each.path() + " " + std::to_string(static_cast<int>(each.kind())) + " " + FindModuleType(each) +
                       " " + ThreadOf(each);
    if (const auto* const value = dynamic_cast<const Configurable*>(&each)) {
      line += " " + value->ToText();
    }
    lines.insert(line);
    const auto* const port = dynamic_cast<const Port*>(&each);
    if (port == nullptr) return;
    lines.insert(line + " " + port->type().name() + " " + port->description() + " " +
                 std::to_string(static_cast<int>(port->direction())));
    for (const Connection& edge : port->outgoing()) {
      lines.insert(port->path() + " > " + edge.to->path() + " " + std::to_string(edge.options.queue) + " " +
                   std::to_string(static_cast<int>(edge.options.on_full)));
    }
  });
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::size_t Sets() {
  const char* const asked = std::getenv("RUNNEL_RANDOM_CHANGES");
  return asked != nullptr ? std::strtoul(asked, nullptr, 10) : 1'500;
}

class RandomHistory : public ::testing::Test {
 protected:
  RandomHistory() {
    RegisterRandomTypes(modules);
    CreateThread(runtime, "one", {.activation = ThreadOptions::Activation::kFreeRunning});
    CreateThread(runtime, "two", {.period = std::chrono::microseconds(200)});
    runtime.Create<Group>(runtime.Create<Group>(runtime.root(), "app"), "w");
    EXPECT_TRUE(runtime.MakeReady(runtime.root()));
    EXPECT_TRUE(scheduler.Start());
  }
  ~RandomHistory() override { scheduler.Stop(); }

  void Must(const ChangeOutcome& outcome, std::size_t number) {
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString() << "number " << number;
  }

  Runtime runtime;
  ModuleRegistry modules;
  Scheduler scheduler{runtime, {.default_thread = "one"}};
  StructureEditor editor{runtime, modules, &scheduler};
};

}  // namespace

// While two threads run what is there.
TEST_F(RandomHistory, GoesBackAndForthOverEveryStateThatHasBeen) {
  constexpr std::size_t kAll = 1'000'000;
  ChangeHistory history(editor, kAll);
  StructureModel model(kTop);
  RandomChanges random(17, kTop);
  std::vector<std::string> states{WholeText(runtime)};
  for (std::size_t i = 0; i < Sets(); ++i) {
    const ChangeSet changes = random.Next(model);
    const bool expected = model.Apply(changes);
    ASSERT_EQ(history.Apply(changes).is_done, expected) << TextOf(changes);
    if (expected) states.push_back(WholeText(runtime));
  }
  ASSERT_GT(states.size(), Sets() / 10);
  // All the way back and forth, then shorter and shorter ways.
  for (std::size_t way = states.size() - 1; way > 0; way /= 3) {
    for (std::size_t i = 0; i < way; ++i) {
      Must(history.Undo(), i);
      ASSERT_EQ(WholeText(runtime), states[states.size() - 2 - i]) << "undone " << i;
    }
    if (way == states.size() - 1) {
      EXPECT_FALSE(history.NextUndo());
      EXPECT_FALSE(history.Undo());
    }
    for (std::size_t i = 0; i < way; ++i) {
      Must(history.Redo(), i);
      ASSERT_EQ(WholeText(runtime), states[states.size() - way + i]) << "redone " << i;
    }
    EXPECT_FALSE(history.NextRedo());
  }
  EXPECT_THAT(scheduler.TakeFaults(), ::testing::IsEmpty());
}

// Somebody else changes the same structure at random: whatever is refused has changed nothing.
TEST_F(RandomHistory, IsWholeOrNotAtAllWhenOthersChangeTheSame) {
  ChangeHistory history(editor);
  StructureModel model(kTop);  // knows less and less of what is there, which does no harm
  RandomChanges random(23, kTop);
  std::size_t done = 0;
  std::size_t refused = 0;
  for (std::size_t i = 0; i < Sets(); ++i) {
    const ChangeSet changes = random.Next(model);
    (void)model.Apply(changes);
    if (i % 3 == 0) {
      (void)editor.Apply(changes);
    } else {
      (void)history.Apply(changes);
    }
    if (i % 2 == 0) continue;
    const std::string before = WholeText(runtime);
    const auto label = history.NextUndo();
    const ChangeOutcome undone = history.Undo();
    ++(undone ? done : refused);
    if (!undone) {
      ASSERT_EQ(WholeText(runtime), before);
      EXPECT_TRUE(undone.is_refused);
      if (label) {
        EXPECT_THAT(undone.diagnostics.ToString(), ::testing::HasSubstr("is forgotten"));
      }
    } else if (i % 4 == 1) {
      ASSERT_TRUE(history.Redo());
      ASSERT_EQ(WholeText(runtime), before);
    }
  }
  EXPECT_GT(done, 10U);
  EXPECT_GT(refused, 10U);
}

}  // namespace runnel::test
