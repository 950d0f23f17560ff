#include "plugins/runtime_construction/tags/built_in_tags.h"

#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/source_place.h"

namespace runnel {

std::vector<XmlTag> BuiltInTags() {
  return {ApplicationTag(), LoadTag(),    GroupTag(),    ModuleTag(),
          PortTag(),        ConnectTag(), ParameterTag()};
}

bool CheckNameIsFree(const TagUse& use) {
  const XmlAttribute& name = use.Get("name");
  const FrameworkElement* const known = use.parent.FindChild(name.value);
  if (known == nullptr) return true;
  const auto* const place = known->FindAnnotation<SourcePlace>();
  use.context.Report(
      {.message = "there is already an element called '" + name.value + "' in " + use.parent.path(),
       .path = use.path(),
       .hint = place == nullptr ? "choose another name"
                                : "the first is in line " + std::to_string(place->position.line)},
      name.value_position, use.parent);
  return false;
}

}  // namespace runnel
