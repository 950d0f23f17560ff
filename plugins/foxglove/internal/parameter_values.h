#pragma once

#include <string>

#include "core/base/result.h"
#include "plugins/foxglove/internal/client_message.h"

namespace runnel {
class TypeInfo;
}  // namespace runnel

namespace runnel::internal {

/// Appends {"name":…,"value":…} as the protocol has it: switches and numbers as such (with the type
/// "float64" for those that are no whole ones), lists as lists ("float64_array", "byte_array"),
/// structures as objects, everything else (texts, names of enumerations, "20ms") as its text. NaN and
/// infinity are null.
void AppendParameter(const std::string& name, const TypeInfo& type, const std::string& text,
                     std::string& json);

/// The text format of what a client sets. `text` is that of the value now, which keeps the fields that the
/// client leaves out. Texts are taken as the text format. Errors: the value is none of the type.
[[nodiscard]] Result<std::string> TextOfItem(const SetParametersMessage::Item& item,
                                             const TypeInfo& type, const std::string& text);

}  // namespace runnel::internal
