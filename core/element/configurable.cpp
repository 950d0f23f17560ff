#include "core/element/configurable.h"

#include "core/base/unit.h"
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

Result<std::shared_ptr<const void>> Configurable::ConvertedFrom(const Values& other,
                                                                const std::shared_ptr<const void>& value) const {
  if (IsLike(other)) {
    const auto good = Check(value.get());
    return good ? Result(value) : good.error();
  }
  const std::string text = runnel::ToText(*other.type, value.get());
  const std::string& unit = info().unit;
  return Parse(other.unit != unit && RatioOfUnits(other.unit, unit) ? text + " " + other.unit : text);
}

}  // namespace runnel
