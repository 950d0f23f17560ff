#include "plugins/application/what_is_lost.h"

#include <system_error>
#include <utility>

#include "core/port/port.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/application_files/saving/saving.h"
#include "plugins/parameters/file_path.h"
#include "plugins/structure/element_state.h"

namespace runnel::internal {

namespace {
// A pipe that nobody writes into would keep whoever reads it.
Error IsNoFile(const std::filesystem::path& file) {
  return {.message = "is there already, and is no file", .position = {file.string()}, .hint = "choose another name"};
}
}  // namespace

std::optional<Error> WhatIsLost(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return {};
  if (!std::filesystem::is_regular_file(file, ignored)) return IsNoFile(file);
  std::string what = "is there already";
  const auto document = XmlDocument::Load(file);
  if (document && document->root().name() == "application") {
    what = "is the file of the application '" + document->root().TextOr("name") + "'";
  }
  return Error{.message = what + ", and would be lost",
               .position = {file.string()},
               .hint = "choose another name, or say --overwrite"};
}

bool IsOwnFile(const FrameworkElement& application, const std::filesystem::path& file) {
  const auto* const source = application.FindAnnotation<ApplicationSource>();
  return file.empty() || (source != nullptr && Whole(source->file) == Whole(file));
}

Result<ServiceHooks::SaveDifference> TextToSave(FrameworkElement& application, const SaveTools& tools,
                                                const std::filesystem::path& chosen) {
  const auto* const source = application.FindAnnotation<ApplicationSource>();
  if (chosen.empty() && source == nullptr) {
    return Error{.message = "the application was built by code, and has no file yet",
                 .path = application.path(),
                 .hint = "name one"};
  }
  const std::filesystem::path file = chosen.empty() ? source->file : chosen;
  auto text = TextOfApplication(application, tools, file.parent_path());
  if (!text) return text.error();
  return ServiceHooks::SaveDifference{file.string(), {}, std::move(text->text)};
}

Result<void> ReadBefore(ServiceHooks::SaveDifference& difference) {
  std::error_code ignored;
  if (!std::filesystem::exists(difference.file, ignored)) return {};
  if (!std::filesystem::is_regular_file(difference.file, ignored)) return IsNoFile(difference.file);
  auto before = XmlDocument::ReadText(difference.file);
  if (!before) return before.error();
  difference.before = std::move(*before);
  return {};
}

std::string WhatPasses(FrameworkElement& application, const Scheduler& scheduler, bool has_stop) {
  std::string all;
  const auto add = [&](const std::string& what) { all += (all.empty() ? "" : ", ") + what; };
  if (!has_stop && application.runtime().robot_stop().in_force()) add("the STOP of the robot");
  bool is_recorded = false;
  for (const std::string& path : scheduler.PausedPaths()) add("the pause of " + path);
  application.VisitAll<const Port>([&](const Port& port) {
    if (port.is_blocked()) add("the block of " + port.path());
    is_recorded = is_recorded || IsRecorded(port);
    if (port.is_set_by_hand()) add("the value by hand of " + port.path());
  });
  if (is_recorded) add("recordings");
  return all.empty() ? "" : "not saved, as it ends with the run: " + all;
}

std::string WhatEnds(FrameworkElement& application, const Scheduler& scheduler, const SaveTools& tools, bool has_stop) {
  std::string lost = WhatPasses(application, scheduler, has_stop);
  if (!lost.empty()) lost = "\n" + lost;
  const auto* const source = application.FindAnnotation<ApplicationSource>();
  if (source == nullptr) return lost;
  const auto now = TextOfApplication(application, tools, source->file.parent_path());
  if (now && now->text != source->text) lost += "\nnot saved: what has been changed in " + source->file.string();
  return lost;
}

}  // namespace runnel::internal
