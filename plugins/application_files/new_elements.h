#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/port/proxy_port.h"
#include "core/xml/xml_writing.h"
#include "plugins/application_files/saving.h"

namespace runnel::internal {

/// The tags that give again what is in the tree, as if no file had been there before.

[[nodiscard]] NewElement ModuleElement(FrameworkElement& module, Saving& saving);
[[nodiscard]] NewElement PortElement(const ProxyPort& port, Saving& saving);
/// With all that is in it. `tag` is "group", or "application".
[[nodiscard]] NewElement GroupElement(std::string_view tag, FrameworkElement& group,
                                      Saving& saving);
/// Of the connections of `home` that no tag says yet; those of one port together.
[[nodiscard]] std::vector<NewElement> ConnectElements(FrameworkElement& home, Saving& saving);

/// Tags of the kinds that say themselves what has to be there, in the order of their names.
[[nodiscard]] std::vector<NewElement> SavedTagElements(std::string_view parent_tag,
                                                       FrameworkElement& parent, Saving& saving);
/// One of them, without what a file need not say.
[[nodiscard]] NewElement SavedTagElement(const std::string& name, const SavedTag& tag);

using Attributes = std::vector<std::pair<std::string, std::string>>;
/// "queue" and "on_full", as far as they are not as always.
[[nodiscard]] Attributes ConnectAttributes(const ConnectOptions& options);
/// Whether a module or group of the application is for a file at all.
[[nodiscard]] bool IsSaved(const FrameworkElement& element);

}  // namespace runnel::internal
