#include "plugins/behaviours/meta_signal.h"

#include "core/conversion/conversion.h"

namespace runnel {

namespace {

template <typename From, typename To>
void RegisterUsual(const char* name, const char* summary) {
  RegisterConversion<From, To>(
      name,
      [](const From& from, To& to) {
        if constexpr (std::is_same_v<To, double>) {
          to = from.value();
          return true;
        } else {
          // What somebody has set by hand may be any number: that is not passed on.
          const bool is_right = IsMetaValue(from.value());
          if (is_right) to = To(from.value());
          return is_right;
        }
      },
      summary, /*is_usual=*/true);
}

}  // namespace

void RegisterMetaSignals() {
  [[maybe_unused]] static const bool are_registered = [] {
    RegisterUsual<Activity, Stimulation>("stimulation", "an activity stimulates");
    RegisterUsual<Activity, Inhibition>("inhibition", "an activity inhibits");
    RegisterUsual<Activity, double>("number", "an activity as a number");
    RegisterUsual<TargetRating, double>("number", "a target rating as a number");
    return true;
  }();
}

}  // namespace runnel
