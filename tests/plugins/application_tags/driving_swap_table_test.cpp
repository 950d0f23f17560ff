// Every swap between two kinds of module that move something, at a place with every kind of mark, with all that takes it back or
// carries it on. What holds of each cell: nothing is lost, and nothing has a safe value that nobody has said of its unit.

#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/port/driving_ports.h"
#include "core/port/port_stop.h"
#include "core/types/text_format.h"
#include "tests/plugins/application_tags/driving_swap_fixture.h"

namespace runnel::testing {
namespace {

constexpr std::array kUnits = {"", "m/s", "rad", "us"};
struct Declaration {
  const char* name;
  InputOptions options;
};
const std::array kDeclarations = {
    Declaration{"nothing", {}},
    Declaration{"velocity0", {.drives = true, .command = DrivingKind::kVelocity, .safe_value = AnyValue(0.0)}},
    Declaration{"velocity1500", {.drives = true, .command = DrivingKind::kVelocity, .safe_value = AnyValue(1500.0)}},
    Declaration{"position0.3", {.drives = true, .command = DrivingKind::kPosition, .safe_value = AnyValue(0.3)}},
    Declaration{"effort0", {.drives = true, .command = DrivingKind::kEffort, .safe_value = AnyValue(0.0)}},
};
const std::array<std::string, 6> kSaid = {"", " ", " safe=\"0\" command=\"velocity\"", " safe=\"1500\" command=\"velocity\"",
                                          " safe=\"0.3\" command=\"position\"", " safe=\"0\" brake=\"0.4 s\" command=\"effort\""};

constexpr std::size_t kVariants = kUnits.size() * 5;
std::string Name(std::size_t variant) { return "test/" + std::string(kDeclarations[variant % 5].name) + "_" + std::to_string(variant / 5); }

bool fails = false;  // the module that is made next
InputOptions Options(std::size_t unit, std::size_t declaration) {
  InputOptions options = kDeclarations[declaration].options;
  options.unit = kUnits[unit];
  return options;
}
template <std::size_t kIndex>
struct Variant final : Module {
  using Module::Module;
  Input<double> in{this, "in", Options(kIndex / 5, kIndex % 5)};
  const bool is_bad = fails;
  void Update() override {
    if (is_bad) throw std::runtime_error("no such device");
  }
};
struct Stop {
  bool drives = false;
  double safe = 0;
  DrivingKind command = DrivingKind::kUnspecified;
  Duration brake{};
  bool operator==(const Stop&) const = default;
};

struct Place {
  Stop stop;
  std::string text;  // of the file
  std::shared_ptr<const DrivingMark> said;
  std::string unit;
};

struct DrivingSwapTable : ::testing::TestWithParam<std::size_t> {
  template <std::size_t... kIndex>
  void Know(SavingWorkshop& workshop, std::index_sequence<kIndex...>) {
    (workshop.Add<Variant<kIndex>>(Name(kIndex)), ...);
    workshop.Add<driving_swap::Keeper>("test/keeper");
  }
  bool Load(const std::string& type, const std::string& said) {
    history.reset();
    editor.reset();
    scheduler.reset();
    shop.emplace();
    Know(*shop, std::make_index_sequence<kVariants>());
    const std::string mark = said.empty() ? "" : "<driving port=\"m/in\"" + said + "/>";
    WriteAll(folder / "app.xml", "<application name=\"demo\"><module name=\"s\" type=\"test/keeper\"/><module name=\"m\" type=\"" + type +
                                     "\"/><connect from=\"s/value\" to=\"m/in\"/>" + mark + "</application>");
    if (!BuildApplication(folder / "app.xml", {shop->runtime, shop->plugins, shop->tags, shop->configuration}, BuildMode::kRun).diagnostics.ok())
      return false;
    scheduler.emplace(shop->runtime, SchedulerOptions{.clock = SchedulerOptions::ClockKind::kSimulated});
    editor.emplace(shop->runtime, shop->plugins.modules(), &*scheduler);
    history.emplace(*editor);
    return true;
  }
  static Stop StopAt(SavingWorkshop& workshop, const std::string& path = "/demo/m/input/in") {
    const auto stop = workshop.Get<Port>(path).stop();
    if (!stop || !stop->robot()) return {};
    return {true, *static_cast<const double*>(stop->safe_value().get()), stop->command(), stop->brake()};
  }
  std::string Text() { return shop->Text(shop->Get<FrameworkElement>("/demo"), folder.path()); }
  Stop Again() {
    SavingWorkshop other;
    Know(other, std::make_index_sequence<kVariants>());
    WriteAll(folder / "again.xml", Text());
    const auto built = BuildApplication(folder / "again.xml", {other.runtime, other.plugins, other.tags, other.configuration}, BuildMode::kRun);
    EXPECT_TRUE(built.diagnostics.ok()) << built.diagnostics.ToString() << Text();
    return built.diagnostics.ok() ? StopAt(other) : Stop{};
  }
  void Do(const Change& change) {
    const ChangeOutcome done = history->Apply({change});
    EXPECT_TRUE(done) << done.diagnostics.ToString();
  }
  void Undo() { EXPECT_TRUE(history->Undo()); }
  Place Now() {
    const auto& port = shop->Get<Port>("/demo/m/input/in");
    return {StopAt(*shop), Text(), internal::DrivingState::MarkOf(port), port.unit()};
  }
  void ExpectAsBefore(const Place& place, const char* after) {
    EXPECT_EQ(StopAt(*shop), place.stop) << after;
    EXPECT_EQ(Text(), place.text) << after;
    EXPECT_EQ(shop->Get<Port>("/demo/m/input/in").incoming().size(), 1U) << after;
  }
  void ExpectSwapped(const Place& before, std::size_t variant);
  void Swap(std::size_t variant);

