// One plugin in several versions, for being loaded anew. VERSION 1 counts by one, 2 by ten; the others are
// wrong in one way each.

#include <stdexcept>

#include "core/module/module.h"
#include "core/plugin/plugin_entry.h"
#include "core/port/output.h"

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
  type.Name("test::Tally").Field(Tally::kField, &Tally::value);
}

/// Publishes how far it has counted; what it keeps is of the same type in all versions.
class Counting final : public Module {
 public:
  explicit Counting(const Placement& placement) : Module(placement) { KeepState(count_); }
  Output<Tally> out{this, "out"};

 private:
  struct Count {
    int value = 0;
  };
  void Update() override {
#if VERSION == 2
    count_.value += 10;
#else
    ++count_.value;
#endif
    Tally tally;
    tally.value = count_.value;
    out.Publish(tally);
  }
  Count count_;
};

}  // namespace runnel::test

RUNNEL_PLUGIN(counting, registry) {
#if VERSION == 5
  throw std::runtime_error("cannot register");
#endif
#if VERSION == 6
  registry.Add<runnel::test::Counting>("counting/renamed", "counts");
#else
  registry.Add<runnel::test::Counting>("counting/counting", "counts");
#endif
}
