#include "plugins/runtime_construction/application_reader.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/xml/xml_reading.h"
#include "plugins/runtime_construction/name_check.h"
#include "plugins/runtime_construction/source_place.h"

namespace runnel {

namespace {

std::vector<std::string> NamesOf(const std::vector<AttributeRule>& rules) {
  std::vector<std::string> names;
  for (const AttributeRule& rule : rules) names.push_back(rule.name);
  return names;
}

// What tells editors where the schema is.
bool IsForEditors(const std::string& attribute) {
  return attribute == "xmlns:xsi" || attribute == "xsi:noNamespaceSchemaLocation";
}

// Where a known tag would be right.
std::string PlaceHint(const XmlTag& tag) {
  std::string places;
  for (const std::string& parent : tag.parents) {
    places += (places.empty() ? "it stands in <" : " or <") + parent + ">";
  }
  if (places.empty()) places = "it is the root of a file";
  return tag.summary.empty() ? places : places + ": " + tag.summary;
}

}  // namespace

ApplicationReader::ApplicationReader(BuildContext& context) : context_(context) {
  context.set_part_reader(
      [this](const XmlAttribute& type, XmlElement part_tag, FrameworkElement& group) {
        return ReadPart(type, part_tag, group);
      });
}

FrameworkElement* ApplicationReader::Read(XmlElement root) {
  const XmlTag* const tag = context_.tags().FindTag(root.name());
  FrameworkElement& top = context_.runtime().root();
  if (tag == nullptr || !tag->parents.empty() || tag->is_part) {
    const bool is_part = tag != nullptr && tag->is_part;
    context_.Report({.message = "<" + root.name() + "> is not an application",
                     .hint = is_part ? "an application uses it by <group name=\"…\" type=\"…\">"
                                     : "an application file begins with <application>"},
                    root.position(), top);
    return nullptr;
  }
  TagUse use{root, top, context_};
  FrameworkElement* made = nullptr;
  // Not before plugins have been loaded: they may bring attributes of the root tag.
  ReadChildren(*tag, root, top, Mode::kHandle, true);
  NoteMisplacedLoads(root);
  if (CheckAttributesOf(*tag, use)) made = Handle(*tag, use);
  FrameworkElement& inside = made != nullptr ? *made : top;
  const Mode mode = made != nullptr ? Mode::kHandle : Mode::kCheckOnly;
  CheckContents(*tag, root, inside);
  ReadChildren(*tag, root, inside, mode, false);
  return made;
}

Result<void> ApplicationReader::ReadPart(const XmlAttribute& type, XmlElement part_tag,
                                         FrameworkElement& group) {
  const auto part = context_.parts().Open(type, part_tag, group);
  if (!part) return part.error();
  const XmlElement root = (*part)->root;
  const XmlTag& tag = *context_.tags().FindTag(root.name());
  group.Annotate(std::make_unique<PartInstance>(root.position().file));
  TagUse use{root, group, context_};
  ReadChildren(tag, root, group, Mode::kHandle, true);
  NoteMisplacedLoads(root);
  CheckAttributesOf(tag, use);
  CheckContents(tag, root, group);
  ReadChildren(tag, root, group, Mode::kHandle, false);
  context_.parts().Close();
  // When all that the tag gives it has been read.
  context_.Defer(BuildStage::kParameters, [this, part = *part] { CheckParameters(*part); });
  return {};
}

void ApplicationReader::CheckParameters(PartUse& part) {
  for (const auto& [name, declared] : part.declared) {
    const bool has_value =
        declared.Says("value") || declared.Says("config") || declared.Says("command_line");
    if (has_value || part.given.contains(name)) continue;
    const SourcePosition at = declared.xml.position();
    context_.Report({.message = "the parameter '" + name + "' of " + at.file + " has no value",
                     .hint = "add <parameter name=\"" + name + "\" value=\"…\"/>; " + at.file +
                             " declares it in line " + std::to_string(at.line)},
                    part.tag.position(), part.group);
  }
  context_.Defer(BuildStage::kChecks, [this, &part] {
    for (const auto& [name, declared] : part.declared) {
      if (part.used.contains(name)) continue;
      context_.Warn({.message = "nothing takes its value from the parameter '" + name + "'",
                     .hint = "add from=\"" + name + "\" to a <parameter> of a module"},
                    declared.Get("name").value_position, part.group);
    }
  });
}

// What stands in a wrong place, or nearly is, may have brought what is unknown elsewhere.
void ApplicationReader::NoteMisplacedLoads(XmlElement element) {
  const std::vector<std::string> known = context_.tags().TagsIn(element.name());
  for (const XmlElement child : element.children()) {
    const XmlTag* tag = context_.tags().FindTag(child.name());
    const bool is_known = std::ranges::find(known, child.name()) != known.end();
    if (tag == nullptr) tag = context_.tags().FindTag(NearestName(child.name(), known));
    if (tag != nullptr && tag->comes_first && !is_known) context_.MarkPluginMissing();
    NoteMisplacedLoads(child);
  }
}

void ApplicationReader::ReadChildren(const XmlTag& tag, XmlElement element,
                                     FrameworkElement& parent, Mode mode, bool first) {
  const std::vector<std::string> known = context_.tags().TagsIn(tag.name);
  for (const XmlElement child : element.children()) {
    const bool is_known = std::ranges::find(known, child.name()) != known.end();
    if (!is_known) {
      if (!first) ReadUnknownTag(child, known, parent, mode);
      continue;
    }
    const XmlTag& inner = *context_.tags().FindTag(child.name());
    if (inner.comes_first == first) ReadTag(inner, child, parent, mode);
  }
}

void ApplicationReader::ReadUnknownTag(XmlElement element, const std::vector<std::string>& known,
                                       FrameworkElement& parent, Mode mode) {
  const XmlTag* const meant = context_.tags().FindTag(NearestName(element.name(), known));
  if (meant != nullptr && !meant->comes_first) {
    ReadTag(*meant, element, parent, mode);
  } else if (const XmlAttribute* name = element.Attribute("name")) {
    // Also further up: a known tag in a wrong place is missing where it would be right.
    for (const FrameworkElement* each = &parent; each != nullptr; each = each->parent()) {
      context_.MarkMissing(*each, name->value);
    }
  } else {
    context_.MarkIncomplete(parent);
  }
}

void ApplicationReader::ReadTag(const XmlTag& tag, XmlElement element, FrameworkElement& parent,
                                Mode mode) {
  TagUse use{element, parent, context_};
  FrameworkElement* made = nullptr;
  const bool is_usable = CheckAttributesOf(tag, use);
  if (!is_usable && tag.comes_first) context_.MarkPluginMissing();
  if (mode == Mode::kHandle) made = is_usable ? Handle(tag, use) : Salvage(tag, use);
  if (const XmlAttribute* name = use.Find("name"); name != nullptr && made == nullptr) {
    context_.MarkMissing(parent, name->value);
  }
  FrameworkElement& inside = made != nullptr ? *made : parent;
  CheckContents(tag, element, inside);
  ReadChildren(tag, element, inside, made != nullptr ? Mode::kHandle : Mode::kCheckOnly, false);
}

void ApplicationReader::CheckContents(const XmlTag& tag, XmlElement element,
                                      FrameworkElement& parent) {
  const std::vector<std::string> known = context_.tags().TagsIn(tag.name);
  Diagnostics problems;
  CheckChildren(element, known, problems);
  for (Error error : problems.errors()) {
    const auto is_here = [&](XmlElement child) { return child.position() == error.position; };
    const auto wrong = std::ranges::find_if(element.children(), is_here);
    if (wrong != element.children().end()) {
      const XmlTag* const misplaced = context_.tags().FindTag(wrong->name());
      if (misplaced != nullptr) error.hint = PlaceHint(*misplaced);
      if (misplaced == nullptr && !context_.IsWorthReporting(wrong->name(), known)) continue;
    }
    context_.Report(std::move(error), element.position(), parent);
  }
}

bool ApplicationReader::CheckAttributesOf(const XmlTag& tag, TagUse& use) {
  const std::vector<AttributeRule> rules = context_.tags().Rules(tag);
  ReadMisspeltAttributes(rules, use);
  bool is_usable = true;
  for (const AttributeRule& rule : rules) {
    if (!CheckAttribute(rule, use)) is_usable = false;
  }
  return is_usable;
}

void ApplicationReader::ReadMisspeltAttributes(const std::vector<AttributeRule>& rules,
                                               TagUse& use) {
  const std::vector<std::string> names = NamesOf(rules);
  Diagnostics problems;
  CheckAttributes(use.xml, names, problems);
  for (const Error& error : problems.errors()) {
    const auto is_here = [&](const XmlAttribute& each) { return each.position == error.position; };
    const auto unknown = std::ranges::find_if(use.xml.attributes(), is_here);
    if (IsForEditors(unknown->name)) continue;
    std::vector<std::string> free = names;
    std::erase_if(free, [&](const std::string& name) { return use.Says(name); });
    if (const std::string meant = NearestName(unknown->name, free); !meant.empty()) {
      XmlAttribute stand_in = *unknown;
      stand_in.name = meant;
      use.stand_ins.push_back(&context_.Keep(std::move(stand_in)));
    }
    if (context_.IsWorthReporting(unknown->name, names)) Report(error, unknown->position, use);
  }
}

// False if the tag cannot be handled because of this attribute.
bool ApplicationReader::CheckAttribute(const AttributeRule& rule, TagUse& use) {
  const bool is_name = rule.kind == AttributeKind::kNewName;
  if (const XmlAttribute* const attribute = use.Find(rule.name)) {
    const auto good = CheckAttributeValue(rule, attribute->value);
    if (good) return true;
    std::erase(use.stand_ins, attribute);
    use.unusable.push_back(rule.name);
    Report(good.error(), attribute->value_position, use);
  } else {
    if (!rule.required) return true;
    Report(
        {.message = "<" + use.xml.name() + "> has no '" + rule.name + "'",
         .hint = "add " + rule.name + "=\"…\"" + (rule.summary.empty() ? "" : ": " + rule.summary)},
        use.xml.position(), use);
  }
  if (is_name) GiveStandInName(use);
  return is_name || !rule.required;
}

void ApplicationReader::GiveStandInName(TagUse& use) {
  context_.MarkIncomplete(use.parent);
  const SourcePosition position = use.xml.position();
  use.stand_ins.push_back(&context_.Keep({"name", "", position, position}));
}

FrameworkElement* ApplicationReader::Salvage(const XmlTag& tag, const TagUse& use) {
  if (tag.salvage) {
    context_.Attempt({"<" + tag.name + ">", use.xml.position(), &use.parent},
                     [&] { tag.salvage(use); });
  }
  return nullptr;
}

FrameworkElement* ApplicationReader::Handle(const XmlTag& tag, const TagUse& use) {
  FrameworkElement* made = nullptr;
  context_.Attempt({"<" + tag.name + ">", use.xml.position(), &use.parent},
                   [&] { made = tag.handle(use); });
  if (made == nullptr) return nullptr;
  MarkIfStandIn(*made, use);
  // Connections that were meant for it will not find it.
  if (IsStandIn(*made)) context_.Excuse(*made);
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
