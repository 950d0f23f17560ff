#include <algorithm>
#include <string>

#include "core/port/parameter_input.h"
#include "core/types/type_info.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_tags/tag_list.h"
#include "plugins/structure/value_by_hand.h"

namespace runnel::internal {

namespace {

// One tag that says what is to be done, with all that reading it needs.
struct ReactionUse : TagUse {
  Reaction& reaction;

  void Describe(const std::string& done) const {
    reaction.description += (reaction.description.empty() ? "" : ", ") + done;
  }
  [[nodiscard]] Port* FindPortAt(const XmlAttribute& attribute, PathKind end) const {
    return SearchPort(PathIn(attribute, parent), end, context);
  }
};

bool CanFeed(const Port& source, const Port& input, const XmlAttribute& at, const ReactionUse& use) {
  // What the connection that is left, or is there already, makes of the values.
  const ConnectOptions options = source.OptionsTo(input);
  const auto possible = Port::CheckEnds(source, input, {.part = options.part, .convert = options.convert});
  if (!possible) use.Report(possible.error(), at.value_position);
  return possible.has_value();
}

void ReadSwitch(const ReactionUse& use) {
  const XmlAttribute* const from_name = use.Find("from");
  const XmlAttribute* const to_name = use.Find("to");
  if (from_name == nullptr && to_name == nullptr) {
    use.Report({.message = "<switch> says neither where the input is fed from, nor from where else",
                .hint = "add from=\"…\", the source that is to be left, and to=\"…\""},
               use.xml.position());
    return;
  }
  Port* const input = use.FindPortAt(use.Get("input"), PathKind::kInput);
  Port* const from = from_name ? use.FindPortAt(*from_name, PathKind::kOutput) : nullptr;
  Port* const to = to_name ? use.FindPortAt(*to_name, PathKind::kOutput) : nullptr;
  if (input == nullptr || (from_name && !from) || (to_name && !to)) return;
  if (from != nullptr && !CanFeed(*from, *input, *from_name, use)) return;
  if (to != nullptr && !CanFeed(*to, *input, *to_name, use)) return;
  ConnectOptions options;
  for (const Port* source : input->incoming()) {
    const ConnectOptions each = source->OptionsTo(*input);  // a switch keeps its queue, or that it pulls
    if (each.queue >= options.queue) options = each;
  }
  if (from != nullptr) use.reaction.changes.push_back(DisconnectPorts{from->path(), input->path()});
  if (to != nullptr) {
    options.pull = options.pull && to->is_pullable();
    options.when_present = false;  // who says when it is switched is this rule
    if (&to->type() == &input->type()) {
      options.part.clear();
      options.convert.clear();
    }
    use.reaction.changes.push_back(ConnectPorts{to->path(), input->path(), options});
  }
  use.Describe("switched " + input->path() + (from ? " from " + from->path() : "") + (to ? " to " + to->path() : ""));
}

void ReadSet(const ReactionUse& use) {
  const XmlAttribute& value = use.Get("value");
  const auto* const target = SearchSettable(use.Get("parameter"), value, use.parent, use.context);
  if (target == nullptr) return;
  use.reaction.changes.push_back(SetParameter{target->path(), value.value});
  use.Describe("set " + target->path() + " to " + value.value);
}

void ReadReplace(const ReactionUse& use) {
  const std::string& type = use.Get("by").value;
  const auto* const found = SearchElement(PathIn(use.Get("module"), use.parent), use.context);
  if (found == nullptr) return;
  use.reaction.changes.push_back(ReplaceModule{found->path(), type});
  use.Describe("replaced " + found->path() + " by a new " + type);
}

void ReadPublish(const ReactionUse& use) {
  const Port* const port = use.FindPortAt(use.Get("port"), PathKind::kElement);
  if (port == nullptr) return;
  if (auto may = CheckMayBeSet(*port); !may) return use.Report(may.error(), use.Get("port").value_position);
  const XmlAttribute* const value = use.Find("value");
  const auto made = value ? ValueOf(*port, value->value) : SafeValueOf(*port);
  if (!made) return use.Report(made.error(), value ? value->value_position : use.xml.position());
  use.reaction.published.push_back({port->path(), value ? std::optional(value->value) : std::nullopt});
  use.Describe("published " + (value ? value->value : "the default") + " at " + port->path());
}

}  // namespace

std::vector<XmlTag> ReactionTags() {
  const std::vector<std::string> parents{"on_stale", "on_stuck", "on_pause", "on_fault", "otherwise"};
  return {
      {.name = "switch",
       .summary = "feeds an input from another source",
       .parents = parents,
       .attributes = {PathRule("input", true), PathRule("from", false, "the source that is left; without it, none is"),
                      PathRule("to", false, "the source that comes; without it, none does")}},
      {.name = "publish",
       .summary = "has a port's readers find a value until all is well again, instead of what is published",
       .parents = parents,
       .attributes = {PathRule("port", true),
                      {.name = "value", .summary = "without it, the port's default, or its type's"}}},
      {.name = "set",
       .summary = "sets a parameter",
       .parents = parents,
       .attributes = {PathRule("parameter", true), {.name = "value", .required = true}}},
      {.name = "replace",
       .summary = "puts a new module in the place of another",
       .parents = parents,
       .attributes = {PathRule("module", true),
                      KindRule("by", AttributeKind::kModuleType, "a type, as `runnel modules` lists them", true)}},
      {.name = "quit", .summary = "ends the run", .parents = parents}};
}

Reaction ReadReaction(XmlElement xml, FrameworkElement& base, BuildContext& context) {
  static const std::vector<XmlTag> tags = ReactionTags();
  Reaction reaction;
  for (const XmlElement child : xml.children()) {
    const auto tag = std::ranges::find(tags, child.name(), &XmlTag::name);
    const auto lacks = [&](const AttributeRule& rule) {
      return rule.required && child.Attribute(rule.name) == nullptr;
    };
    if (tag == tags.end() || std::ranges::any_of(tag->attributes, lacks)) continue;  // which has been said
    const ReactionUse use{{child, base, context}, reaction};
    if (child.name() == "switch") ReadSwitch(use);
    if (child.name() == "publish") ReadPublish(use);
    if (child.name() == "set") ReadSet(use);
    if (child.name() == "replace") ReadReplace(use);
    if (child.name() == "quit") reaction.ends_run = true;
  }
  return reaction;
}

}  // namespace runnel::internal
