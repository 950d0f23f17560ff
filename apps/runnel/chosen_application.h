#pragma once

#include <memory>

#include "apps/runnel/command_line.h"
#include "plugins/application/application_options.h"
#include "plugins/viewers/viewers.h"

namespace runnel::program {

/// What the user says of an application that is only looked at, with the words and the forms of files that the
/// program knows.
[[nodiscard]] ApplicationOptions OptionsOf(const ApplicationArguments& arguments);
/// The same for one that runs, and that these viewers are shown.
[[nodiscard]] ApplicationOptions OptionsOf(const ApplicationArguments& arguments,
                                           const std::shared_ptr<Viewers>& viewers);

}  // namespace runnel::program
