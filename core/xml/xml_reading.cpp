#include "core/xml/xml_reading.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/characters.h"
#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "core/xml/internal/xml_scanner.h"

namespace runnel {

namespace {

std::optional<double> NumberOf(const XmlAttribute& attribute, Diagnostics& diagnostics) {
  const std::optional<double> number = ParseNumber(attribute.value);
  if (!number) {
    diagnostics.Add({.message = attribute.name + "=\"" + attribute.value + "\" is no number",
                     .position = attribute.value_position,
                     .hint = "write a finite decimal number, for example -1.5"});
  }
  return number;
}

void ReportMissing(XmlElement element, std::string_view attribute, Diagnostics& diagnostics) {
  diagnostics.Add({.message = "<" + element.name() + "> has no '" + std::string(attribute) + "'",
                   .position = element.position(),
                   .hint = "add " + std::string(attribute) + "=\"…\""});
}

/// A name already given cannot be what the user meant by another one.
std::vector<std::string> NotYetGiven(XmlElement element, std::span<const std::string> known) {
  std::vector<std::string> free;
  for (const std::string& name : known) {
    if (element.Attribute(name) == nullptr) free.push_back(name);
  }
  return free;
}

}  // namespace

std::optional<double> ParseNumber(std::string_view text) {
  text = internal::WithoutXmlSpace(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto number = NumberIn<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<double> ReadNumber(XmlElement element, std::string_view attribute, Diagnostics& diagnostics) {
  if (const XmlAttribute* found = element.Attribute(attribute)) {
    return NumberOf(*found, diagnostics);
  }
  ReportMissing(element, attribute, diagnostics);
  return std::nullopt;
}

double ReadNumberOr(XmlElement element, std::string_view attribute, double fallback, Diagnostics& diagnostics) {
  const XmlAttribute* const found = element.Attribute(attribute);
  return found == nullptr ? fallback : NumberOf(*found, diagnostics).value_or(fallback);
}

const std::string* ReadText(XmlElement element, std::string_view attribute, Diagnostics& diagnostics) {
  if (const XmlAttribute* found = element.Attribute(attribute)) return &found->value;
  ReportMissing(element, attribute, diagnostics);
  return nullptr;
}

Error UnknownAttribute(XmlElement element, const XmlAttribute& attribute, std::span<const std::string> known) {
  const std::vector<std::string> candidates = NotYetGiven(element, known);
  return {.message = "<" + element.name() + "> knows no '" + attribute.name + "'",
          .position = attribute.position,
          .hint = candidates.empty() ? "leave it out" : NearestNameHint(attribute.name, candidates)};
}

std::optional<Error> TextWithin(XmlElement element) {
  const std::string& text = element.text();
  if (text.empty()) return std::nullopt;
  return Error{.message = "no text may stand in <" + element.name() + ">",
               .position = element.text_position(),
               .hint = "leave out '" + text.substr(0, WholeCharacters(text, 40)) + "'"};
}

void CheckAttributes(XmlElement element, std::span<const std::string> known, Diagnostics& diagnostics) {
  for (const XmlAttribute& attribute : element.attributes()) {
    if (std::ranges::count(known, attribute.name) > 0) continue;
    diagnostics.Add(UnknownAttribute(element, attribute, known));
  }
}

void CheckChildren(XmlElement element, std::span<const std::string> known, Diagnostics& diagnostics) {
  for (const XmlElement child : element.children()) {
    if (std::ranges::count(known, child.name()) > 0) continue;
    diagnostics.Add({.message = "no <" + child.name() + "> may stand in <" + element.name() + ">",
                     .position = child.position(),
                     .hint = known.empty() ? "leave it out" : NearestNameHint(child.name(), known)});
  }
  if (auto text = TextWithin(element)) diagnostics.Add(std::move(*text));
}

}  // namespace runnel
