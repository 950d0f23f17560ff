// Every swap between two kinds of module that move something, at a place with every kind of mark, with all that takes it back or
// carries it on. What holds of each cell: nothing is lost, and nothing has a safe value that nobody has said of its unit.

#include <array>
#include <memory>
#include <string>
#include <utility>

#include "tests/plugins/application_tags/driving_swap_variants.h"

namespace runnel::testing {
namespace {

using namespace driving_swap;

const std::array<std::string, 6> kSaid = {"",
                                          " ",
                                          " safe=\"0\" command=\"velocity\"",
                                          " safe=\"1500\" command=\"velocity\"",
                                          " safe=\"0.3\" command=\"position\"",
                                          " safe=\"0\" brake=\"0.4 s\" command=\"effort\""};

struct Place {
  Stop stop;
  std::string text;  // of the file
  std::shared_ptr<const DrivingMark> said;
  std::string unit;
};

struct DrivingSwapTable : TableOfVariants {
  Stop Again() {
    SavingWorkshop other;
    Know(other, std::make_index_sequence<kModules>());
    WriteAll(folder / "again.xml", Text());
    const auto built = BuildApplication(
        folder / "again.xml", {other.runtime, other.plugins, other.tags, other.configuration}, BuildMode::kRun);
    EXPECT_TRUE(built.diagnostics.ok()) << built.diagnostics.ToString() << Text();
    return built.diagnostics.ok() ? StopAt(other) : Stop{};
  }
  void Do(const Change& change) {
    const ChangeOutcome done = history->Apply({change});
    EXPECT_TRUE(done) << done.diagnostics.ToString();
  }
  void Undo() {
    const ChangeOutcome undone = history->Undo();
    EXPECT_TRUE(undone) << undone.diagnostics.ToString();
  }
  Place Now() { return {StopAt(*shop), Text(), internal::DrivingState::MarkOf(In(*shop)), Reader(*shop).unit()}; }
  void ExpectAsBefore(const Place& place, const char* after) {
    EXPECT_EQ(StopAt(*shop), place.stop) << after;
    EXPECT_EQ(Text(), place.text) << after;
    EXPECT_EQ(In(*shop).incoming().size(), 1U) << after;
  }
  void ExpectSwapped(const Place& before, std::size_t variant);
  void Swap(std::size_t variant);
};

// What moved is stopped still: by what is said of the place, else of the module, else of what was there before, if that means the
// same in this one's unit. What a part of a composite declares comes before what is said of the composite.
void DrivingSwapTable::ExpectSwapped(const Place& before, std::size_t variant) {
  const InputOptions& declared = DeclarationOf(variant);
  const Port& reader = Reader(*shop);
  const Stop after = StopAt(*shop);
  EXPECT_EQ(In(*shop).incoming().size(), 1U);
  EXPECT_EQ(after.drives, before.stop.drives || declared.drives);
  EXPECT_EQ(Again(), after) << Text();
  if (!after.drives) return;
  const bool is_of_part = IsComposite(variant) && reader.is_driving();
  const bool is_said = before.said && !is_of_part;
  const bool says_safe = is_said && before.said->safe_value;
  EXPECT_EQ(after.safe, says_safe         ? Number(before.said->safe_value)
                        : declared.drives ? Number(declared.safe_value)
                                          : before.stop.safe);
  const DrivingKind known = DrivingKindByUnits(reader.type(), reader.unit());
  EXPECT_TRUE(known == DrivingKind::kEffort || known == DrivingKind::kUnspecified || after.command == known ||
              IsComposite(variant));
  const bool is_another_unit =
      !(declared.drives && !says_safe) && !reader.unit().empty() && reader.unit() != before.unit;
  EXPECT_TRUE(!is_another_unit ||
              (after.safe == 0 && after.command != DrivingKind::kPosition && known != DrivingKind::kPosition));
  EXPECT_EQ(after.brake, is_said && before.said->brake ? *before.said->brake
                         : declared.drives             ? Duration{}
                                                       : before.stop.brake);
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
  EXPECT_EQ(StopAt(*shop, "/demo/copy"), after.stop);
  Undo();
  for (std::size_t third = variant % 16; third < kVariants; third += 16) {
    SCOPED_TRACE("-> " + Name(third));
    if (history->Apply({ReplaceModule{"/demo/m", Name(third)}})) {
      ExpectSwapped(after, third);
      Undo();
    }
    ExpectAsBefore(after, "another one, and back");
  }
  Undo();
  ExpectAsBefore(before, "all undone");
  if (IsComposite(variant)) return;  // whose parts are not put back
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
  const std::array<std::size_t, kModules> places{5, 6, 6, 6, 6, 4, 4, 4, 0, 0, 2, 0, 0, 3, 0, 5, 6, 6, 6, 6};
  EXPECT_TRUE(IsComposite(GetParam()) || swapped == kVariants * places[GetParam()]) << swapped;
}
INSTANTIATE_TEST_SUITE_P(Of, DrivingSwapTable, ::testing::Range<std::size_t>(0, kVariants));

}  // namespace
}  // namespace runnel::testing
