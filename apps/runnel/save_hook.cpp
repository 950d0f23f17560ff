#include "apps/runnel/save_hook.h"

#include <mutex>
#include <utility>

#include "plugins/application_files/application_saver.h"
#include "plugins/runtime_construction/application_source.h"

namespace runnel::program {

std::function<Result<std::string>(const std::string& file)> SaveHook(Workplace& workplace,
                                                                     std::string name) {
  return [&workplace, name = std::move(name)](const std::string& file) -> Result<std::string> {
    // All of it: nobody may delete the application meanwhile.
    const std::lock_guard lock(workplace.runtime().structure_mutex());
    const auto application = workplace.runtime().root().Find(name);
    if (!application) return application.error();
    const SaveTools tools{workplace.plugins(), workplace.tags()};
    const auto saved = file.empty() ? SaveApplication(**application, tools)
                                    : SaveApplication(**application, tools, file);
    if (!saved) return saved.error();
    if (!file.empty()) return "saved to " + file;
    return "saved to " + (*application)->FindAnnotation<ApplicationSource>()->file.string();
  };
}

}  // namespace runnel::program
