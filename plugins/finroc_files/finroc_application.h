#pragma once

#include <filesystem>

#include "core/xml/xml_document.h"
#include "plugins/application_files/application_builder.h"

namespace runnel {

/// Whether this is an application file of FINROC: `<Finstructable>`, in older ones
/// `<FinstructableGroup>`.
[[nodiscard]] bool IsFinrocFile(XmlElement root);

/// Builds what a FINROC application file describes, as far as it has a counterpart here; whatever
/// has none is a warning with its line, and left out. Names are in snake case: "Sensor Input" of
/// "NoiseFilter Front" is noise_filter_front/sensor_input.
///
///     FINROC                                          here
///     element group="finroc_projects_a" type="BcDe"   module of type "a/bc_de"; plugin "a" is loaded
///     element type="Group" with an "XML file"         group, with what that file says
///     element type="ThreadContainer"                  group, and a thread for all in it
///     edge src dest                                   connection
///     interface of a group                            interface ports
///     parameter link config cmdline default           value of the parameter, flat or in nested
///                                                     <parameter_links>
///
/// Without a thread container all modules are run by one thread, every 40 ms as FINROC's are.
///
/// Threads, errors: as BuildApplication().
[[nodiscard]] BuildOutcome BuildFinrocApplication(const XmlDocument& document, const std::filesystem::path& file,
                                                  const BuildTools& tools, BuildMode mode);

}  // namespace runnel
