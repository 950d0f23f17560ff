#pragma once

#include <string>

#include "core/base/result.h"
#include "core/element/configurable.h"
#include "plugins/foxglove/internal/client_message.h"
#include "plugins/structure/change.h"

namespace runnel::internal {

/// {"name":…,"value":…} as the protocol has it: switches and numbers as such (with the type "float64" for
/// those that are no whole ones), lists as lists ("float64_array", "byte_array"), structures as objects,
/// everything else (texts, names of enumerations, "20ms") as its text. NaN and infinity are null. A value
/// whose type throws is what it has thrown, as a text.
[[nodiscard]] std::string ParameterJson(const std::string& name, const Configurable& parameter);

/// What a client sets, at `path`. What it leaves out of a structure is as it is now. Texts are taken as the
/// text format. Errors: the value is none of the type.
[[nodiscard]] Result<SetParameter> SettingOf(const SetParametersMessage::Item& item,
                                             const std::string& path,
                                             const Configurable& parameter);

}  // namespace runnel::internal
