#include "plugins/runtime_construction/name_check.h"

#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/source_place.h"

namespace runnel {

bool CheckNameIsFree(const TagUse& use, const FrameworkElement& where) {
  const XmlAttribute& name = use.Get("name");
  const FrameworkElement* const known = where.FindChild(name.value);
  if (known == nullptr) return true;
  const auto* const place = known->FindAnnotation<SourcePlace>();
  use.context.Report(
      {.message = "there is already an element called '" + name.value + "' in " + where.path(),
       .path = use.path(),
       .hint = place == nullptr ? "choose another name"
                                : "the first is in line " + std::to_string(place->position.line)},
      name.value_position, use.parent);
  return false;
}

}  // namespace runnel
