#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/element/framework_element.h"
#include "core/port/port.h"
#include "core/types/any_value.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_files/xml_tag.h"
#include "plugins/supervision/supervision_rules.h"

namespace runnel {

// The words that every application file may use.

[[nodiscard]] XmlTag ApplicationTag();
[[nodiscard]] XmlTag ClockTag();
[[nodiscard]] XmlTag ConnectTag();
[[nodiscard]] XmlTag DrivingTag();
[[nodiscard]] XmlTag GroupTag();
[[nodiscard]] XmlTag GroupTypeTag();
[[nodiscard]] XmlTag InputTag();
[[nodiscard]] XmlTag LoadTag();
[[nodiscard]] XmlTag LogTag();
[[nodiscard]] XmlTag ModuleTag();
[[nodiscard]] XmlTag ParameterTag();
[[nodiscard]] XmlTag PortTag();
[[nodiscard]] XmlTag ThreadTag();
/// thread="control", of <application>, <group> and <module>.
[[nodiscard]] AddedAttribute ThreadAttribute(std::string tag);
/// stuck_after="2s", of <application> and <thread>.
[[nodiscard]] AddedAttribute StuckAfterAttribute(std::string tag);
/// tags="safety hidden", of <application>, <group> and <module>.
[[nodiscard]] AddedAttribute TagsAttribute(std::string tag);

/// config="/car/left", of the same.
[[nodiscard]] AddedAttribute ConfigurationAttribute(std::string tag);

/// An attribute that names an element of the tree.
[[nodiscard]] inline AttributeRule PathRule(const char* name, bool required, const char* summary = "") {
  return {.name = name, .kind = AttributeKind::kPath, .required = required, .summary = summary, .names_element = true};
}
[[nodiscard]] inline AttributeRule YesNoRule(const char* name, const char* summary) {
  return WordRule(name, {"false", "true"}, summary);
}

namespace internal {

/// For XmlTag::handle: has a tag read when that stage of the building has come.
template <BuildStage kStage, void (*kRead)(const TagUse& use)>
FrameworkElement* ReadAt(const TagUse& use) {
  use.context.Defer(kStage, [use] { kRead(use); });
  return &use.parent;
}

/// Which of the words the attribute says; the first if it is not there.
template <typename Kind>
Kind Chosen(const TagUse& use, const char* attribute, const std::vector<std::string>& words) {
  return static_cast<Kind>(std::ranges::find(words, use.xml.TextOr(attribute, words.front())) - words.begin());
}

/// A value of the port's type; nothing after reporting that the text is none.
[[nodiscard]] AnyValue ReadValue(const TagUse& use, const XmlAttribute& text, const Port& port);

/// The tags <on_fault>, <stop_button>, <latency> … that say what is watched and measured.
[[nodiscard]] std::vector<XmlTag> WatchingTags();
/// The tags <publish>, <switch>, <set>, <replace> and <quit>, which are read by the tag that they stand in.
[[nodiscard]] std::vector<XmlTag> ReactionTags();

/// What the tags directly within `xml` say is to be done; mistakes are reported. Paths start at
/// `base`. When connections have been made.
[[nodiscard]] Reaction ReadReaction(XmlElement xml, FrameworkElement& base, BuildContext& context);

/// Sets the parameter that a <parameter> names, of `module`, to the strongest of what the tag says. `scope`: what `from`
/// is looked up from, upwards. All that it says is checked, so that a mistake shows even when it is overridden.
/// `may_wait`: a parameter that stands for what is not there yet may be set once it is.
void SetValue(const TagUse& use, const FrameworkElement& module, const FrameworkElement& scope, bool may_wait = true);

/// That is what the files and the command line have said of it.
void NoteLoaded(const ConfigurableElement& parameter);

/// Takes the part of the values that is meant off the path of a port: "x" off "world/pose.x".
[[nodiscard]] std::string TakePart(PathUse& use);
/// From the root, also if nothing is there.
[[nodiscard]] std::string AbsolutePath(const PathUse& use);

// Saving of <connect>.

void UpdateConnect(XmlElement tag, FrameworkElement& group, FileUpdate& update);
/// Of the connections that no tag says yet; those of one port together.
[[nodiscard]] std::vector<NewElement> MissingConnections(const XmlElement* tag, FrameworkElement& home, Saving& saving,
                                                         FileUpdate* update);

}  // namespace internal

}  // namespace runnel
