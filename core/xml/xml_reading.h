#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/xml/xml_document.h"

namespace runnel {

/// How readers of any XML format take an element apart, telling the user all that is wrong with it.
/// Every function adds to `diagnostics` what it complains about, with file, line and column.

/// A finite decimal number that takes all of `text`; white space round it and a leading '+' are
/// allowed, the locale does not matter. Nothing if it is none.
[[nodiscard]] std::optional<double> ParseNumber(std::string_view text);

/// Of an attribute that must be there; nothing (and an error) if it is missing or no number.
std::optional<double> ReadNumber(XmlElement element, std::string_view attribute, Diagnostics& diagnostics);
/// Of an attribute that may be missing. `fallback` also stands in for what is no number.
double ReadNumberOr(XmlElement element, std::string_view attribute, double fallback, Diagnostics& diagnostics);

/// Of an attribute that must be there; nullptr (and an error) if it is missing. It may be empty.
const std::string* ReadText(XmlElement element, std::string_view attribute, Diagnostics& diagnostics);

/// What is wrong with an attribute whose name is not among `known`.
[[nodiscard]] Error UnknownAttribute(XmlElement element, const XmlAttribute& attribute,
                                     std::span<const std::string> known);
/// What is wrong with text between the tags; nothing if there is none.
[[nodiscard]] std::optional<Error> TextWithin(XmlElement element);

/// Complains about each attribute whose name is not among `known`.
void CheckAttributes(XmlElement element, std::span<const std::string> known, Diagnostics& diagnostics);
/// Complains about each child whose name is not among `known`, and about text between the tags.
void CheckChildren(XmlElement element, std::span<const std::string> known, Diagnostics& diagnostics);

}  // namespace runnel
