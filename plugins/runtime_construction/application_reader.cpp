#include "plugins/runtime_construction/application_reader.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/xml/xml_reading.h"
#include "plugins/runtime_construction/source_place.h"

namespace runnel {

namespace {

std::vector<std::string> NamesOf(const std::vector<AttributeRule>& rules) {
  std::vector<std::string> names;
  for (const AttributeRule& rule : rules) names.push_back(rule.name);
  return names;
}

}  // namespace

FrameworkElement* ApplicationReader::Read(XmlElement root) {
  const XmlTag* const tag = context_.tags().FindTag(root.name());
  FrameworkElement& top = context_.runtime().root();
  if (tag == nullptr || !tag->parents.empty()) {
    context_.Report({.message = "<" + root.name() + "> is not an application",
                     .hint = "an application file begins with <application>"},
                    root.position(), top);
    return nullptr;
  }
  TagUse use{root, top, context_};
  FrameworkElement* made = nullptr;
  // Not before plugins have been loaded: they may bring attributes of the root tag.
  ReadChildren(root, top, Mode::kHandle, true);
  if (CheckAttributesOf(*tag, use)) made = Handle(*tag, use);
  CheckContents(root, made != nullptr ? *made : top);
  ReadChildren(root, made != nullptr ? *made : top,
               made != nullptr ? Mode::kHandle : Mode::kCheckOnly, false);
  return made;
}

void ApplicationReader::ReadChildren(XmlElement element, FrameworkElement& parent, Mode mode,
                                     bool first) {
  for (const XmlElement child : element.children()) {
    const XmlTag* const tag = context_.tags().FindTag(child.name());
    if (tag == nullptr || tag->comes_first != first) continue;
    if (std::ranges::find(tag->parents, element.name()) == tag->parents.end()) continue;
    ReadTag(*tag, child, parent, mode);
  }
}

void ApplicationReader::ReadTag(const XmlTag& tag, XmlElement element, FrameworkElement& parent,
                                Mode mode) {
  TagUse use{element, parent, context_};
  FrameworkElement* made = nullptr;
  const bool is_usable = CheckAttributesOf(tag, use);
  if (is_usable && mode == Mode::kHandle) made = Handle(tag, use);
  if (const XmlAttribute* name = use.Find("name"); name != nullptr && made == nullptr) {
    context_.MarkMissing(parent, name->value);
  }
  FrameworkElement& inside = made != nullptr ? *made : parent;
  CheckContents(element, inside);
  ReadChildren(element, inside, made != nullptr ? Mode::kHandle : Mode::kCheckOnly, false);
}

void ApplicationReader::CheckContents(XmlElement element, FrameworkElement& parent) {
  const std::vector<std::string> known = context_.tags().TagsIn(element.name());
  Diagnostics problems;
  CheckChildren(element, known, problems);
  for (const Error& error : problems.errors()) {
    const auto is_here = [&](XmlElement child) { return child.position() == error.position; };
    const auto unknown = std::ranges::find_if(element.children(), is_here);
    if (unknown == element.children().end() || context_.IsWorthReporting(unknown->name(), known)) {
      context_.Report(error, element.position(), parent);
    }
  }
}

bool ApplicationReader::CheckAttributesOf(const XmlTag& tag, TagUse& use) {
  const std::vector<AttributeRule> rules = context_.tags().Rules(tag);
  const std::vector<std::string> names = NamesOf(rules);
  bool is_usable = true;
  for (const AttributeRule& rule : rules) {
    const XmlAttribute* const attribute = use.xml.Attribute(rule.name);
    if (attribute == nullptr) {
      if (!rule.required) continue;
      is_usable = false;
      Report({.message = "<" + tag.name + "> has no '" + rule.name + "'",
              .hint = "add " + rule.name + "=\"…\""},
             use.xml.position(), use);
    } else if (auto good = CheckAttributeValue(rule, attribute->value); !good) {
      if (rule.required) is_usable = false;
      use.unusable.push_back(rule.name);
      Report(good.error(), attribute->value_position, use);
    }
  }
  Diagnostics problems;
  CheckAttributes(use.xml, names, problems);
  for (const Error& error : problems.errors()) {
    const auto is_here = [&](const XmlAttribute& each) { return each.position == error.position; };
    const auto unknown = std::ranges::find_if(use.xml.attributes(), is_here);
    if (context_.IsWorthReporting(unknown->name, names)) Report(error, unknown->position, use);
  }
  return is_usable;
}

FrameworkElement* ApplicationReader::Handle(const XmlTag& tag, const TagUse& use) {
  FrameworkElement* made = nullptr;
  context_.Attempt({"<" + tag.name + ">", use.xml.position(), &use.parent},
                   [&] { made = tag.handle(use); });
  if (made == nullptr) return nullptr;
  if (made != &use.parent && made->FindAnnotation<SourcePlace>() == nullptr) {
    made->Annotate(std::make_unique<SourcePlace>(use.xml.position()));
  }
  HandleAddedAttributes(tag, use, *made);
  return made;
}

void ApplicationReader::HandleAddedAttributes(const XmlTag& tag, const TagUse& use,
                                              FrameworkElement& made) {
  for (const AddedAttribute* added : context_.tags().AddedAttributes(tag.name)) {
    const XmlAttribute* const attribute = use.Find(added->rule.name);
    if (attribute == nullptr) continue;
    context_.Attempt(
        {attribute->name + "=\"" + attribute->value + "\"", attribute->position, &made},
        [&] { added->handle(*attribute, made, context_); });
  }
}

void ApplicationReader::Report(Error error, const SourcePosition& position, const TagUse& use) {
  if (error.path.empty()) error.path = use.path();
  context_.Report(std::move(error), position, use.parent);
}

}  // namespace runnel
