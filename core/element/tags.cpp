#include "core/element/tags.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/base/characters.h"
#include "core/element/element_path.h"

namespace runnel {

namespace {

struct Tags final : Annotation {
  explicit Tags(std::vector<std::string> all) : names(std::move(all)) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override { return std::make_unique<Tags>(names); }
  std::vector<std::string> names;
};

}  // namespace

Result<void> CheckTags(const std::vector<std::string>& tags) {
  for (const std::string& tag : tags) {
    if (const auto good = CheckElementName(tag); !good) return good.error().WithContext("'" + tag + "' is no tag");
  }
  return {};
}

Result<void> SetTags(FrameworkElement& element, std::vector<std::string> tags) {
  if (const auto good = CheckTags(tags); !good) return good.error().WithPath(element.path());
  element.Annotate(std::make_unique<Tags>(std::move(tags)));
  return {};
}

std::vector<std::string> TagsOf(const FrameworkElement& element) {
  const auto* const tags = element.FindAnnotation<Tags>();
  return tags != nullptr ? tags->names : std::vector<std::string>();
}

bool HasTag(const FrameworkElement& element, std::string_view tag) {
  const auto* const tags = element.FindAnnotation<Tags>();
  return tags != nullptr && std::ranges::find(tags->names, tag) != tags->names.end();
}

std::string TagsText(const FrameworkElement& element) {
  std::string text;
  for (const std::string& tag : TagsOf(element)) text += (text.empty() ? "" : " ") + tag;
  return text;
}

std::vector<std::string> TagsInText(std::string_view text) {
  const std::vector<std::string_view> tags = PartsBetween(" \t\r\n", text);
  return {tags.begin(), tags.end()};
}

}  // namespace runnel
