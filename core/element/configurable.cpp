#include "core/element/configurable.h"

#include "core/element/framework_element.h"
#include "core/types/text_format.h"

namespace runnel {

Result<void> Configurable::SetFromText(std::string_view text) {
  const auto value = Parse(text);
  if (value) return Put({*value});
  const auto* const element = dynamic_cast<const FrameworkElement*>(this);
  return element != nullptr ? value.error().WithPath(element->path()) : value.error();
}

Result<void> Configurable::CheckText(std::string_view text) const {
  const auto value = Parse(text);
  return value ? Result<void>() : value.error();
}

std::string Configurable::ToText() const { return runnel::ToText(type(), Value().get()); }
std::string Configurable::OwnText() const { return runnel::ToText(type(), own().value.get()); }

}  // namespace runnel
