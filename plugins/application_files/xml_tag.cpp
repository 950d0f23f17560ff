#include "plugins/application_files/xml_tag.h"

#include <algorithm>
#include <iterator>

#include "core/base/check.h"
#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "core/element/element_path.h"
#include "core/element/file_notes.h"
#include "core/types/duration_text.h"
#include "core/xml/xml_reading.h"
#include "plugins/application_files/build_context.h"

namespace runnel {

namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::string_view kSeparators = " \t\r\n,";

std::string InApostrophes(std::string_view text) { return "'" + std::string(text) + "'"; }

Result<void> CheckNotEmpty(std::string_view value) {
  if (SplitPaths(value).empty()) return Error{.message = "a path must not be empty"};
  return {};
}

Result<void> CheckSinglePath(std::string_view value) {
  if (auto filled = CheckNotEmpty(value); !filled) return filled;
  if (kBlanks.find(value.front()) != std::string_view::npos || kBlanks.find(value.back()) != std::string_view::npos) {
    return Error{.message = "the path " + InApostrophes(value) + " begins or ends with a blank"};
  }
  return {};
}

Result<void> CheckDuration(std::string_view value) {
  const auto duration = ParseDuration(value);
  if (!duration) return duration.error();
  if (*duration > Duration::zero()) return {};
  return Error{.message = InApostrophes(value) + " is not longer than nothing"};
}

}  // namespace

Result<void> CheckAttributeValue(const AttributeRule& rule, std::string_view value) {
  switch (rule.kind) {
    case AttributeKind::kText:
    case AttributeKind::kModuleType:
    case AttributeKind::kPortType:
      return {};
    case AttributeKind::kName:
    case AttributeKind::kNewName:
      return CheckElementName(value);
    case AttributeKind::kPath:
      return CheckSinglePath(value);
    case AttributeKind::kPathList:
      if (auto filled = CheckNotEmpty(value); !filled) return filled;
      if (value.find(',') == std::string_view::npos) return {};
      return Error{.message = "a comma between paths", .hint = "paths are separated by blanks"};
    case AttributeKind::kCount:
      if (auto count = ParseCount(value); !count) return count.error();
      return {};
    case AttributeKind::kNumber:
      if (ParseNumber(value)) return {};
      return Error{.message = InApostrophes(value) + " is not a number"};
    case AttributeKind::kDuration:
      return CheckDuration(value);
    case AttributeKind::kChoice:
      if (std::ranges::find(rule.choices, value) != rule.choices.end()) return {};
      return Error{.message = InApostrophes(value) + " is not possible for " + rule.name,
                   .hint = NearestNameHint(value, rule.choices)};
  }
  return {};
}

Result<std::size_t> ParseCount(std::string_view text) {
  if (const auto count = NumberIn<std::size_t>(text)) return *count;
  return Error{.message = InApostrophes(text) + " is not a count", .hint = "write 0, 1, 2 …"};
}

std::vector<std::string> SplitPaths(std::string_view text) {
  std::vector<std::string> words;
  for (;;) {
    const std::size_t begin = text.find_first_not_of(kSeparators);
    if (begin == std::string_view::npos) return words;
    const std::size_t end = std::min(text.find_first_of(kSeparators, begin), text.size());
    words.emplace_back(text.substr(begin, end - begin));
    text.remove_prefix(end);
  }
}

std::string TagUse::path() const {
  const XmlAttribute* const name = Find("name");
  const std::string parent_path = parent.path();
  const bool is_name = name != nullptr && CheckElementName(name->value);
  if (!is_name) return parent_path;
  return (parent_path == "/" ? "" : parent_path) + "/" + name->value;
}

const XmlAttribute& TagUse::Get(std::string_view attribute) const {
  const XmlAttribute* const found = Find(attribute);
  RUNNEL_CHECK(found != nullptr, "a tag asks for an attribute that its rules do not require");
  return *found;
}

void TagUse::Report(Error error, const SourcePosition& position) const {
  if (error.path.empty()) error.path = path();
  context.Report(std::move(error), position, parent);
}

bool TagUse::HasFreeName(const FrameworkElement& where) const {
  const XmlAttribute& name = Get("name");
  const FrameworkElement* const known = where.FindChild(name.value);
  if (known == nullptr) return true;
  const auto* const place = known->FindAnnotation<SourcePlace>();
  Report({.message = "there is already an element called '" + name.value + "' in " + where.path(),
          .hint = place == nullptr ? "choose another name"
                                   : "the first is in line " + std::to_string(place->position.line)},
         name.value_position);
  // Whoever names it may mean the other one, or calls that by another name.
  context.MarkMissing(*known, nullptr);
  context.MarkMissing(where, nullptr);
  return false;
}

