#pragma once

#include <string>

#include "plugins/application_files/xml_tag.h"

namespace runnel {

/// Adds the words that every application file may use, each made in the file named after it.
void AddBuiltInTags(XmlTagRegistry& tags);

[[nodiscard]] XmlTag ApplicationTag();
[[nodiscard]] XmlTag ClockTag();
[[nodiscard]] XmlTag ConnectTag();
[[nodiscard]] XmlTag GroupTag();
[[nodiscard]] XmlTag GroupTypeTag();
[[nodiscard]] XmlTag LoadTag();
[[nodiscard]] XmlTag ModuleTag();
[[nodiscard]] XmlTag OnFaultTag();
[[nodiscard]] XmlTag OnStaleTag();
[[nodiscard]] XmlTag OtherwiseTag();
[[nodiscard]] XmlTag ParameterTag();
[[nodiscard]] XmlTag PortTag();
[[nodiscard]] XmlTag ThreadTag();
/// thread="control", of <application>, <group> and <module>.
[[nodiscard]] AddedAttribute ThreadAttribute(std::string tag);

}  // namespace runnel
