#include <algorithm>
#include <memory>
#include <optional>

#include "core/base/nearest_name.h"
#include "core/element/file_notes.h"
#include "core/xml/xml_reading.h"
#include "plugins/application_files/application_builder.h"

namespace runnel {

namespace {

/// Which of the tags within another are read: those that bring words come first.
enum class Round { kWords, kRest };

void ReadChildren(std::string_view tag, XmlElement element, FrameworkElement* parent, FrameworkElement& around,
                  Round round, BuildContext& context);

// What tells editors where the schema is.
bool IsForEditors(const std::string& attribute) {
  return attribute == "xmlns:xsi" || attribute == "xsi:noNamespaceSchemaLocation";
}

// The first attribute that nobody knows.
std::optional<Error> FirstUnknown(const std::vector<AttributeRule>& rules, const TagUse& use) {
  const std::vector<std::string> names = NamesOf(rules, &AttributeRule::name);
  for (const XmlAttribute& attribute : use.xml.attributes()) {
    if (std::ranges::count(names, attribute.name) > 0 || IsForEditors(attribute.name)) continue;
    if (!use.context.IsWorthReporting(attribute.name, names)) continue;
    return UnknownAttribute(use.xml, attribute, names);
  }
  return std::nullopt;
}

// The first that is missing, or whose value is none of its kind. An error without a message: what it
// says may come with a plugin that could not be loaded, which has been told.
std::optional<Error> WrongAttribute(const std::vector<AttributeRule>& rules, const TagUse& use) {
  for (const AttributeRule& rule : rules) {
    const XmlAttribute* const attribute = use.Find(rule.name);
    if (attribute == nullptr && rule.required) {
      return Error{.message = "<" + use.xml.name() + "> has no '" + rule.name + "'",
                   .position = use.xml.position(),
                   .hint = "add " + rule.name + "=\"…\"" + (rule.summary.empty() ? "" : ": " + rule.summary)};
    }
    const auto good = attribute != nullptr ? use.context.CheckValue(rule, attribute->value) : Result<void>();
    if (!good) return good.error().WithPosition(attribute->value_position);
  }
  return std::nullopt;
}

// Reports the first mistake of the tag itself. False: it cannot be handled.
bool CheckTag(const XmlTag& tag, const TagUse& use) {
  const std::vector<AttributeRule> rules = use.context.tags().Rules(tag);
  const std::optional<Error> wrong = WrongAttribute(rules, use);
  std::optional<Error> first = FirstUnknown(rules, use);
  if (!first) first = wrong;
  if (!first) first = TextWithin(use.xml);
  if (first && !first->message.empty()) use.Report(*first, first->position);
  return !wrong;
}

FrameworkElement* Handle(const XmlTag& tag, const TagUse& use) {
  FrameworkElement* made = nullptr;
  use.context.Attempt({"<" + tag.name + ">", use.xml.position(), &use.parent},
                      [&] { made = tag.handle ? tag.handle(use) : &use.parent; });
  if (made == nullptr) return nullptr;
  if (made != &use.parent && made->FindAnnotation<SourcePlace>() == nullptr) {
    made->Annotate(std::make_unique<SourcePlace>(use.xml.position()));
  }
  for (const AddedAttribute* added : use.context.tags().AddedAttributes(tag.name)) {
    const XmlAttribute* const attribute = use.Find(added->rule.name);
    if (attribute == nullptr) continue;
    use.context.Attempt({attribute->name + "=\"" + attribute->value + "\"", attribute->position, made},
                        [&] { added->handle(*attribute, *made, use.context); });
  }
  return made;
}

// `parent`: nullptr if there is none, and the tag is checked only; `around` is the nearest that is there.
void ReadTag(const XmlTag& tag, XmlElement element, FrameworkElement* parent, FrameworkElement& around,
             BuildContext& context) {
  const TagUse use{element, around, context};
  const bool is_right = CheckTag(tag, use);
  if (!is_right && tag.comes_first) context.MarkPluginMissing();
  FrameworkElement* const made = is_right && parent != nullptr ? Handle(tag, use) : nullptr;
  if (made == nullptr && tag.is_structure) context.MarkMissing(around, use.Find("name"));
  ReadChildren(tag.name, element, made, made != nullptr ? *made : around, Round::kRest, context);
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

void ReadMisplacedTag(XmlElement element, const std::vector<std::string>& known, FrameworkElement& around,
                      BuildContext& context) {
  const XmlTag* tag = context.tags().FindTag(element.name());
  const std::string hint = tag != nullptr             ? PlaceHint(*tag)
                           : known.empty()            ? "leave it out"
                           : element.name() == "stop" ? "what ends the run is called <quit/> now"
                                                      : NearestNameHint(element.name(), known);
  if (tag != nullptr || context.IsWorthReporting(element.name(), known)) {
    context.Report({.message = "no <" + element.name() + "> may stand in <" + element.parent()->name() + ">",
                    .position = element.position(),
                    .hint = hint},
                   element.position(), around);
  }
  // Also further up: a known tag in a wrong place is missing where it would be right.
  const XmlAttribute* const name = element.Attribute("name");
  for (const FrameworkElement* each = &around; each != nullptr; each = each->parent()) {
    context.MarkMissing(*each, name);
    if (name == nullptr) break;
  }
  if (tag == nullptr) tag = context.tags().FindTag(NearestName(element.name(), known));
  if (tag != nullptr) {
    ReadChildren(tag->name, element, nullptr, around, Round::kRest, context);
  }
}

void ReadChildren(std::string_view tag, XmlElement element, FrameworkElement* parent, FrameworkElement& around,
                  Round round, BuildContext& context) {
  const std::vector<std::string> known = context.tags().TagsIn(tag);
  for (const XmlElement child : element.children()) {
    if (std::ranges::count(known, child.name()) == 0) {
      if (round == Round::kRest) ReadMisplacedTag(child, known, around, context);
      continue;
    }
    const XmlTag& inner = *context.tags().FindTag(child.name());
    if (inner.comes_first == (round == Round::kWords)) {
      ReadTag(inner, child, parent, around, context);
    }
  }
}

// What brings words, but stands in a wrong place or is misspelt: what is unknown may be its.
void NoteMisplacedLoads(XmlElement element, BuildContext& context) {
  const std::vector<std::string> known = context.tags().TagsIn(element.name());
  for (const XmlElement child : element.children()) {
    const XmlTag* tag = context.tags().FindTag(child.name());
    if (tag == nullptr) tag = context.tags().FindTag(NearestName(child.name(), known));
    const bool is_lost = tag != nullptr && tag->comes_first && std::ranges::count(known, child.name()) == 0;
    if (is_lost) context.MarkPluginMissing();
    NoteMisplacedLoads(child, context);
  }
}

// What an extension has that nobody has asked for yet.
void BringTags(XmlElement element, const FrameworkElement& around, BuildContext& context) {
  for (const XmlElement child : element.children()) {
    if (const auto brought = context.tags().Bring(child.name()); !brought) {
      context.Report(brought.error(), child.position(), around);
      context.MarkPluginMissing();
    }
    BringTags(child, around, context);
  }
}

void ReadWords(XmlElement root, FrameworkElement& around, BuildContext& context) {
  ReadChildren(root.name(), root, &around, around, Round::kWords, context);
  BringTags(root, around, context);
  NoteMisplacedLoads(root, context);
}

void CheckParameters(PartUse& part, BuildContext& context) {
  for (const auto& [name, declared] : part.declared) {
    const bool has_value = declared.Find("value") || declared.Find("config") || declared.Find("command_line");
    if (has_value || part.given.contains(name)) continue;
    const SourcePosition at = declared.xml.position();
    context.Report({.message = "the parameter '" + name + "' of " + at.file + " has no value",
                    .hint = "add <parameter name=\"" + name + "\" value=\"…\"/>; " + at.file + " declares it in line " +
                            std::to_string(at.line)},
                   part.tag.position(), part.group);
  }
  context.Defer(BuildStage::kChecks, [&part, &context] {
    if (!context.IsWhole(part.group)) return;  // what is missing may take it
    for (const auto& [name, declared] : part.declared) {
      if (part.used.contains(name)) continue;
      context.Warn({.message = "nothing takes its value from the parameter '" + name + "'",
                    .hint = "add from=\"" + name + "\" to a <parameter> of a module"},
                   declared.Get("name").value_position, part.group);
    }
  });
}

}  // namespace

FrameworkElement* ReadApplication(XmlElement root, BuildContext& context) {
  const XmlTag* const tag = context.tags().FindTag(root.name());
  FrameworkElement& top = context.runtime().root();
  if (tag == nullptr || !tag->parents.empty() || tag->is_part) {
    const bool is_part = tag != nullptr && tag->is_part;
    context.Report({.message = "<" + root.name() + "> is not an application",
                    .hint = is_part ? "an application uses it by <group name=\"…\" type=\"…\">"
                                    : "an application file begins with <application>"},
                   root.position(), top);
    return nullptr;
  }
  // Plugins may bring attributes of the root tag.
  ReadWords(root, top, context);
  const TagUse use{root, top, context};
  FrameworkElement* const made = CheckTag(*tag, use) ? Handle(*tag, use) : nullptr;
  ReadChildren(tag->name, root, made, made != nullptr ? *made : top, Round::kRest, context);
  return made;
}

Result<void> ReadGroupType(const XmlAttribute& type, XmlElement tag, FrameworkElement& group, BuildContext& context) {
  const auto opened = context.parts().Open(type, tag, group);
  if (!opened) return opened.error();
  PartUse& part = **opened;
  group.Annotate(std::make_unique<PartInstance>(part.root.position().file));
  ReadWords(part.root, group, context);
  CheckTag(*context.tags().FindTag(part.root.name()), {part.root, group, context});
  ReadChildren(part.root.name(), part.root, &group, group, Round::kRest, context);
  context.parts().Close();
  // When all that the tag gives it has been read.
  context.Defer(BuildStage::kParameters, [&part, &context] { CheckParameters(part, context); });
  return {};
}

}  // namespace runnel
