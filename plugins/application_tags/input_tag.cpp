#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/number_text.h"
#include "core/port/port_options.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "core/types/type_of.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_tags/tag_list.h"

namespace runnel {

AnyValue internal::ReadValue(const TagUse& use, const XmlAttribute& text, const Port& input) {
  const TypeInfo& type = input.type();
  const std::shared_ptr<void> value = type.is_transparent() ? type.Make() : nullptr;
  if (!value) {
    use.Report({.message = "values of type " + type.name() + " cannot be written", .path = input.path()},
               text.value_position);
    return {};
  }
  if (auto set = SetFromText(type, text.value, value.get()); !set) {
    use.Report({.message = set.error().message, .path = input.path(), .hint = set.error().hint}, text.value_position);
    return {};
  }
  return {type, value};
}

namespace {

void SetInputLimits(const TagUse& use) {
  Port* const input = SearchPort(PathIn(use.Get("name"), use.parent), PathKind::kInput, use.context);
  if (input == nullptr) return;
  InputLimits limits;
  const auto number = [&](const char* name) -> std::optional<double> {
    const XmlAttribute* const said = use.Find(name);
    return said != nullptr ? NumberIn<double>(said->value) : std::nullopt;
  };
  limits.minimum = number("minimum");
  limits.maximum = number("maximum");
  if (const XmlAttribute* const default_value = use.Find("default")) {
    limits.default_value = internal::ReadValue(use, *default_value, *input);
    if (!limits.default_value) return;
  }
  limits.out_of_bounds = internal::Chosen<OutOfBounds>(use, "out_of_bounds", OutOfBoundsNames());
  if (!limits.has_some()) {
    use.Report(
        {.message = "<input> says nothing of its values", .hint = "add default=\"…\", minimum=\"…\" or maximum=\"…\""},
        use.xml.position());
    return;
  }
  if (auto set = input->SetLimits(limits); !set) {
    use.Report(set.error(), use.xml.position());
    return;
  }
  input->Annotate(std::make_unique<GivenLimits>(std::move(limits)));
}

std::vector<SavedTag> SavedLimits(FrameworkElement& module) {
  std::vector<SavedTag> tags;
  module.VisitAll<const Port>([&](const Port& port) {
    const auto* const given = port.FindAnnotation<GivenLimits>();
    if (given == nullptr || !given->limits.has_some()) return;
    const InputLimits& limits = given->limits;
    const auto bound = [](const std::optional<double>& value) { return value ? TextOf(*value) : std::string(); };
    const std::string text = limits.default_value ? ToText(port.type(), limits.default_value.get()) : std::string();
    const auto out = static_cast<std::size_t>(limits.out_of_bounds);
    tags.push_back({{{"name", port.name()},
                     {"default", text, !limits.default_value},
                     {"minimum", bound(limits.minimum), !limits.minimum},
                     {"maximum", bound(limits.maximum), !limits.maximum},
                     {"out_of_bounds", OutOfBoundsNames()[out], out == 0}},
                    nullptr});
  });
  return tags;
}

}  // namespace

XmlTag InputTag() {
  return {.name = "input",
          .summary = "which values an input of the module takes, and what it reads while there is none",
          .parents = {"module"},
          .attributes = {{.name = "name", .kind = AttributeKind::kPath, .required = true},
                         {.name = "default", .summary = "read while nothing is connected, or nothing has come"},
                         {.name = "minimum", .kind = AttributeKind::kNumber},
                         {.name = "maximum", .kind = AttributeKind::kNumber},
                         WordRule("out_of_bounds", OutOfBoundsNames(),
                                  "what becomes of a value that is not between them: discard "
                                  "(by default), clamp, or default")},
          .handle = internal::ReadAt<BuildStage::kParameters, SetInputLimits>,
          .saved = SavedLimits,
          .place = 1};
}

}  // namespace runnel