void XmlTagRegistry::AddTag(XmlTag tag) {
  if (const XmlTag* known = FindTag(tag.name)) {
    throw ElementError({.message = "there is already a tag <" + tag.name + ">" +
                                   (known->plugin.empty() ? "" : " of plugin '" + known->plugin + "'")});
  }
  tag.plugin = plugin_;
  std::string name = tag.name;
  tags_.emplace(std::move(name), std::move(tag));
}

void XmlTagRegistry::AddAttribute(AddedAttribute attribute) {
  const auto same = [&](const AttributeRule& rule) { return rule.name == attribute.rule.name; };
  const XmlTag* const tag = FindTag(attribute.tag);
  if (tag == nullptr) {
    throw ElementError(
        {.message = "there is no tag <" + attribute.tag + "> that could have '" + attribute.rule.name + "'"});
  }
  if (std::ranges::any_of(Rules(*tag), same)) {
    throw ElementError({.message = "<" + tag->name + "> already has '" + attribute.rule.name + "'"});
  }
  attribute.plugin = plugin_;
  added_attributes_.push_back(std::move(attribute));
}

std::function<void()> XmlTagRegistry::SetAside(std::string_view plugin) {
  struct Aside {
    decltype(tags_) tags;
    std::vector<AddedAttribute> attributes;
  };
  // All memory comes before the first is taken out; putting them back needs none, as there is room where they were.
  const auto aside = std::make_shared<Aside>();
  aside->attributes.reserve(added_attributes_.size());
  std::function<void()> back = [this, aside] {
    tags_.merge(aside->tags);
    std::ranges::move(aside->attributes, std::back_inserter(added_attributes_));
    aside->attributes.clear();
  };
  for (auto each = tags_.begin(); each != tags_.end();) {
    const auto at = each++;
    if (at->second.plugin == plugin) aside->tags.insert(tags_.extract(at));
  }
  const auto is_others = [&](const AddedAttribute& each) { return each.plugin != plugin; };
  const auto of_it = std::stable_partition(added_attributes_.begin(), added_attributes_.end(), is_others);
  std::move(of_it, added_attributes_.end(), std::back_inserter(aside->attributes));
  added_attributes_.erase(of_it, added_attributes_.end());
  return back;
}

const XmlTag* XmlTagRegistry::FindTag(std::string_view name) const {
  const auto found = tags_.find(name);
  return found == tags_.end() ? nullptr : &found->second;
}

std::vector<const AddedAttribute*> XmlTagRegistry::AddedAttributes(std::string_view tag) const {
  std::vector<const AddedAttribute*> attributes;
  for (const AddedAttribute& each : added_attributes_) {
    if (each.tag == tag) attributes.push_back(&each);
  }
  return attributes;
}

std::vector<AttributeRule> XmlTagRegistry::Rules(const XmlTag& tag) const {
  std::vector<AttributeRule> rules = tag.attributes;
  for (const AddedAttribute* added : AddedAttributes(tag.name)) rules.push_back(added->rule);
  return rules;
}

std::vector<std::string> XmlTagRegistry::TagsIn(std::string_view parent) const {
  std::vector<std::string> names;
  for (const auto& [name, tag] : tags_) {
    const auto may_stand_in = [&tag = tag](std::string_view place) {
      return std::ranges::find(tag.parents, place) != tag.parents.end();
    };
    const bool is_of_group = parent == "group_type" && may_stand_in("group");
    if (may_stand_in(parent) || is_of_group) names.push_back(name);
  }
  return names;
}

PathAttributesOf PathAttributesIn(const XmlTagRegistry& tags) {
  return [&tags](XmlElement tag) {
    using enum PathAttribute::Kind;
    std::vector<PathAttribute> found;
    const XmlTag* const known = tags.FindTag(tag.name());
    for (const AttributeRule& rule : known != nullptr ? tags.Rules(*known) : std::vector<AttributeRule>()) {
      const bool is_other = tag.name() == "load" || rule.name == "type" || rule.name == "config";  // of a file
      if (rule.kind == AttributeKind::kNewName) found.push_back({rule.name, kNewName});
      if (rule.kind == AttributeKind::kPathList) found.push_back({rule.name, kPathList});
      if (rule.kind == AttributeKind::kPath && !is_other) found.push_back({rule.name, kPath});
    }
    return found;
  };
}

}  // namespace runnel
