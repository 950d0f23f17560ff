#include "plugins/runtime_construction/name_check.h"

#include <memory>

#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/source_place.h"

namespace runnel {

bool CheckNameIsFree(const TagUse& use, const FrameworkElement& where) {
  const XmlAttribute& name = use.Get("name");
  FrameworkElement* const known = where.FindChild(name.value);
  if (known == nullptr) return true;
  if (IsStandIn(*known)) return false;  // which has been reported itself
  const auto* const place = known->FindAnnotation<SourcePlace>();
  use.context.Report(
      {.message = "there is already an element called '" + name.value + "' in " + where.path(),
       .path = use.path(),
       .hint = place == nullptr ? "choose another name"
                                : "the first is in line " + std::to_string(place->position.line)},
      name.value_position, use.parent);
  // Whoever names it may have meant the other one, or calls that by another name.
  use.context.MarkIncomplete(*known);
  use.context.MarkIncomplete(where);
  use.context.MarkIncomplete(use.parent);
  use.context.Excuse(*known);
  return false;
}

std::string FreeName(const TagUse& use, const FrameworkElement& where) {
  const std::string& name = use.Get("name").value;
  if (!name.empty() && CheckNameIsFree(use, where)) return name;
  std::string stand_in = "?";
  for (int i = 2; where.FindChild(stand_in) != nullptr; ++i) stand_in = "?" + std::to_string(i);
  return stand_in;
}

bool IsStandIn(const FrameworkElement& element) {
  return element.FindAnnotation<StandIn>() != nullptr;
}

void MarkIfStandIn(FrameworkElement& made, const TagUse& use) {
  const XmlAttribute* const name = use.Find("name");
  const bool is_own = &made != &use.parent && name != nullptr && made.name() != name->value;
  if (is_own) made.Annotate(std::make_unique<StandIn>());
}

}  // namespace runnel
