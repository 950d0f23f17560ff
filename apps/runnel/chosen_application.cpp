#include "apps/runnel/chosen_application.h"

#include <memory>

#include "plugins/finroc_files/application_form.h"
#include "plugins/viewers/viewers.h"

namespace runnel::program {

ApplicationOptions OptionsOf(const ApplicationArguments& arguments,
                             const std::shared_ptr<Viewers>& viewers) {
  ApplicationOptions options{.configurations = arguments.configurations,
                             .extensions = {std::make_shared<FinrocForm>(), viewers}};
  for (const std::string& each : arguments.settings) options.settings.emplace_back(each);
  return options;
}

ApplicationOptions OptionsOf(const ApplicationArguments& arguments) {
  return OptionsOf(arguments, std::make_shared<Viewers>(ViewerOptions{.is_refused = true}));
}

}  // namespace runnel::program
