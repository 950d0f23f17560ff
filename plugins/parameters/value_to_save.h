#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/element/annotation.h"
#include "core/element/configurable.h"
#include "core/element/framework_element.h"
#include "core/module/group_parameter.h"
#include "core/port/port.h"
#include "plugins/parameters/configuration_saver.h"

namespace runnel {

/// Kept with a parameter that a rule has set for the time being, and a module that it has put in the place of another:
/// the value, or the type, that a person has made it.
struct MadeByRule final : Annotation {
  /// Values of parameters that the module of the rule has not, and what they were loaded as, if they were (LoadedValue).
  using Lacking = std::map<std::string, std::pair<std::string, std::optional<std::string>>>;
  MadeByRule(std::string of_person, std::string of_rule, Lacking of_module = {})
      : before(std::move(of_person)), now(std::move(of_rule)), lacking(std::move(of_module)) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<MadeByRule>(before, now, lacking);
  }
  [[nodiscard]] std::unique_ptr<Annotation> ForCopy() const override { return nullptr; }
  const std::string before;
  const std::string now;
  const Lacking lacking;

  /// What a person has made of the element, which has `now`: just that, unless a rule has made it so.
  [[nodiscard]] static std::string Before(const FrameworkElement& element, const std::string& now) {
    const auto* const known = element.FindAnnotation<MadeByRule>();
    return known != nullptr && known->now == now ? known->before : now;
  }
};

/// Whether its value is that of an output which is connected to it: a file says the connection, by which the value comes
/// anew. Under the structure lock.
[[nodiscard]] inline bool HasValueOfOutput(const FrameworkElement& element, const Configurable& parameter) {
  if (!parameter.is_fed()) return false;
  return std::ranges::any_of(element.children(), [](FrameworkElement* below) {
    bool is_connected = false;
    below->VisitAll<const Port>([&](const Port& feed) { is_connected = is_connected || !feed.Sources().empty(); });
    return is_connected;
  });
}

/// The value that files get: of what an output sets, which may be another one each time, that of before. Under the
/// structure lock.
[[nodiscard]] inline std::string TextToSave(const FrameworkElement& element, const Configurable& parameter) {
  const auto* const group = dynamic_cast<const GroupParameter*>(&element);
  const auto targets = group != nullptr ? group->Find() : std::vector<ConfigurableElement>();
  const std::string* const loaded = LoadedValue::Of(element);
  if (!targets.empty()) return TextToSave(*targets.front().element, *targets.front().configurable);
  // Until what it stands for is there again.
  if (group != nullptr && loaded != nullptr) return *loaded;
  return MadeByRule::Before(element, HasValueOfOutput(element, parameter) ? parameter.OwnText() : parameter.ToText());
}

}  // namespace runnel