  TestFolder folder;
  std::optional<SavingWorkshop> shop;
  std::optional<Scheduler> scheduler;
  std::optional<StructureEditor> editor;
  std::optional<ChangeHistory> history;
};

// What moved is stopped still: by what is said of the place, else of the module, else of what was there before, if that means the
// same in this one's unit.
void DrivingSwapTable::ExpectSwapped(const Place& before, std::size_t variant) {
  const InputOptions& declared = kDeclarations[variant % 5].options;
  const Port& port = shop->Get<Port>("/demo/m/input/in");
  const Stop after = StopAt(*shop);
  EXPECT_EQ(port.incoming().size(), 1U);
  EXPECT_EQ(after.drives, before.stop.drives || declared.drives);
  EXPECT_EQ(Again(), after) << Text();
  if (!after.drives) return;
  const auto number = [](const AnyValue& value) { return *static_cast<const double*>(value.get()); };
  const bool is_said = before.said && before.said->safe_value;
  EXPECT_EQ(after.safe, is_said ? number(before.said->safe_value) : declared.drives ? number(declared.safe_value) : before.stop.safe);
  const DrivingKind known = DrivingKindByUnits(port.type(), port.unit());
  EXPECT_TRUE(known == DrivingKind::kEffort || known == DrivingKind::kUnspecified || after.command == known);
  const bool is_its_own = declared.drives && !is_said;
  const bool is_another_unit = !is_its_own && !port.unit().empty() && port.unit() != before.unit;
  EXPECT_TRUE(!is_another_unit || (after.safe == 0 && after.command != DrivingKind::kPosition));
  EXPECT_EQ(after.brake, before.said && before.said->brake ? *before.said->brake : declared.drives ? Duration{} : before.stop.brake);
}

void DrivingSwapTable::Swap(std::size_t variant) {
  const std::string type = Name(variant);
  const Place before = Now();
  // With a step after it that fails: taken back.
  (void)history->Apply({ReplaceModule{"/demo/m", type}, ReplaceModule{"/demo/s", "test/keeper"}});
  ExpectAsBefore(before, "rolled back");
  if (!history->Apply({ReplaceModule{"/demo/m", type}})) return ExpectAsBefore(before, "refused");
  ExpectSwapped(before, variant);
  const Place after = Now();
  Undo();
  ExpectAsBefore(before, "undone");
  EXPECT_TRUE(history->Redo());
  ExpectAsBefore(after, "redone");
  Do(DeleteElement{"/demo/m"});
  Undo();
  ExpectAsBefore(after, "deleted and back");
  Do(RenameElement{"/demo/m", "n"});
  Undo();
  ExpectAsBefore(after, "renamed and back");
  Do(CopyElement{"/demo/m", "copy"});
  EXPECT_EQ(StopAt(*shop, "/demo/copy/input/in"), after.stop);
  Undo();
  for (std::size_t third = variant % 4; third < kVariants; third += 4) {
    SCOPED_TRACE("-> " + Name(third));
    if (history->Apply({ReplaceModule{"/demo/m", Name(third)}})) {
      ExpectSwapped(after, third);
      Undo();
    }
    ExpectAsBefore(after, "another one, and back");
  }
  Undo();
  ExpectAsBefore(before, "all undone");
  // One that fails in its first cycles is put back.
  fails = true;
  Do(ReplaceModule{"/demo/m", type});
  fails = false;
  EXPECT_EQ(StopAt(*shop), after.stop);
  for (int i = 0; i < 3; ++i) scheduler->Step();
  ExpectAsBefore(before, "put back");
}

// The parameter is the module that is there first. One that is in m/s and says that it is a position cannot be.
TEST_P(DrivingSwapTable, LosesNothing) {
  std::size_t swapped = 0;
  for (const std::string& said : kSaid) {
    if (!Load(Name(GetParam()), said)) continue;
    for (std::size_t second = 0; second < kVariants && !HasFailure(); ++second) {
      SCOPED_TRACE(Name(GetParam()) + said + " -> " + Name(second));
      Swap(second);
      ++swapped;
    }
  }
  const std::array<std::size_t, kVariants> places{5, 6, 6, 6, 6, 4, 4, 4, 0, 0, 2, 0, 0, 3, 0, 5, 6, 6, 6, 6};
  EXPECT_EQ(swapped, kVariants * places[GetParam()]);
}
INSTANTIATE_TEST_SUITE_P(Of, DrivingSwapTable, ::testing::Range<std::size_t>(0, kVariants));

}  // namespace
}  // namespace runnel::testing
