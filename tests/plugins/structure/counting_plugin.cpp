// One plugin in several versions, for being loaded anew. VERSION 1 counts by one, 2 by ten; the others are
// wrong in one way each. 9 and 10 are 1 and 2 once more, and throw where the test that loads them wants it.

#include <optional>
#include <stdexcept>
#include <vector>

#include "core/module/module.h"
#include "core/plugin/plugin_entry.h"
#include "core/port/output.h"

#if VERSION >= 9
extern "C" void InjectionPointForPlugins();  // of the program
#else
static void InjectionPointForPlugins() {}
#endif

namespace runnel::test {

struct Tally {
  int value = 0;
#if VERSION == 3
  double another_layout = 0;
#endif
#if VERSION == 4
  static constexpr const char* kField = "renamed";
#else
  static constexpr const char* kField = "value";
#endif
};
inline void Describe(TypeBuilder<Tally>& type) {
  InjectionPointForPlugins();
  type.Name("test::Tally").Field(Tally::kField, &Tally::value);
}

/// A kept state.
struct Count {
  int value = 0;
};
inline void Describe(TypeBuilder<Count>& type) {
  InjectionPointForPlugins();
  type.Name("test::Count").Field("value", &Count::value);
}

/// What a kept list consists of.
struct Mark {
  int number = 0;
  int squared = 0;
#if VERSION == 7
  int another_field = 0;
#endif
};
#if VERSION != 8
inline void Describe(TypeBuilder<Mark>& type) {
  type.Name("test::Mark").Field("number", &Mark::number).Field("squared", &Mark::squared);
}
#endif

/// Publishes how far it has counted, and how many marks it has made, one a cycle; both are kept.
class Counting final : public Module {
 public:
  explicit Counting(const Placement& placement) : Module(placement) {
    KeepState(count_);
    InjectionPointForPlugins();
    KeepState(marks_);
    KeepState(last_mark_);
  }
  Output<Tally> out{this, "out"};
  Output<int> marks{this, "marks"};
  Output<int> sum_of_marks{this, "sum_of_marks"};

 private:
  Result<void> Prepare() override {
    InjectionPointForPlugins();
    return {};
  }
  void Update() override {
#if VERSION == 2 || VERSION == 10
    count_.value += 10;
#else
    ++count_.value;
#endif
    Tally tally;
    tally.value = count_.value;
    out.Publish(tally);
    const int number = static_cast<int>(marks_.size()) + 1;
    const auto side = static_cast<unsigned>(number);
    last_mark_ = {number, static_cast<int>(side * side)};
    marks_.push_back(*last_mark_);
    unsigned sum = 0;  // wraps where an application runs for minutes
    for (const Mark& each : marks_) sum += static_cast<unsigned>(each.squared);
    marks.Publish(number);
    sum_of_marks.Publish(static_cast<int>(sum));
  }
  Count count_;
  std::vector<Mark> marks_;
  std::optional<Mark> last_mark_;
};

}  // namespace runnel::test

RUNNEL_PLUGIN(counting, registry) {
  InjectionPointForPlugins();
#if VERSION == 5
  throw std::runtime_error("cannot register");
#endif
#if VERSION == 6
  registry.Add<runnel::test::Counting>("counting/renamed", "counts");
#else
  registry.Add<runnel::test::Counting>("counting/counting", "counts");
#endif
}
